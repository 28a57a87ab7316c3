// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_parts");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
