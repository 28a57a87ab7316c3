# SPDX-License-Identifier: BSD-3-Clause
#
# The virtual RGB-D camera: training from meshes, synthetic scenes. Built where assimp, Embree 3 and Bullet are found.
# Sets sks_simulation to whether it is built.
find_path(ASSIMP_INCLUDE_DIR assimp/scene.h)
find_library(ASSIMP_LIBRARY assimp)
find_path(EMBREE_INCLUDE_DIR embree3/rtcore.h)
find_library(EMBREE_LIBRARY embree3)
find_package(Bullet QUIET MODULE)

set(sks_missing)
if(NOT ASSIMP_INCLUDE_DIR OR NOT ASSIMP_LIBRARY)
  list(APPEND sks_missing libassimp-dev)
endif()
if(NOT EMBREE_INCLUDE_DIR OR NOT EMBREE_LIBRARY)
  list(APPEND sks_missing libembree-dev)
endif()
if(NOT BULLET_FOUND)
  list(APPEND sks_missing libbullet-dev)
endif()
string(REPLACE ";" " " sks_missing "${sks_missing}")

if(sks_missing)
  set(sks_simulation OFF)
  message(STATUS "${PROJECT_NAME} is built without its virtual camera (`sks simulate`, training from meshes): it needs "
    "`apt-get install ${sks_missing}`")
else()
  set(sks_simulation ON)
  file(GLOB simulation_sources CONFIGURE_DEPENDS src/simulation/*.cpp)
  add_library(${PROJECT_NAME}_simulation SHARED ${simulation_sources})
  add_library(${PROJECT_NAME}::simulation ALIAS ${PROJECT_NAME}_simulation)
  target_include_directories(${PROJECT_NAME}_simulation PRIVATE src)
  target_include_directories(${PROJECT_NAME}_simulation SYSTEM PRIVATE
    ${ASSIMP_INCLUDE_DIR} ${EMBREE_INCLUDE_DIR} ${BULLET_INCLUDE_DIRS})
  target_link_libraries(${PROJECT_NAME}_simulation
    PUBLIC ${PROJECT_NAME}_core
    PRIVATE $<BUILD_INTERFACE:sks_build_flags> $<BUILD_INTERFACE:sks_fast_loops> ${ASSIMP_LIBRARY} ${EMBREE_LIBRARY} ${BULLET_LIBRARIES}
      OpenMP::OpenMP_CXX opencv_core opencv_imgcodecs)
  sks_precompile(${PROJECT_NAME}_simulation)
  set_target_properties(${PROJECT_NAME}_simulation PROPERTIES
    EXPORT_NAME simulation
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()
