// SPDX-License-Identifier: BSD-3-Clause
// A nodelet manager like nodelet's own, which also survives to be interrupted at any time: nodelets and their bonds end
// before ROS does, and never while one of them is being loaded.
#include <exception>
#include <iostream>

#include <nodelet/loader.h>
#include <ros/ros.h>

#include "ros/termination.hpp"

int main(int argc, char** argv) try {
  ros::init(argc, argv, "manager", ros::init_options::NoSigintHandler);
  const ros::NodeHandle keeps_ros_running;
  sks_detector::handleTermination();
  nodelet::Loader loader;
  sks_detector::spinUntilTermination();
  loader.clear();  // before its bonds break, which would unload the nodelets from another thread
  return 0;
} catch (const std::exception& error) {
  std::cerr << "the nodelet manager does not start: " << error.what() << "\n";  // the log is closed by now
  return 1;
}
