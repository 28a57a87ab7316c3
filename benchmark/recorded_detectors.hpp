// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <sks_detector/detector.hpp>
#include <sks_detector/settings_file.hpp>
#include <sks_detector/trainer.hpp>

#include "io/dataset.hpp"
#include "recorded_scenes.hpp"

namespace sks::bench {

/// A preset of config/, for so many threads.
inline Settings preset(const std::string& name, int count) {
  Settings settings;
  loadSettings(std::string(SKS_SOURCE_DIR) + "/config/" + name + ".yaml", settings);
  settings.threads = count;
  return settings;
}

/// A data set of the recorded data; none, and the benchmark skipped with a message, where it is absent.
inline std::optional<DataSet> recordedDataSet(benchmark::State& state, const std::string& name) {
  const std::string file = test::recordedData((name + "/dataset.yaml").c_str());
  if (!file.empty()) return loadDataSet(file);
  state.SkipWithError(("skipped: no " + name + " in SKS_DATA").c_str());
  return std::nullopt;
}

inline std::shared_ptr<const Codebook> trained(const DataSet& data_set, const Settings& settings) {
  return std::make_shared<const Codebook>(train(trainingSamples(data_set), settings, data_set.name));
}

/// The clouds of at most so many scenes.
inline std::vector<Cloud> sceneClouds(const DataSet& data_set, std::size_t most) {
  std::vector<Cloud> clouds;
  for (std::size_t i = 0; i < std::min(most, data_set.scenes.size()); ++i) {
    clouds.push_back(readCloud(data_set.scenes[i].path, data_set.scale));
  }
  return clouds;
}

inline void detectAll(const Detector& detector, const std::vector<Cloud>& clouds) {
  for (const Cloud& cloud : clouds) benchmark::DoNotOptimize(detector.detect(cloud));
}

}  // namespace sks::bench
