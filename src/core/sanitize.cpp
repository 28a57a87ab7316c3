// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/sanitize.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

constexpr double implausible_distance = 50.0;  // [m]; beyond every RGB-D sensor, below any object in millimetres

/// Set of positions by their exact value; open addressing, sized once.
class PositionSet {
public:
  explicit PositionSet(std::size_t expected) {
    std::size_t capacity = 16;
    while (capacity < 2 * expected) capacity *= 2;
    slots_.assign(capacity, 0);
  }

  /// False if an equal position is in the set already.
  bool insert(const std::vector<Eigen::Vector3f>& points, std::uint32_t index) {
    const Eigen::Vector3f p = points[index] + Eigen::Vector3f::Zero();  // -0 becomes +0
    std::uint32_t bits[3];
    std::memcpy(bits, p.data(), sizeof bits);
    std::uint64_t hash =
        bits[0] * 0x9E3779B97F4A7C15ull ^ bits[1] * 0xC2B2AE3D27D4EB4Full ^ bits[2] * 0x165667B19E3779F9ull;
    hash ^= hash >> 29;
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == 0) {
        slots_[slot] = index + 1;
        return true;
      }
      if (points[slots_[slot] - 1] == points[index]) return false;
    }
  }

private:
  std::vector<std::uint32_t> slots_;  // index + 1; 0 is free
};

double medianDistance(const Cloud& cloud) {
  std::vector<float> distances;
  distances.reserve(cloud.size());
  for (const auto& p : cloud.points) {
    if (p.allFinite()) distances.push_back((p - cloud.sensor_origin).norm());
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
  if (cloud.points.size() != std::size_t(cloud.width) * cloud.height) {
    refuse("the cloud holds " + std::to_string(cloud.points.size()) + " points, but its width x height is " +
           std::to_string(cloud.width) + " x " + std::to_string(cloud.height));
  }
  if (cloud.hasColor() && cloud.colors.size() != cloud.points.size()) {
    refuse("the cloud holds " + std::to_string(cloud.colors.size()) + " colours for " +
           std::to_string(cloud.points.size()) + " points");
  }
  if (!cloud.sensor_origin.allFinite()) refuse("the cloud's sensor origin (viewpoint) is not finite");
}

}  // namespace

Cloud sanitize(const Cloud& cloud, const SanitizeSettings& settings, SanitizeReport* report) {
  checkShape(cloud);
  const double median = medianDistance(cloud);
  if (median > std::max(implausible_distance, settings.max_range)) {
    std::ostringstream message;
    message << "the cloud looks like millimetres: the median distance from the sensor is " << median
            << " m; scale it by 0.001 (units: mm in a data set file, --scale 0.001 on the command line)";
    refuse(message.str());
  }

  SanitizeReport counts;
  counts.input = cloud.size();
  PositionSet seen(settings.remove_duplicates ? cloud.size() : 0);
  const Eigen::Array3f low(settings.crop_min_x, settings.crop_min_y, settings.crop_min_z);
  const Eigen::Array3f high(settings.crop_max_x, settings.crop_max_y, settings.crop_max_z);
  Cloud kept;
  kept.sensor_origin = cloud.sensor_origin;
  kept.points.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    if (!p.allFinite()) {
      ++counts.invalid;
      continue;
    }
    const double range = (p - cloud.sensor_origin).norm();
    const bool inside = !settings.crop || ((p.array() >= low).all() && (p.array() <= high).all());
    if (range < settings.min_range || range > settings.max_range || !inside) {
      ++counts.out_of_range;
    } else if (settings.remove_duplicates && !seen.insert(cloud.points, std::uint32_t(i))) {
      ++counts.duplicates;
    } else {
      kept.points.push_back(p);
      if (cloud.hasColor()) kept.colors.push_back(cloud.colors[i]);
    }
  }
  counts.kept = kept.size();
  kept.width = std::uint32_t(kept.size());
  if (report) *report = counts;
  if (counts.kept < std::size_t(settings.min_points)) {
    std::ostringstream message;
    message << "the cloud has " << counts.kept << " usable points, at least " << settings.min_points
            << " are needed: of " << counts.input << " points " << counts.invalid << " are NaN or infinite, "
            << counts.out_of_range << " out of range (" << settings.min_range << " to " << settings.max_range
            << " m from the sensor" << (settings.crop ? ", crop box" : "") << "), " << counts.duplicates
            << " duplicates";
    refuse(message.str());
  }
  return kept;
}

}  // namespace sks
