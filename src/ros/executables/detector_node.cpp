// SPDX-License-Identifier: BSD-3-Clause
#include <exception>

#include <ros/ros.h>

#include "ros/detector_node.hpp"

int main(int argc, char** argv) try {
  ros::init(argc, argv, "detector");
  sks_detector::DetectorNode node(ros::NodeHandle("~"));
  ros::spin();
  return 0;
} catch (const std::exception& error) {
  ROS_FATAL("the detector does not start: %s", error.what());
  return 1;
}
