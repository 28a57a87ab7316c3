# SPDX-License-Identifier: BSD-3-Clause
#
# Installs library, headers, command line and presets, and the CMake package sks_detector with sks_detector::core.
# catkin_package() writes the package's configuration file in a catkin build; the targets are then its extra file's.
include(CMakePackageConfigHelpers)

install(TARGETS sks_detector_core EXPORT sks_detectorTargets
  ARCHIVE DESTINATION ${sks_lib_dir}
  LIBRARY DESTINATION ${sks_lib_dir}
  RUNTIME DESTINATION ${sks_bin_dir})
if(TARGET sks)
  install(TARGETS sks RUNTIME DESTINATION ${sks_bin_dir})
endif()
install(DIRECTORY include/sks_detector/ DESTINATION ${sks_include_dir}/sks_detector FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY config DESTINATION ${sks_share_dir} FILES_MATCHING PATTERN "*.yaml")

export(EXPORT sks_detectorTargets NAMESPACE sks_detector:: FILE ${CMAKE_CURRENT_BINARY_DIR}/sks_detectorTargets.cmake)
install(EXPORT sks_detectorTargets NAMESPACE sks_detector:: DESTINATION ${sks_cmake_dir})
if(NOT SKS_CATKIN)
  configure_package_config_file(cmake/sks_detectorConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/sks_detectorConfig.cmake
    INSTALL_DESTINATION ${sks_cmake_dir})
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/sks_detectorConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sks_detectorConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/sks_detectorConfigVersion.cmake
    DESTINATION ${sks_cmake_dir})
endif()
