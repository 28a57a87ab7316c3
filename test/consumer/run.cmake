# SPDX-License-Identifier: BSD-3-Clause
#
# Installs a build, builds the consumer against it in an empty folder and runs both the consumer and the installed
# command line. Called as cmake -D... -P run.cmake with WORK_DIR, the folder for everything that is written, which is
# emptied first, and one of
#   BUILD_DIR   build that is installed as it is
#   SOURCE_DIR  checkout that is built as plain CMake first
#   SPACE_DIR   folder of sks_detectorConfig.cmake to use without an installation (catkin's devel space)
# and SKS, the command line's path under the prefix, where it is to be run.
cmake_minimum_required(VERSION 3.16)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}: ${result}")
  endif()
endfunction()

set(prefix ${WORK_DIR}/prefix)
set(consumer ${WORK_DIR}/consumer)
file(REMOVE_RECURSE ${WORK_DIR})

if(SPACE_DIR)
  set(location -Dsks_detector_DIR=${SPACE_DIR})
else()
  set(location -DCMAKE_PREFIX_PATH=${prefix})
  if(SOURCE_DIR)
    set(BUILD_DIR ${WORK_DIR}/build)
    # Without optimisation and debug information, which would only cost time here.
    run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${BUILD_DIR} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=
      -DSKS_BUILD_TESTING=OFF -DSKS_BUILD_BENCHMARKS=OFF)
    cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
    run(${CMAKE_COMMAND} --build ${BUILD_DIR} --parallel ${cores})
  endif()
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
endif()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${consumer} ${location})
run(${CMAKE_COMMAND} --build ${consumer})
run(${consumer}/consumer)
if(SKS)
  run(${prefix}/${SKS} --help)
  foreach(file bash-completion/completions/sks man/man1/sks.1)
    if(NOT SPACE_DIR AND NOT EXISTS ${prefix}/share/${file})
      message(FATAL_ERROR "share/${file} was not installed")
    endif()
  endforeach()
endif()
if(NOT SPACE_DIR)
  foreach(file config/paper.yaml scripts/plot_evaluation.py)
    if(NOT EXISTS ${prefix}/share/sks_detector/${file})
      message(FATAL_ERROR "share/sks_detector/${file} was not installed")
    endif()
  endforeach()
endif()
