// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <benchmark/benchmark.h>

#include <sks_detector/stages/matching.hpp>
#include <sks_detector/trainer.hpp>

#include "core/keypoints/sparse_selection.hpp"
#include "core/surface/sanitize.hpp"
#include "io/dataset.hpp"
#include "pair.hpp"
#include "recorded_scenes.hpp"

namespace sks::bench {

/// The codewords of the kinect data set, and the descriptors of one of its scenes (SKS-50).
struct RecordedWords {
  DescriptorMatrix words, queries;
};

/// None, and the benchmark skipped with a message, where the recorded data is absent.
inline const RecordedWords* recordedWords(benchmark::State& state) {
  static std::optional<RecordedWords> recorded;
  if (recorded) return &*recorded;
  const auto scene = recordedScene(state, unorganized_scene);
  if (!scene) return nullptr;
  const Settings settings;
  const DataSet data_set = loadDataSet(test::recordedData("kinect/dataset.yaml"));
  const Codebook codebook = train(trainingSamples(data_set), settings, "kinect");
  const Surface surface =
      prepareSurface(sanitize(*scene, settings.sanitize), settings.surface, Orientation::sensor, threads);
  Keypoints keypoints = detectKeypoints(surface, settings.keypoints, threads);
  measureCurvature(surface, keypoints, settings.keypoints, settings.surface, threads);
  keypoints = selectKeypoints(keypoints, settings.keypoints);
  recorded = {codebook.descriptors.values(),
              computeDescriptors(surface, keypoints, codebook.descriptor_type, settings.descriptor, threads).values};
  return &*recorded;
}

/// About `count` rows, spread evenly.
inline DescriptorMatrix someOf(const DescriptorMatrix& rows, std::size_t count) {
  std::vector<float> values;
  count = std::min(count, rows.rows());
  for (std::size_t i = 0; i < count; ++i) {
    const float* row = rows.row(i * rows.rows() / count);
    values.insert(values.end(), row, row + rows.cols());
  }
  return DescriptorMatrix(std::move(values), rows.cols());
}

/// Of the queries, those whose match is no farther than the nearest word that a plain loop finds.
inline double shareOfNearest(const DescriptorMatrix& words, const DescriptorMatrix& queries,
                             const std::vector<Match>& nearest, const std::vector<std::uint32_t>& found) {
  std::size_t equal = 0;
  for (std::size_t i = 0; i < queries.rows(); ++i) {
    const double distance = chiSquared(queries.row(i), words.row(found[i]), words.cols());
    equal += distance <= chiSquared(queries.row(i), words.row(nearest[i].word), words.cols());
  }
  return double(equal) / double(queries.rows());
}

}  // namespace sks::bench
