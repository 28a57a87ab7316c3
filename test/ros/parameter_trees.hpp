// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <XmlRpcValue.h>

namespace sks_detector::test {

/// `levels` maps, each the only entry "a" of the one around it.
inline XmlRpc::XmlRpcValue deepNest(int levels) {
  XmlRpc::XmlRpcValue nest;
  nest["a"] = 1;
  for (int i = 1; i < levels; ++i) {
    XmlRpc::XmlRpcValue around;
    around["a"] = nest;
    nest = around;
  }
  return nest;
}

/// The name of what stands at the end of the deepest nest that is read.
inline std::string deepName(const std::string& name_space) {
  std::string name = name_space;
  for (int i = 0; i < 16; ++i) name += "/a";
  return name;
}

}  // namespace sks_detector::test
