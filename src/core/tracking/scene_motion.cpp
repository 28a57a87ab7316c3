// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/scene_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <sks_detector/error.hpp>
#include <sks_detector/stages/surface.hpp>

#include "core/surface/sanitize.hpp"
#include "core/verification/refinement.hpp"

namespace sks {
namespace {

constexpr double longest_kept = 3;         // [s] within which the detection of an earlier cloud has to arrive
constexpr double step = 0.25;              // [s] between clouds that are aligned: a camera turns by few degrees
constexpr std::size_t points_kept = 5000;  // of a cloud
constexpr double rough_radius = 0.03;      // [m] within which so few points have normals
constexpr double farthest_pair = 0.1;      // [m] in the first round
constexpr double nearest_pair = 0.01;      // [m] in the last round
constexpr int rounds = 20;                 // of ICP
constexpr int points_paired = 1000;
constexpr std::size_t fewest_points = 100;  // of a surface: else nothing can be said

std::size_t strideOver(const Cloud& cloud) {
  const double times = double(cloud.size()) / double(points_kept);
  return std::max<std::size_t>(1, std::size_t(cloud.organized() ? std::sqrt(times) : times));
}

Surface roughSurface(const Cloud& cloud, const Settings& settings) {
  SurfaceSettings rough = settings.surface;
  rough.resolution = 0;
  rough.normal_radius = rough_radius;
  return prepareSurface(sanitize(cloud, settings.sanitize), rough, Orientation::sensor, 1);
}

/// Of the points that have normals.
struct Oriented {
  explicit Oriented(const Surface& surface) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (!std::isfinite(surface.nx[i])) continue;
      points.push_back(surface.point(i));
      normals.push_back(surface.normal(i));
    }
  }
  std::vector<Eigen::Vector3f> points, normals;
};

}  // namespace

void SceneMotion::add(const Cloud& cloud, double stamp) {
  Cloud few;
  few.sensor_origin = cloud.sensor_origin;
  const std::size_t stride = strideOver(cloud), columns = cloud.columnCount();
  for (std::size_t row = 0; row < cloud.rowCount(); row += cloud.organized() ? stride : 1) {
    for (std::size_t column = 0; column < columns; column += stride) {
      few.points.push_back(cloud.points[row * columns + column]);
    }
  }
  few.width = std::uint32_t(few.size());
  kept_.push_back({stamp, std::move(few)});
  while (kept_.front().stamp < stamp - longest_kept) kept_.pop_front();
}

std::optional<Eigen::Isometry3d> SceneMotion::since(double then, const Settings& settings) const {
  RefinementSettings alignment = settings.refinement;
  alignment.start_distance = farthest_pair;
  alignment.end_distance = nearest_pair;
  alignment.iterations = rounds;
  alignment.max_points = points_paired;
  auto from = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.stamp == then; });
  if (from == kept_.end()) return {};
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  try {
    Surface before = roughSurface(from->cloud, settings);
    while (std::next(from) != kept_.end()) {
      const auto beyond =
          std::find_if(std::next(from), kept_.end(), [&](const Kept& kept) { return kept.stamp > from->stamp + step; });
      from = std::max(std::next(from), std::prev(beyond));
      Surface now = roughSurface(from->cloud, settings);
      const Oriented oriented(before);
      if (oriented.points.size() < fewest_points || now.size() < fewest_points) return {};
      motion = refinePose(oriented.points, oriented.normals, now, alignment, Eigen::Isometry3d::Identity()) * motion;
      before = std::move(now);
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_data) throw;
    return {};  // the sensor measured nothing
  }
  return motion;
}

}  // namespace sks
