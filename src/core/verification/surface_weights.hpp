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
  float colorVariation() const;

  const TrainingView& view_;
  PointGrid grid_;
  std::vector<PointGrid::Run> runs_;
  std::vector<std::uint32_t> around_;  // points of the surface
};

/// The weights of all points of a view's stored surface, as in SurfaceWeight.
struct SurfaceWeights {
  SurfaceWeights() = default;
  explicit SurfaceWeights(const TrainingView& view);

  std::vector<float> shape;
  std::vector<float> shape_and_color;
};

/// The weights of each view's surface, computed when they are first asked for: a scene resembles few of the views, and
/// all of them would take most of the time of loading a codebook. Thread-safe.
class WeightsOfViews {
public:
  /// @param views must outlive this, unchanged
  explicit WeightsOfViews(const std::vector<TrainingView>& views)
      : views_(views), weights_(std::make_unique<Entry[]>(views.size())) {}

  const SurfaceWeights& operator[](std::size_t view) const {
    Entry& entry = weights_[view];
    std::call_once(entry.once, [&] { entry.weights = SurfaceWeights(views_[view]); });
    return entry.weights;
  }

private:
  struct Entry {
    std::once_flag once;
    SurfaceWeights weights;
  };

  const std::vector<TrainingView>& views_;
  std::unique_ptr<Entry[]> weights_;
};

}  // namespace sks
