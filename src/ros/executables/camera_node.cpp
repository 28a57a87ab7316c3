// SPDX-License-Identifier: BSD-3-Clause
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "ros/camera/camera_node.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "camera");
  try {
    const sks_detector::CameraNode node(ros::NodeHandle("~"), ros::this_node::getName());
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("The camera cannot start: %s", error.what());
    return 1;
  }
  return 0;
}
