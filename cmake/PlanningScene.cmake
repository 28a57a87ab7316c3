# SPDX-License-Identifier: BSD-3-Clause
#
# planning_scene_node, which keeps MoveIt's planning scene in step with the detections: built where the messages of MoveIt
# are found, and by the tests in any case, with messages of their own.
file(GLOB planning_scene_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/planning_scene/*.cpp)

# sks_add_planning_scene_node([EXCLUDE_FROM_ALL]): what moveit_msgs and object_recognition_msgs include is added by the
# caller.
function(sks_add_planning_scene_node)
  add_executable(planning_scene_node ${ARGN} ${planning_scene_sources})
  target_link_libraries(planning_scene_node PRIVATE ${PROJECT_NAME}_ros)
  set_target_properties(planning_scene_node PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${sks_build_bin_dir}
    INSTALL_RPATH "\$ORIGIN/${sks_bin_to_lib}")
endfunction()

# Not in package.xml: no distribution needs them, and Debian does not have them.
#catkin_lint: ignore_once missing_depend
find_package(moveit_msgs QUIET)
#catkin_lint: ignore_once missing_depend
find_package(object_recognition_msgs QUIET)
if(moveit_msgs_FOUND AND object_recognition_msgs_FOUND)
  sks_add_planning_scene_node()
  #catkin_lint: ignore_once external_directory external_interface_path
  target_include_directories(planning_scene_node SYSTEM PRIVATE
    ${moveit_msgs_INCLUDE_DIRS} ${object_recognition_msgs_INCLUDE_DIRS})
  install(TARGETS planning_scene_node RUNTIME DESTINATION ${sks_bin_dir})
else()
  message(STATUS "${PROJECT_NAME} is built without planning_scene_node: it needs moveit_msgs and "
    "object_recognition_msgs, with ROS Noetic `apt-get install ros-noetic-moveit-msgs ros-noetic-object-recognition-msgs`")
endif()
