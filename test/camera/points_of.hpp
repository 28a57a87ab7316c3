// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ros/camera/organized_cloud.hpp"

namespace sks::test {

inline std::vector<sks_detector::OrganizedPoint> pointsOf(const sks_detector::CameraFrame& frame) {
  std::vector<sks_detector::OrganizedPoint> points(frame.depth.pixels.size());
  sks_detector::organizedCloud(frame, points.data());
  return points;
}

}  // namespace sks::test
