// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include <sks_detector/trainer.hpp>

#include "synthetic.hpp"

namespace sks::test {

inline TrainingSample sampleOf(const std::string& object, Cloud cloud, ViewKind kind = ViewKind::view,
                               const std::string& source = "cloud.pcd") {
  TrainingSample sample;
  sample.object = object;
  sample.source = source;
  sample.kind = kind;
  sample.load = [cloud = std::move(cloud)] { return cloud; };
  return sample;
}

}  // namespace sks::test
