// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <ros/duration.h>
#include <sks_detector/DetectionArray.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <sks_detector/cloud.hpp>

namespace sks_detector {

/// The colour of an object's boxes and votes: always the same for a name.
sks::Rgb objectColor(const std::string& object);

/// Nothing but DELETEALL: what was shown before is gone.
visualization_msgs::MarkerArray clearingMarkers(const std_msgs::Header& header);

/// DELETEALL, then of each detection its box (edges), its label (name and score) and the axes of its model at the
/// centre of the box (x red, y green, z blue).
/// @param lifetime after which rviz lets them go by itself; 0: never
visualization_msgs::MarkerArray detectionMarkers(const DetectionArray& detections, const ros::Duration& lifetime);

}  // namespace sks_detector
