// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sks_detector {

/// The name of a frame as tf2 has it: without the leading slash of tf.
inline std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace sks_detector
