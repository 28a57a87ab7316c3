// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/descriptors.hpp>

#include <algorithm>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/descriptors/local_reference_frame.hpp"
#include "core/descriptors/shot.hpp"

namespace sks {
namespace {

constexpr float core_share = 0.2f;  // of the support radius: the points that stand for the keypoint itself

struct Workspace {
  Neighborhood neighborhood;
  ShotSupport support;
};

bool describe(const Surface& surface, const Eigen::Vector3f& keypoint, DescriptorType type,
              const DescriptorSettings& settings, Workspace& work, Eigen::Matrix3f& frame, float* histogram) {
  const float radius = float(settings.radius);
  work.neighborhood.gather(surface, keypoint, radius);
  if (surface.orientation == Orientation::outward && settings.model_facing > -1) {
    work.neighborhood.keepFacing(float(settings.model_facing), core_share * radius);
  }
  if (work.neighborhood.size < std::size_t(settings.min_neighbors)) return false;
  if (!localReferenceFrame(work.neighborhood, radius, frame)) return false;
  work.support.locate(work.neighborhood, frame, radius);
  shapeHistogram(work.neighborhood, work.support, histogram);
  if (type == DescriptorType::cshot) {
    colorHistogram(surface, work.neighborhood, work.support, core_share * radius, histogram + shot_size);
  }
  return normalize(histogram, descriptorSize(type));
}

}  // namespace

std::size_t descriptorSize(DescriptorType type) {
  switch (type) {
    case DescriptorType::shot:
      return shot_size;
    case DescriptorType::cshot:
      return cshot_size;
    case DescriptorType::automatic:
      break;
  }
  return 0;
}

DescriptorMatrix::DescriptorMatrix(std::vector<float> values, std::size_t cols) : cols_(cols) {
  if (cols == 0 || values.size() % cols != 0) {
    throw Error(ErrorCode::bad_data, "a descriptor matrix of " + std::to_string(values.size()) +
                                         " values has no whole rows of " + std::to_string(cols));
  }
  const auto owned = std::make_shared<const std::vector<float>>(std::move(values));
  data_ = owned->data();
  rows_ = owned->size() / cols;
  owner_ = owned;
}

DescriptorMatrix::DescriptorMatrix(const float* data, std::size_t rows, std::size_t cols,
                                   std::shared_ptr<const void> owner)
    : data_(data), rows_(rows), cols_(cols), owner_(std::move(owner)) {}

Descriptors computeDescriptors(const Surface& surface, const Keypoints& keypoints, DescriptorType type,
                               const DescriptorSettings& settings, int threads) {
  if (type == DescriptorType::cshot && !surface.hasColor()) {
    throw Error(ErrorCode::incompatible,
                "CSHOT describes colour, but the cloud has none: use a coloured cloud, or SHOT (descriptor.type=shot)");
  }
  const std::size_t n = keypoints.size(), cols = descriptorSize(type);
  constexpr std::uint32_t none = std::uint32_t(-1);
  std::vector<float> values(n * cols);
  Descriptors descriptors;
  descriptors.frames.resize(n);
  descriptors.keypoints.resize(n);
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < n; ++i) {
    thread_local Workspace work;  // keeps its buffers from frame to frame
    const bool described =
        describe(surface, keypoints.positions[i], type, settings, work, descriptors.frames[i], &values[i * cols]);
    descriptors.keypoints[i] = described ? std::uint32_t(i) : none;
  }

  std::size_t rows = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (descriptors.keypoints[i] == none) continue;
    if (rows != i) std::copy_n(&values[i * cols], cols, &values[rows * cols]);
    descriptors.frames[rows] = descriptors.frames[i];
    descriptors.keypoints[rows++] = std::uint32_t(i);
  }
  descriptors.frames.resize(rows);
  descriptors.keypoints.resize(rows);
  values.resize(rows * cols);
  descriptors.values = DescriptorMatrix(std::move(values), cols);
  return descriptors;
}

}  // namespace sks
