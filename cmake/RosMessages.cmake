# SPDX-License-Identifier: BSD-3-Clause
#
# The ROS part's dependencies and messages: included before catkin_package(). Built in a catkin workspace where ROS is
# found; sets sks_ros to whether it is.
set(sks_ros OFF)
set(sks_message_dependencies)
find_package(catkin QUIET COMPONENTS
  actionlib actionlib_msgs diagnostic_msgs diagnostic_updater dynamic_reconfigure geometry_msgs message_generation nodelet
  pcl_ros pluginlib rosbag roscpp sensor_msgs std_msgs std_srvs tf2_eigen tf2_msgs tf2_ros tf2_sensor_msgs
  visualization_msgs)
if(catkin_FOUND)
  set(sks_ros ON)
else()
  message(STATUS "${PROJECT_NAME} is built without its ROS node, of which a dependency is missing: "
    "scripts/install_dependencies installs it")
endif()
if(sks_ros)
  add_message_files(FILES Detection.msg DetectionArray.msg ObjectModel.msg ObjectModels.msg Status.msg Support.msg)
  add_service_files(FILES CaptureView.srv Detect.srv Info.srv LoadCodebook.srv RemoveObject.srv SaveCodebook.srv
    Train.srv UndoCapture.srv)
  add_action_files(FILES Train.action)
  generate_messages(DEPENDENCIES actionlib_msgs geometry_msgs sensor_msgs std_msgs)
  set(sks_message_dependencies actionlib_msgs geometry_msgs message_runtime sensor_msgs std_msgs)
endif()
