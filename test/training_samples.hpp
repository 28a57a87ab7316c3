// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include <sks_detector/trainer.hpp>

#include "synthetic.hpp"

namespace sks::test {

inline TrainingSample sampleOf(const std::string& object, Cloud cloud, ViewKind kind = ViewKind::view,
                               const std::string& source = "cloud.pcd") {
  return {object, source, kind, [cloud = std::move(cloud)] { return cloud; }};
}

}  // namespace sks::test
