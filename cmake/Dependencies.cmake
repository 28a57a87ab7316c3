# SPDX-License-Identifier: BSD-3-Clause
#
# Finds what the build needs. What Ubuntu 20.04 does not package (CLI11, Highway) is fetched at a pinned version where
# it is not installed; for everything else a message names the apt package.
include(FetchContent)

# Stops where one of the variables says that nothing was found, and names the apt packages.
function(sks_need_library name apt_packages)
  foreach(variable ${ARGN})
    if(NOT ${variable})
      message(FATAL_ERROR "${PROJECT_NAME} needs ${name}: install it with `apt-get install ${apt_packages}`, or run "
        "scripts/install_dependencies.")
    endif()
  endforeach()
endfunction()

# find_package() that names the apt package where nothing is found.
macro(sks_find_package name apt_package)
  find_package(${name} QUIET ${ARGN})
  sks_need_library(${name} ${apt_package} ${name}_FOUND)
endmacro()

# Adds a library to this build from source, linked statically.
function(sks_fetch name repository tag)
  message(STATUS "${name} is not installed: fetching ${tag} from ${repository}")
  set(BUILD_SHARED_LIBS OFF)
  set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)  # so that its option(BUILD_SHARED_LIBS) does not drop ours
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  FetchContent_Declare(${name} GIT_REPOSITORY ${repository} GIT_TAG ${tag} GIT_SHALLOW TRUE)
  FetchContent_MakeAvailable(${name})
endfunction()

sks_find_package(Eigen3 libeigen3-dev)
sks_find_package(OpenMP libgomp1 COMPONENTS CXX)
sks_find_package(yaml-cpp libyaml-cpp-dev)
sks_find_package(nlohmann_json nlohmann-json3-dev)

sks_find_package(PNG libpng-dev)
sks_find_package(JPEG libjpeg-dev)

# The generated code needs only headers of FlatBuffers, whose CMake package has a different name in every release.
find_path(FLATBUFFERS_INCLUDE_DIR flatbuffers/flatbuffers.h)
find_program(FLATC_EXECUTABLE flatc)
sks_need_library(FlatBuffers "libflatbuffers-dev flatbuffers-compiler" FLATBUFFERS_INCLUDE_DIR FLATC_EXECUTABLE)

find_package(hwy CONFIG QUIET)
if(hwy_FOUND)
  set(sks_hwy_target hwy::hwy)
else()
  set(sks_hwy_target hwy)
  set(HWY_ENABLE_CONTRIB OFF CACHE BOOL "" FORCE)
  set(HWY_ENABLE_EXAMPLES OFF CACHE BOOL "" FORCE)
  set(HWY_ENABLE_INSTALL OFF CACHE BOOL "" FORCE)
  set(HWY_ENABLE_TESTS OFF CACHE BOOL "" FORCE)
  sks_fetch(hwy https://github.com/google/highway.git 1.0.3)
endif()

# Neither assimp nor Embree has a CMake package that works in all releases.
find_path(ASSIMP_INCLUDE_DIR assimp/scene.h)
find_library(ASSIMP_LIBRARY assimp)
find_path(EMBREE_INCLUDE_DIR embree3/rtcore.h)
find_library(EMBREE_LIBRARY embree3)
sks_need_library(assimp libassimp-dev ASSIMP_INCLUDE_DIR ASSIMP_LIBRARY)
sks_need_library("Embree 3" libembree-dev EMBREE_INCLUDE_DIR EMBREE_LIBRARY)
sks_find_package(Bullet libbullet-dev MODULE)
sks_find_package(Ceres libceres-dev)
set(sks_ceres_target ceres)  # the name in all releases

if(SKS_BUILD_TOOLS)
  find_package(CLI11 CONFIG QUIET)
  if(NOT CLI11_FOUND)
    set(CLI11_BUILD_DOCS OFF CACHE BOOL "" FORCE)
    set(CLI11_BUILD_EXAMPLES OFF CACHE BOOL "" FORCE)
    set(CLI11_BUILD_TESTS OFF CACHE BOOL "" FORCE)
    sks_fetch(CLI11 https://github.com/CLIUtils/CLI11.git v2.1.2)
  endif()
endif()

# Generates <name>_generated.h from a schema into the build folder and lets `target` include it.
function(sks_add_flatbuffers_header target schema)
  get_filename_component(name ${schema} NAME_WE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(header ${folder}/${name}_generated.h)
  add_custom_command(OUTPUT ${header}
    COMMAND ${FLATC_EXECUTABLE} --cpp -o ${folder} ${CMAKE_CURRENT_SOURCE_DIR}/${schema}
    DEPENDS ${schema}
    COMMENT "Generating ${name}_generated.h"
    VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} SYSTEM PRIVATE ${folder})
endfunction()
