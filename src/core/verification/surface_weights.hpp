// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/point_grid.hpp>

namespace sks {

/// The weight of a point of a stored surface, in [0, 1]: flat parts fit many things.
struct SurfaceWeight {
  float shape = 0;            ///< how much the normals around it vary
  float shape_and_color = 0;  ///< ... and the colours: prints say as much as edges
};

/// Weighs points of one view's stored surface.
class SurfaceWeigher {
public:
  /// @param view must outlive this
  explicit SurfaceWeigher(const TrainingView& view);

  SurfaceWeight at(std::size_t point);

private:
  /// Four numbers are added at once.
  using Padded = std::vector<Eigen::Vector4f, Eigen::aligned_allocator<Eigen::Vector4f>>;

  std::size_t lookAround(const Eigen::Vector3f& center);
  float colorVariation(std::size_t count) const;

  const TrainingView& view_;
  PointGrid grid_;
  Padded normals_, colors_;  // in the order of the grid; no colours of a surface without
  std::vector<PointGrid::Run> runs_;
  std::vector<std::uint32_t> around_;  // points of the grid
};

/// Every how many points of a view's surface are to be taken, for `most` or fewer.
inline std::size_t strideFor(const TrainingView& view, std::size_t most) {
  return view.surface_points.size() / most + 1;
}

/// The weights of all points of a view's stored surface, as in SurfaceWeight.
struct SurfaceWeights {
  SurfaceWeights() = default;
  explicit SurfaceWeights(const TrainingView& view);

  /// Weighs every `stride`-th point, but those of a stride that are known (0: none).
  void weighEvery(const TrainingView& view, std::size_t stride, std::size_t known_stride = 0);

  std::vector<float> shape;
  std::vector<float> shape_and_color;
};

/// The weights of each view's surface, computed when they are first asked for: a scene resembles few of the views, and
/// all of them would take most of the time of loading a codebook. Of most of these again few points are asked for.
/// Thread-safe.
class WeightsOfViews {
public:
  /// @param views must outlive this, unchanged
  /// @param few_points that are enough for a first look
  WeightsOfViews(const std::vector<TrainingView>& views, std::size_t few_points)
      : views_(views), few_points_(few_points), entries_(std::make_unique<Entry[]>(views.size())) {}

  /// @return those of every `stride`-th point at least
  const SurfaceWeights& at(std::size_t view, std::size_t stride) const;

private:
  struct Entry {
    std::once_flag some, all;
    SurfaceWeights weights;
  };

  const std::vector<TrainingView>& views_;
  std::size_t few_points_;
  std::unique_ptr<Entry[]> entries_;
};

}  // namespace sks
