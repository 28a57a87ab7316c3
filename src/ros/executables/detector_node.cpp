// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>

#include <ros/ros.h>

#include "ros/detector_node.hpp"
#include "ros/termination.hpp"

int main(int argc, char** argv) try {
  ros::init(argc, argv, "detector", ros::init_options::NoSigintHandler);
  const ros::NodeHandle private_handle("~");
  sks_detector::handleTermination();
  sks_detector::DetectorNode node(private_handle);
  ros::master::setRetryTimeout(ros::WallDuration(2));  // of what registers, from now on, just as the master goes
  sks_detector::spinUntilTermination();
  return 0;
} catch (const std::exception& error) {
  std::cerr << "the detector does not start: " << error.what() << "\n";  // the log is closed by now
  return 1;
}
