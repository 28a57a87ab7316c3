// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include <benchmark/benchmark.h>

#include <sks_detector/cloud_io.hpp>

#include "recorded_data.hpp"

namespace sks::bench {

constexpr const char* unorganized_scene = "kinect/scenes/scene001.pcd";
constexpr const char* organized_scene = "clutter/learn0.pcd";  // 640 x 480, colour

/// A cloud of the recorded data; none, and the benchmark skipped with a message, where it is absent.
inline std::optional<Cloud> recordedScene(benchmark::State& state, const char* name) {
  const std::string path = test::recordedData(name);
  if (!path.empty()) return readCloud(path);
  state.SkipWithError((std::string("skipped: no ") + name + " in SKS_DATA").c_str());
  return std::nullopt;
}

}  // namespace sks::bench
