# SPDX-License-Identifier: BSD-3-Clause
#
# The Python module sks_detector, where pybind11 is found: a package of Python files with the compiled part _core. In a
# catkin workspace it shares its folder with the generated messages. Sets sks_python_path, the folder for PYTHONPATH, where
# the module is built. Not with sanitizers and the like, whose run-time python3 does not have.
option(SKS_PYTHON_MODULE "Build the Python module where pybind11 is found" ON)
if(NOT SKS_PYTHON_MODULE OR SKS_INSTRUMENT)
  return()
endif()
# pybind11 is headers only. Of Python what the interpreter says of itself: CMake's ways to find it change with releases.
set(sks_interpreter ${PYTHON_EXECUTABLE})
if(NOT sks_interpreter)
  find_program(SKS_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
  find_program(SKS_PYTHON python3)
  set(sks_interpreter ${SKS_PYTHON})
endif()
set(sks_python_facts)
if(sks_interpreter)
  execute_process(COMMAND ${sks_interpreter} -c "import sysconfig, numpy
print(sysconfig.get_path('include'), sysconfig.get_config_var('EXT_SUFFIX'), sysconfig.get_python_version(), sep=';')"
    OUTPUT_VARIABLE sks_python_facts ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
find_path(PYBIND11_INCLUDE_DIR pybind11/pybind11.h)
set(sks_python_headers)
if(sks_python_facts)
  list(GET sks_python_facts 0 sks_python_headers)
  list(GET sks_python_facts 1 sks_python_suffix)
  list(GET sks_python_facts 2 sks_python_version)
endif()
if(NOT PYBIND11_INCLUDE_DIR OR NOT EXISTS "${sks_python_headers}/Python.h")
  message(STATUS "${PROJECT_NAME} is built without its Python module: it needs `apt-get install pybind11-dev "
    "python3-dev python3-numpy`")
  return()
endif()

if(SKS_CATKIN)
  set(sks_python_path ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION})
  set(sks_python_dir ${CATKIN_PACKAGE_PYTHON_DESTINATION})
else()
  set(sks_python_path ${CMAKE_CURRENT_BINARY_DIR}/python)
  set(sks_python_dir lib/python${sks_python_version}/dist-packages/${PROJECT_NAME})
endif()
# Of the messages' package only an empty __init__.py is generated, and only where there is none yet.
set(sks_python_files)
foreach(name __init__.py __init__.pyi py.typed)
  configure_file(python/${PROJECT_NAME}/${name} ${sks_python_path}/${PROJECT_NAME}/${name} COPYONLY)
  list(APPEND sks_python_files python/${PROJECT_NAME}/${name})
endforeach()

file(GLOB python_sources CONFIGURE_DEPENDS src/python/*.cpp)
# What the command line prints as JSON; not its library, which needs far more.
foreach(name detection_json evaluation_json object_models settings_json)
  list(APPEND python_sources src/tools/${name}.cpp)
endforeach()
add_library(sks_python MODULE ${python_sources})
target_include_directories(sks_python PRIVATE src)
#catkin_lint: ignore_once external_directory
target_include_directories(sks_python SYSTEM PRIVATE ${PYBIND11_INCLUDE_DIR} ${sks_python_headers})
target_link_libraries(sks_python PRIVATE sks_build_flags sks_drawing ${PROJECT_NAME}_simulation ${PROJECT_NAME}_core
  nlohmann_json::nlohmann_json)
file(RELATIVE_PATH sks_python_to_lib /${sks_python_dir} /${sks_lib_dir})
set_target_properties(sks_python PROPERTIES
  OUTPUT_NAME _core
  PREFIX ""
  SUFFIX "${sks_python_suffix}"
  CXX_VISIBILITY_PRESET hidden
  LIBRARY_OUTPUT_DIRECTORY ${sks_python_path}/${PROJECT_NAME}
  INSTALL_RPATH "\$ORIGIN/${sks_python_to_lib}")

install(TARGETS sks_python LIBRARY DESTINATION ${sks_python_dir})
install(FILES ${sks_python_files} DESTINATION ${sks_python_dir})
