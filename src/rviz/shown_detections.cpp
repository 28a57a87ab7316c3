// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/shown_detections.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"
#include "ros/detection_message.hpp"

namespace sks_detector {
namespace {

constexpr double furthest = 1e6;               // [m] beyond it single precision, with which is drawn, fails
constexpr double quaternion_tolerance = 0.01;  // of its length: more is no matter of rounding

/// How far the length of a quaternion is from 1; those that were never set (zeros) count as 1.
double excess(const geometry_msgs::Quaternion& q) {
  const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  return length == 0 ? 0 : std::abs(length - 1);
}

/// What keeps a detection from being drawn, although its numbers are finite; empty: nothing.
std::string outOfBounds(const sks::Detection& detection) {
  const double reach =
      std::max({detection.T_scene_box.translation().cwiseAbs().maxCoeff(),
                detection.T_scene_model.translation().cwiseAbs().maxCoeff(), detection.box_size.cwiseAbs().maxCoeff()});
  if (reach > furthest) return sks::formatted("a length of %.3g m", reach);
  if (detection.box_size.minCoeff() < 0) return "a negative box_size";
  return "";
}

}  // namespace

ShownDetections chooseShown(const DetectionArray& array, double threshold, std::size_t most) {
  ShownDetections result;
  std::map<std::string, std::size_t> count;  // of what has the same id or object
  const auto tell = [&](std::size_t index, const std::string& what) {
    if (!result.problem.empty()) return;
    result.problem =
        "detection " + std::to_string(index) + " ('" + sks::shown(array.detections[index].object) + "'): " + what;
  };
  for (std::size_t i = 0; i < array.detections.size(); ++i) {
    const Detection& message = array.detections[i];
    if (double(message.score) < threshold) {
      ++result.below_threshold;
      continue;
    }
    if (result.shown.size() == most) {
      ++result.too_many;
      continue;
    }
    ShownDetection shown;
    shown.index = i;
    try {
      shown.detection = toDetection(message);
    } catch (const sks::Error& error) {
      ++result.unusable;
      tell(i, error.what());
      continue;
    }
    if (const std::string bounds = outOfBounds(shown.detection); !bounds.empty()) {
      ++result.unusable;
      tell(i, bounds);
      continue;
    }
    const double off = std::max(excess(message.pose.pose.orientation), excess(message.box_center.orientation));
    if (off > quaternion_tolerance) {
      ++result.unnormalized;
      tell(i, "the length of a quaternion is off by " + sks::formatted("%.3g", off) + ", drawn as if it were 1");
    }
    const std::string thing = message.id > 0 ? "id " + std::to_string(message.id) : "object " + message.object;
    shown.key = std::to_string(count[thing]++) + " of " + thing;
    result.shown.push_back(std::move(shown));
  }
  return result;
}

}  // namespace sks_detector
