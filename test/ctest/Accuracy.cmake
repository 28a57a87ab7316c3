# SPDX-License-Identifier: BSD-3-Clause
#
# An entry of ctest for each data set of accuracy_limits.yaml; the codebook that it names is trained once for all.
# Each uses all cores: PROCESSORS keeps others away.
set(limits ${CMAKE_CURRENT_SOURCE_DIR}/accuracy_limits.yaml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${limits})
set(accuracy_command ${SKS_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/accuracy_test.py --sks $<TARGET_FILE:sks>
  --folder ${CMAKE_CURRENT_BINARY_DIR}/accuracy)
set(accuracy_codebooks)
file(STRINGS ${limits} accuracy_lines REGEX "^[^# ].*codebook:")
foreach(line ${accuracy_lines})
  if(NOT line MATCHES "^([^: ]+): *{codebook: *([^, ]+)")
    message(FATAL_ERROR "${limits}: not 'name: {codebook: name, ...': ${line}")
  endif()
  set(set ${CMAKE_MATCH_1})
  set(codebook ${CMAKE_MATCH_2})
  if(NOT codebook IN_LIST accuracy_codebooks)
    list(APPEND accuracy_codebooks ${codebook})
    add_test(NAME accuracy.train.${codebook} COMMAND ${accuracy_command} --train ${codebook})
    set_tests_properties(accuracy.train.${codebook} PROPERTIES FIXTURES_SETUP codebook_${codebook}
      LABELS accuracy SKIP_RETURN_CODE 77 PROCESSORS 2 TIMEOUT 1200)
  endif()
  add_test(NAME accuracy.${set} COMMAND ${accuracy_command} ${set})
  set_tests_properties(accuracy.${set} PROPERTIES FIXTURES_REQUIRED codebook_${codebook}
    LABELS accuracy SKIP_RETURN_CODE 77 PROCESSORS 2 TIMEOUT 1200)
endforeach()
