// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>

#include <ros/ros.h>

#include "ros/camera/camera_node.hpp"
#include "ros/termination.hpp"

int main(int argc, char** argv) try {
  ros::init(argc, argv, "camera", ros::init_options::NoSigintHandler);
  const ros::NodeHandle private_handle("~");
  sks_detector::handleTermination();
  const sks_detector::CameraNode node(private_handle, ros::this_node::getName());
  sks_detector::spinUntilTermination();
  return 0;
} catch (const std::exception& error) {
  std::cerr << "the camera does not start: " << error.what() << "\n";  // the log is closed by now
  return 1;
}
