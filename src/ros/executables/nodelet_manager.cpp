// SPDX-License-Identifier: BSD-3-Clause
// A nodelet manager like nodelet's own, which also survives to be interrupted at any time: nodelets and their bonds end
// before ROS does, and never while one of them is being loaded.
#include <exception>
#include <iostream>

#include <nodelet/loader.h>
#include <ros/console.h>
#include <ros/ros.h>

#include "ros/termination.hpp"

namespace {

/// Where nodelets and those who loaded them end together, nodelet calls it an error that what a broken bond would
/// unload has gone already.
void silenceUnloading() {
  if (ros::console::set_logger_level("ros.nodelet", ros::console::levels::Fatal)) {
    ros::console::notifyLoggerLevelsChanged();
  }
}

}  // namespace

int main(int argc, char** argv) try {
  ros::init(argc, argv, "manager", ros::init_options::NoSigintHandler);
  const ros::NodeHandle keeps_ros_running;
  sks_detector::handleTermination();
  nodelet::Loader loader;
  sks_detector::spinUntilTermination();
  silenceUnloading();
  loader.clear();  // before its bonds break, which would unload the nodelets from another thread
  return 0;
} catch (const std::exception& error) {
  std::cerr << "the nodelet manager does not start: " << error.what() << "\n";  // the log is closed by now
  return 1;
}
