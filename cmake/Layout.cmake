# SPDX-License-Identifier: BSD-3-Clause
#
# Where things are built and installed: catkin's layout in a catkin build, GNU's elsewhere.
if(NOT SKS_CATKIN)
  include(GNUInstallDirs)
  set(sks_include_root ${CMAKE_INSTALL_INCLUDEDIR})
  set(sks_include_dir ${CMAKE_INSTALL_INCLUDEDIR}/${PROJECT_NAME})
  set(sks_lib_dir ${CMAKE_INSTALL_LIBDIR})
  set(sks_bin_dir ${CMAKE_INSTALL_BINDIR})
  set(sks_data_dir ${CMAKE_INSTALL_DATADIR})
  set(sks_share_dir ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME})
  set(sks_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/${PROJECT_NAME})
  set(sks_build_bin_dir ${CMAKE_CURRENT_BINARY_DIR})
  set(sks_testing_default ON)
else()
  find_package(catkin REQUIRED)
  include(cmake/RosMessages.cmake)
  catkin_package(
    INCLUDE_DIRS include
    LIBRARIES ${PROJECT_NAME}_core
    CATKIN_DEPENDS ${sks_message_dependencies}
    DEPENDS EIGEN3
    CFG_EXTRAS ${PROJECT_NAME}-extras.cmake)
  set(sks_include_root ${CATKIN_GLOBAL_INCLUDE_DESTINATION})
  set(sks_include_dir ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
  set(sks_lib_dir ${CATKIN_PACKAGE_LIB_DESTINATION})
  set(sks_bin_dir ${CATKIN_PACKAGE_BIN_DESTINATION})
  set(sks_data_dir ${CATKIN_GLOBAL_SHARE_DESTINATION})
  set(sks_share_dir ${CATKIN_PACKAGE_SHARE_DESTINATION})
  set(sks_cmake_dir ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
  set(sks_build_bin_dir ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  set(sks_testing_default ${CATKIN_ENABLE_TESTING})
endif()
file(RELATIVE_PATH sks_bin_to_lib /${sks_bin_dir} /${sks_lib_dir})
