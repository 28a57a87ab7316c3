// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>

#include <ros/ros.h>

#include "planning_scene/planning_scene_node.hpp"
#include "ros/termination.hpp"

int main(int argc, char** argv) try {
  ros::init(argc, argv, "planning_scene", ros::init_options::NoSigintHandler);
  ros::NodeHandle handle, private_handle("~");
  sks_detector::handleTermination();
  const sks_detector::PlanningSceneNode node(handle, private_handle,
                                             sks_detector::readPlanningSceneSettings(private_handle));
  sks_detector::spinUntilTermination();
  return 0;
} catch (const std::exception& error) {
  std::cerr << "the planning scene's node does not start: " << error.what() << "\n";  // the log is closed by now
  return 1;
}
