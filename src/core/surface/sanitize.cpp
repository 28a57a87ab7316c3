// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/sanitize.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "core/surface/distinct_points.hpp"

namespace sks {
namespace {

constexpr double implausible_distance = 50.0;  // [m]; beyond every RGB-D sensor, below any object in millimetres

/// Of up to some thousand points, spread evenly over the cloud.
double medianDistance(const Cloud& cloud) {
  constexpr std::size_t enough = 4096;
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / enough);
  std::vector<float> distances;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    if (cloud.points[i].allFinite()) distances.push_back((cloud.points[i] - cloud.sensor_origin).norm());
  }
  if (distances.empty()) return 0;
  auto middle = distances.begin() + distances.size() / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

void checkShape(const Cloud& cloud) {
  if (cloud.points.empty()) refuse("the cloud is empty (0 points)");
  if (cloud.width > 0 && cloud.points.size() != std::size_t(cloud.width) * cloud.height) {
    refuse("the cloud holds " + std::to_string(cloud.points.size()) + " points, but its width x height is " +
           std::to_string(cloud.width) + " x " + std::to_string(cloud.height));
  }
  if (cloud.hasColor() && cloud.colors.size() != cloud.points.size()) {
    refuse("the cloud holds " + std::to_string(cloud.colors.size()) + " colours for " +
           std::to_string(cloud.points.size()) + " points");
  }
  constexpr float farthest_origin = 1e6f;  // [m]; squares of coordinates are far from overflow
  if (!(cloud.sensor_origin.array().abs() <= farthest_origin).all()) {
    refuse("the cloud's sensor origin (viewpoint) does not lie within 1000 km of its points' origin");
  }
}

/// Indices of the finite points within range and crop box; counts the others.
std::vector<std::uint32_t> usablePoints(const Cloud& cloud, const SanitizeSettings& settings, int threads,
                                        SanitizeReport& counts) {
  const Eigen::Array3f low(settings.crop_min_x, settings.crop_min_y, settings.crop_min_z);
  const Eigen::Array3f high(settings.crop_max_x, settings.crop_max_y, settings.crop_max_z);
  const double nearest = settings.min_range * settings.min_range, farthest = settings.max_range * settings.max_range;
  std::vector<char> use(cloud.size());
  std::size_t invalid = 0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(+ : invalid)
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    const bool finite = p.allFinite();
    invalid += !finite;
    if (!finite) continue;
    const double squared = (p - cloud.sensor_origin).cast<double>().squaredNorm();
    const bool inside = !settings.crop || ((p.array() >= low).all() && (p.array() <= high).all());
    use[i] = !(squared < nearest || squared > farthest) && inside;
  }
  std::vector<std::uint32_t> usable(cloud.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {  // without branches: clouds have holes everywhere
    usable[count] = std::uint32_t(i);
    count += std::size_t(use[i]);
  }
  usable.resize(count);
  counts.invalid = invalid;
  counts.out_of_range = cloud.size() - invalid - count;
  return usable;
}

}  // namespace

SanitizeSettings sanitizingFor(Orientation orientation, SanitizeSettings settings) {
  if (orientation == Orientation::outward) settings.min_range = 0;
  return settings;
}

Cloud sanitize(const Cloud& cloud, const SanitizeSettings& settings, SanitizeReport* report, int threads) {
  checkShape(cloud);
  const double median = medianDistance(cloud);
  if (median > std::max(implausible_distance, settings.max_range)) {
    refuse("the cloud looks like millimetres: the median distance from the sensor is " + formatted("%g", median) +
           " m; scale it by 0.001 (units: mm in a data set file, --scale 0.001 on the command line; what publishes "
           "clouds to ROS must send metres: look for a setting of its units)");
  }

  SanitizeReport counts;
  counts.input = cloud.size();
  const auto usable = usablePoints(cloud, settings, threads, counts);
  auto distinct = settings.remove_duplicates ? distinctPoints(cloud.points, usable, threads) : usable;
  counts.duplicates = usable.size() - distinct.size();
  Cloud kept;
  kept.sensor_origin = cloud.sensor_origin;
  kept.points.resize(distinct.size());
  if (cloud.hasColor()) kept.colors.resize(distinct.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    kept.points[i] = cloud.points[distinct[i]];
    if (cloud.hasColor()) kept.colors[i] = cloud.colors[distinct[i]];
  }
  if (cloud.organized()) {
    kept.pixels = std::move(distinct);
    kept.columns = cloud.width;
  }
  counts.kept = kept.size();
  kept.width = std::uint32_t(kept.size());
  if (report) *report = counts;
  if (counts.kept < std::size_t(settings.min_points)) {
    refuse(
        formatted("the cloud has %zu usable points, at least %d are needed: of %zu points %zu are NaN or infinite, "
                  "%zu out of range (%g to %g m from the sensor%s), %zu duplicates",
                  counts.kept, settings.min_points, counts.input, counts.invalid, counts.out_of_range,
                  settings.min_range, settings.max_range, settings.crop ? ", crop box" : "", counts.duplicates));
  }
  return kept;
}

}  // namespace sks
