# SPDX-License-Identifier: BSD-3-Clause
#
# Completion for bash and the manual page sks(1), made from the help texts by a program of the build; they need nothing
# else. sks_completion and sks_manual are their paths in the build.
set(sks_completion ${CMAKE_CURRENT_BINARY_DIR}/pages/sks)
set(sks_manual ${CMAKE_CURRENT_BINARY_DIR}/pages/sks.1)
file(STRINGS CHANGELOG.rst sks_release_date REGEX "^[0-9]+\\.[0-9]+\\.[0-9]+ \\([0-9-]+\\)$" LIMIT_COUNT 1)
string(REGEX REPLACE "^.*\\((.*)\\)$" "\\1" sks_release_date "${sks_release_date}")

file(GLOB page_sources CONFIGURE_DEPENDS src/tools/pages/*.cpp)
add_executable(sks_pages ${page_sources})
target_link_libraries(sks_pages PRIVATE sks_tools)
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${sks_completion} ${sks_manual}
  COMMAND sks_pages ${sks_completion} ${sks_manual} ${PROJECT_VERSION} "${sks_release_date}"
  DEPENDS sks_pages VERBATIM
  COMMENT "Making bash completion and manual page from the help texts")
add_custom_target(sks_make_pages ALL DEPENDS ${sks_completion} ${sks_manual})
