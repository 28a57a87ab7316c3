# SPDX-License-Identifier: BSD-3-Clause
#
# What scripts/fuzz, scripts/sanitize and scripts/coverage build with; for all targets alike, since the run-time of a
# sanitizer has to see every one of them. Included before the first target.
set(SKS_INSTRUMENT "" CACHE STRING "Instrument what is built: address, thread, fuzz (clang only), coverage; empty: not")
set_property(CACHE SKS_INSTRUMENT PROPERTY STRINGS "" address thread fuzz coverage)

if(SKS_INSTRUMENT STREQUAL "address")
  set(sks_instrument_flags -fsanitize=address,undefined,float-cast-overflow)
  # With this sanitizer Eigen aligns memory by itself; the PCL that is linked was built without and frees what we allocate.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
elseif(SKS_INSTRUMENT STREQUAL "thread")
  set(sks_instrument_flags -fsanitize=thread)
elseif(SKS_INSTRUMENT STREQUAL "fuzz")
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "SKS_INSTRUMENT=fuzz needs clang: configure with -DCMAKE_CXX_COMPILER=clang++, or run scripts/fuzz")
  endif()
  set(sks_instrument_flags -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow)
elseif(SKS_INSTRUMENT STREQUAL "coverage")
  set(sks_instrument_flags --coverage -fprofile-update=atomic)
elseif(NOT SKS_INSTRUMENT STREQUAL "")
  message(FATAL_ERROR "SKS_INSTRUMENT=${SKS_INSTRUMENT} is unknown: use address, thread, fuzz or coverage")
endif()
if(SKS_INSTRUMENT STREQUAL "fuzz")
  # Comparisons are traced where text and bytes are taken apart; the mathematics would only be slowed down by it.
  file(GLOB sks_untraced src/core/*/*.cpp src/simulation/*.cpp)
  set_source_files_properties(${sks_untraced} PROPERTIES COMPILE_OPTIONS -fno-sanitize-coverage=trace-cmp)
endif()
if(sks_instrument_flags)
  if(NOT SKS_INSTRUMENT STREQUAL "coverage")
    list(APPEND sks_instrument_flags -fno-sanitize-recover=undefined,float-cast-overflow -fno-omit-frame-pointer)
  endif()
  add_compile_options(${sks_instrument_flags})
  add_link_options(${sks_instrument_flags})
endif()
