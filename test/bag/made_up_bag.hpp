// SPDX-License-Identifier: BSD-3-Clause
// Messages for bags that tests make up. Times count from one fixed second.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <sks_detector/DetectionArray.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/cloud_message.hpp"

namespace sks::test {

inline ros::Time at(double seconds) {
  return ros::Time(1600000000, 0) + ros::Duration(seconds);
}

inline std_msgs::Header header(double seconds, const std::string& frame = "camera") {
  std_msgs::Header result;
  result.stamp = at(seconds);
  result.frame_id = frame;
  return result;
}

/// A wall of 16 x 12 points at 1 m, one of which was not measured.
inline Cloud wall(bool colored = true) {
  Cloud cloud;
  cloud.width = 16;
  cloud.height = 12;
  for (std::uint32_t i = 0; i < cloud.width * cloud.height; ++i) {
    cloud.points.emplace_back(0.01f * float(i % cloud.width), 0.01f * float(i / cloud.width), 1.0f);
  }
  cloud.points[3].setConstant(std::numeric_limits<float>::quiet_NaN());
  if (colored) cloud.colors.assign(cloud.size(), {200, 100, 50});
  return cloud;
}

inline sensor_msgs::PointCloud2 wallMessage(double seconds, const std::string& frame = "camera") {
  return sks_detector::toMessage(wall(), header(seconds, frame));
}

inline tf2_msgs::TFMessage transform(double seconds, const std::string& parent, const std::string& child) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header = header(seconds, parent);
  message.transforms[0].child_frame_id = child;
  message.transforms[0].transform.rotation.w = 1;
  return message;
}

inline sks_detector::Detection detection(const std::string& object, double x, double score) {
  sks_detector::Detection message;
  message.object = object;
  message.score = float(score);
  message.view = object + ".obj";
  message.pose.pose.position.x = x;
  message.pose.pose.orientation.w = 1;
  message.box_center = message.pose.pose;
  message.box_size.x = message.box_size.y = message.box_size.z = 0.1;
  return message;
}

inline sks_detector::DetectionArray detections(double seconds, const std::vector<sks_detector::Detection>& found,
                                               const std::string& frame = "camera") {
  sks_detector::DetectionArray message;
  message.header = header(seconds, frame);
  message.detections = found;
  message.processing_time = 0.25;
  return message;
}

}  // namespace sks::test
