// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <QApplication>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rviz_panel");
  const ros::NodeHandle keeps_ros_running;
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
