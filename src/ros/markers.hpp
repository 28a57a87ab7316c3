// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <ros/duration.h>
#include <sks_detector/DetectionArray.h>
#include <visualization_msgs/MarkerArray.h>
#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

namespace sks_detector {

/// How detections are shown.
struct MarkerStyle {
  std::vector<sks::Rgb> colors;  ///< of each detection's box and label
  /// The camera: labels lie above their boxes as it sees them, nearer to it than what stands in the box, and have a
  /// size that can be read from there.
  Eigen::Isometry3d T_target_sensor = Eigen::Isometry3d::Identity();
  ros::Duration lifetime;  ///< after which rviz lets them go by itself; 0: never
};

/// Nothing but DELETEALL: what was shown before is gone.
visualization_msgs::MarkerArray clearingMarkers(const std_msgs::Header& header);

/// DELETEALL, then of each detection its box (edges), its label (name and score) and the axes of its model at the
/// centre of the box (x red, y green, z blue).
visualization_msgs::MarkerArray detectionMarkers(const DetectionArray& detections, const MarkerStyle& style);

}  // namespace sks_detector
