# SPDX-License-Identifier: BSD-3-Clause
#
# Installs library, headers, command line and presets, and the CMake package sks_detector with sks_detector::core.
# catkin_package() writes the package's configuration file in a catkin build; the targets are then its extra file's.
include(CMakePackageConfigHelpers)

install(TARGETS ${PROJECT_NAME}_core ${PROJECT_NAME}_simulation EXPORT ${PROJECT_NAME}Targets
  ARCHIVE DESTINATION ${sks_lib_dir}
  LIBRARY DESTINATION ${sks_lib_dir}
  RUNTIME DESTINATION ${sks_bin_dir})
if(TARGET sks)
  install(TARGETS sks RUNTIME DESTINATION ${sks_bin_dir})
  #catkin_lint: ignore_once external_file
  install(FILES ${sks_completion} DESTINATION ${sks_data_dir}/bash-completion/completions)
  #catkin_lint: ignore_once external_file
  install(FILES ${sks_manual} DESTINATION ${sks_data_dir}/man/man1)
endif()
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${sks_include_dir} FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY config DESTINATION ${sks_share_dir} FILES_MATCHING PATTERN "*.yaml" PATTERN "*.rviz")
#catkin_lint: ignore_once wrong_bin_install_destination
install(PROGRAMS scripts/plot_evaluation.py scripts/plot_keypoints.py DESTINATION ${sks_share_dir}/scripts)
# The other scripts serve the checkout.
#catkin_lint: ignore uninstalled_script

export(EXPORT ${PROJECT_NAME}Targets NAMESPACE ${PROJECT_NAME}::
  FILE ${CMAKE_CURRENT_BINARY_DIR}/${PROJECT_NAME}Targets.cmake)
install(EXPORT ${PROJECT_NAME}Targets NAMESPACE ${PROJECT_NAME}:: DESTINATION ${sks_cmake_dir})
option(SKS_PLAIN_CMAKE_PACKAGE "From a catkin build, install the CMake package for programs without ROS too" OFF)
if(NOT SKS_CATKIN OR SKS_PLAIN_CMAKE_PACKAGE)
  set(sks_plain_cmake_dir ${sks_cmake_dir})
  if(SKS_CATKIN)
    set(sks_plain_cmake_dir ${sks_lib_dir}/cmake/${PROJECT_NAME})
    install(EXPORT ${PROJECT_NAME}Targets NAMESPACE ${PROJECT_NAME}:: DESTINATION ${sks_plain_cmake_dir})
  endif()
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/plain/${PROJECT_NAME}ConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  #catkin_lint: ignore_once missing_file wrong_install_destination
  install(FILES cmake/${PROJECT_NAME}Config.cmake ${CMAKE_CURRENT_BINARY_DIR}/plain/${PROJECT_NAME}ConfigVersion.cmake
    DESTINATION ${sks_plain_cmake_dir})
  if(SKS_CATKIN)
    # What catkin_package() wrote has the same name, and with Debian's catkin the same folder: the one above includes it.
    #catkin_lint: ignore_once external_file missing_file wrong_install_destination
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/catkin_generated/installspace/${PROJECT_NAME}Config.cmake
      DESTINATION ${sks_plain_cmake_dir} RENAME ${PROJECT_NAME}Catkin.cmake)
  endif()
endif()
