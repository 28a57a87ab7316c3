# SPDX-License-Identifier: BSD-3-Clause
#
# The virtual RGB-D camera: training from meshes, synthetic scenes.
file(GLOB simulation_sources CONFIGURE_DEPENDS src/simulation/*.cpp)
add_library(${PROJECT_NAME}_simulation SHARED ${simulation_sources})
add_library(${PROJECT_NAME}::simulation ALIAS ${PROJECT_NAME}_simulation)
target_include_directories(${PROJECT_NAME}_simulation PRIVATE src)
target_include_directories(${PROJECT_NAME}_simulation SYSTEM PRIVATE
  ${ASSIMP_INCLUDE_DIR} ${EMBREE_INCLUDE_DIR} ${BULLET_INCLUDE_DIRS})
target_link_libraries(${PROJECT_NAME}_simulation
  PUBLIC ${PROJECT_NAME}_core
  PRIVATE $<BUILD_INTERFACE:sks_build_flags> $<BUILD_INTERFACE:sks_fast_loops> ${ASSIMP_LIBRARY} ${EMBREE_LIBRARY}
    ${BULLET_LIBRARIES} OpenMP::OpenMP_CXX)
sks_precompile(${PROJECT_NAME}_simulation)
set_target_properties(${PROJECT_NAME}_simulation PROPERTIES
  EXPORT_NAME simulation
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
