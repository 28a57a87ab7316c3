// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/trainer.hpp>

namespace sks {

/// What a training cloud becomes before its words are added to a codebook.
struct PreparedView {
  std::string object;  ///< name
  bool rendered = false;
  TrainingView view;  ///< but for its object
  Keypoints keypoints;
  Descriptors descriptors;
};

/// The same on its way from one process to another.
struct SharedView {
  bool described = false;  ///< it shows enough of the object
  bool colorless = false;  ///< its cloud has no colours that could be described
  TrainingView view;
  std::vector<Eigen::Vector3f> positions;  ///< of the keypoint of each row
  std::vector<Eigen::Matrix3f> frames;     ///< of each row
  std::vector<float> bins;                 ///< of the descriptors, row by row

  std::size_t cols() const { return positions.empty() ? 0 : bins.size() / positions.size(); }
};

template <typename Archive>
void fields(Archive& archive, TrainingView& v) {
  archive(v.source, v.frame, v.kind, v.sensor_origin, v.box_min, v.box_max, v.T_model_source, v.surface_points,
          v.surface_normals, v.surface_colors);
}

template <typename Archive>
void fields(Archive& archive, SharedView& v) {
  archive(v.described, v.colorless, v.view, v.positions, v.frames, v.bins);
}

inline SharedView sharedView(PreparedView prepared) {
  SharedView shared;
  shared.described = true;
  shared.view = std::move(prepared.view);
  const Descriptors& descriptors = prepared.descriptors;
  for (const std::uint32_t keypoint : descriptors.keypoints) {
    shared.positions.push_back(prepared.keypoints.positions[keypoint]);
  }
  const std::size_t values = descriptors.values.rows() * descriptors.values.cols();
  shared.bins.assign(descriptors.values.data(), descriptors.values.data() + values);
  shared.frames = std::move(prepared.descriptors.frames);
  return shared;
}

/// @param sample that the view was made of
inline PreparedView preparedView(SharedView shared, const TrainingSample& sample) {
  PreparedView prepared{sample.object, sample.rendered, std::move(shared.view), {}, {}};
  const std::size_t cols = shared.cols();
  if (cols == 0) return prepared;
  prepared.keypoints.positions = std::move(shared.positions);
  prepared.descriptors.keypoints.resize(prepared.keypoints.size());
  std::iota(prepared.descriptors.keypoints.begin(), prepared.descriptors.keypoints.end(), 0u);
  prepared.descriptors.frames = std::move(shared.frames);
  prepared.descriptors.values = DescriptorMatrix(std::move(shared.bins), cols);
  return prepared;
}

}  // namespace sks
