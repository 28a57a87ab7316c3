# SPDX-License-Identifier: BSD-3-Clause
#
# The plugin of rviz: a display of the detections and a panel to work with the node. Built where rviz and Qt 5 are found;
# sets sks_rviz to whether it is.
set(sks_rviz OFF)
find_package(rviz QUIET)
find_package(Qt5 5.10 QUIET COMPONENTS Widgets)
if(rviz_FOUND AND Qt5_FOUND)
  set(sks_rviz ON)
else()
  message(STATUS "${PROJECT_NAME} is built without its plugin of rviz: it needs `apt-get install librviz-dev qtbase5-dev`, "
    "or with ROS of its own packages `apt-get install ros-$ROS_DISTRO-rviz qtbase5-dev`")
  return()
endif()

file(GLOB rviz_sources CONFIGURE_DEPENDS src/rviz/*.cpp)
file(GLOB rviz_headers CONFIGURE_DEPENDS src/rviz/*.hpp)
# Of the node only what turns messages into detections and clouds, and what asks the master without waiting for it.
add_library(${PROJECT_NAME}_rviz SHARED ${rviz_sources} ${rviz_headers} src/ros/cloud_message.cpp
  src/ros/detection_message.cpp src/ros/master_access.cpp)
add_dependencies(${PROJECT_NAME}_rviz ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
target_include_directories(${PROJECT_NAME}_rviz PUBLIC src)
#catkin_lint: ignore_once external_directory external_interface_path
target_include_directories(${PROJECT_NAME}_rviz SYSTEM PUBLIC
  ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS} ${rviz_INCLUDE_DIRS})
target_compile_definitions(${PROJECT_NAME}_rviz PUBLIC QT_NO_KEYWORDS)  # boost has its own `signals` and `slots`
target_link_libraries(${PROJECT_NAME}_rviz PUBLIC ${PROJECT_NAME}_core ${catkin_LIBRARIES} ${rviz_LIBRARIES} Qt5::Widgets
  PRIVATE sks_build_flags sks_drawing)
# A call that hangs may outlast its window: the code that it returns to must stay.
target_link_options(${PROJECT_NAME}_rviz PRIVATE -Wl,-z,nodelete)
set_target_properties(${PROJECT_NAME}_rviz PROPERTIES AUTOMOC ON)
sks_precompile(${PROJECT_NAME}_rviz <ros/node_handle.h> <QWidget> <rviz/display.h>)
install(TARGETS ${PROJECT_NAME}_rviz
  ARCHIVE DESTINATION ${sks_lib_dir}
  LIBRARY DESTINATION ${sks_lib_dir}
  RUNTIME DESTINATION ${sks_bin_dir})
install(FILES rviz_plugins.xml DESTINATION ${sks_share_dir})
