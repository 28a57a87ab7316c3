# SPDX-License-Identifier: BSD-3-Clause
#
# The nodelets, thin shells around the core, and the same as executables. The camera is built where OpenNI2 is found;
# sets sks_camera to whether it is.
file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
file(GLOB nodelet_sources CONFIGURE_DEPENDS src/ros/nodelets/*.cpp)
file(GLOB camera_sources CONFIGURE_DEPENDS src/ros/camera/*.cpp)
file(GLOB ros_executables CONFIGURE_DEPENDS src/ros/executables/*.cpp)

find_path(OPENNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2)
find_library(OPENNI2_LIBRARY OpenNI2)
if(OPENNI2_INCLUDE_DIR AND OPENNI2_LIBRARY)
  set(sks_camera ON)
else()
  set(sks_camera OFF)
  list(FILTER nodelet_sources EXCLUDE REGEX "/camera[^/]*$")
  list(FILTER ros_executables EXCLUDE REGEX "/camera[^/]*$")
  message(STATUS "${PROJECT_NAME} is built without its camera nodelet: it needs `apt-get install libopenni2-dev`")
endif()

# Topics of the detector in messages that not everybody has, so that package.xml does not name them; src/ros/outputs has a
# file for each package.
set(sks_output_include_dirs)
foreach(package vision_msgs jsk_recognition_msgs)
  #catkin_lint: ignore_once missing_depend
  find_package(${package} QUIET)
  if(${package}_FOUND)
    list(APPEND ros_sources src/ros/outputs/${package}.cpp)
    list(APPEND sks_output_include_dirs ${${package}_INCLUDE_DIRS})
  else()
    string(REPLACE "_" "-" package_name ${package})
    message(STATUS "${PROJECT_NAME} is built without its topic for ${package}, which is missing: with ROS Noetic "
      "`apt-get install ros-noetic-${package_name}`")
  endif()
endforeach()

# What the nodelets are made of: tests link it.
add_library(${PROJECT_NAME}_ros SHARED ${ros_sources})
add_dependencies(${PROJECT_NAME}_ros ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
target_include_directories(${PROJECT_NAME}_ros PUBLIC src)
#catkin_lint: ignore_once external_directory external_interface_path
target_include_directories(${PROJECT_NAME}_ros SYSTEM PUBLIC
  ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS}
  ${sks_output_include_dirs})
target_link_libraries(${PROJECT_NAME}_ros PUBLIC sks_build_flags ${PROJECT_NAME}_core ${PROJECT_NAME}_simulation
  ${catkin_LIBRARIES} PRIVATE sks_drawing)
sks_precompile(${PROJECT_NAME}_ros <ros/node_handle.h> <sensor_msgs/PointCloud2.h>)
set(sks_ros_libraries ${PROJECT_NAME}_ros)

if(sks_camera)
  add_library(${PROJECT_NAME}_camera SHARED ${camera_sources})
  #catkin_lint: ignore_once external_directory external_interface_path
  target_include_directories(${PROJECT_NAME}_camera SYSTEM PUBLIC ${OPENNI2_INCLUDE_DIR})
  target_link_libraries(${PROJECT_NAME}_camera PUBLIC ${PROJECT_NAME}_ros ${OPENNI2_LIBRARY})
  list(APPEND sks_ros_libraries ${PROJECT_NAME}_camera)
endif()

add_library(${PROJECT_NAME}_nodelets SHARED ${nodelet_sources})
target_link_libraries(${PROJECT_NAME}_nodelets PRIVATE ${sks_ros_libraries})
foreach(source ${ros_executables})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE ${sks_ros_libraries})
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${sks_build_bin_dir}
    INSTALL_RPATH "\$ORIGIN/${sks_bin_to_lib}")
  install(TARGETS ${name} RUNTIME DESTINATION ${sks_bin_dir})
endforeach()

include(cmake/PlanningScene.cmake)

install(TARGETS ${sks_ros_libraries} ${PROJECT_NAME}_nodelets
  ARCHIVE DESTINATION ${sks_lib_dir}
  LIBRARY DESTINATION ${sks_lib_dir}
  RUNTIME DESTINATION ${sks_bin_dir})
install(PROGRAMS scripts/measure_node.py scripts/measure_training.py scripts/play_demo.py scripts/soak scripts/train_client.py
  DESTINATION ${sks_bin_dir})
install(FILES nodelet_plugins.xml DESTINATION ${sks_share_dir})
install(DIRECTORY launch DESTINATION ${sks_share_dir})
