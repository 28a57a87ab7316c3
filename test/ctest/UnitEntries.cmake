# SPDX-License-Identifier: BSD-3-Clause
#
# sks_add_unit_tests(TARGET PREFIX SOURCES... [ENVIRONMENT NAME=VALUE] [LABEL label]): one entry of ctest for each source
# of a program of GoogleTest, PREFIX.<file without _test.cpp>, and PREFIX.every_case_is_run, which compares them with the
# cases that the program lists. The entries are written when the program is linked; see unit_entries.py.
find_program(SKS_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(NOT SKS_PYTHON)
  find_program(SKS_PYTHON python3)
endif()
if(NOT SKS_PYTHON)
  message(FATAL_ERROR "The tests need python3: install it, or turn the tests off with -DSKS_BUILD_TESTING=OFF.")
endif()
set(sks_ctest_dir ${CMAKE_CURRENT_LIST_DIR})
set(sks_only_slow ${CMAKE_CURRENT_LIST_DIR}/only_slow)

function(sks_add_unit_tests target prefix)
  cmake_parse_arguments(arg "" "ENVIRONMENT;LABEL" "SOURCES" ${ARGN})
  if(NOT arg_LABEL)
    set(arg_LABEL unit)
  endif()
  set(script ${sks_ctest_dir}/unit_entries.py)
  set(entries ${CMAKE_CURRENT_BINARY_DIR}/${target}_entries.cmake)
  set(include_file ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
  set(environment)
  if(arg_ENVIRONMENT)
    set(environment --environment=${arg_ENVIRONMENT})
  endif()
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND ${SKS_PYTHON} ${script} --program $<TARGET_FILE:${target}> --entries ${entries} --prefix ${prefix}
      --label ${arg_LABEL} ${environment} --slow-runner ${sks_only_slow} --sources ${arg_SOURCES}
    BYPRODUCTS ${entries}
    VERBATIM)
  # As with gtest_discover_tests(): what was not built is an entry that fails.
  file(WRITE ${include_file} "if(EXISTS \"${entries}\")
  include(\"${entries}\")
else()
  add_test(${prefix}.not_built ${target}_is_not_built)
  set_tests_properties(${prefix}.not_built PROPERTIES LABELS ${arg_LABEL})
endif()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include_file})
  add_test(NAME ${prefix}.every_case_is_run
    COMMAND ${SKS_PYTHON} ${script} --check --program $<TARGET_FILE:${target}> --entries ${entries} ${environment})
  set_tests_properties(${prefix}.every_case_is_run PROPERTIES LABELS ${arg_LABEL})
endfunction()
