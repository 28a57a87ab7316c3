# SPDX-License-Identifier: BSD-3-Clause
#
# Sharing of work between processes by MPI, in a library that `sks` loads only where a launcher has started several.
set(SKS_MPI AUTO CACHE STRING "Share work between processes: AUTO (where MPI is found), ON or OFF")
set_property(CACHE SKS_MPI PROPERTY STRINGS AUTO ON OFF)
if(SKS_MPI STREQUAL "OFF")
  return()
endif()
set(MPI_CXX_SKIP_MPICXX ON)
find_package(MPI QUIET COMPONENTS CXX)
if(NOT MPI_CXX_FOUND)
  if(NOT SKS_MPI STREQUAL "AUTO")
    message(FATAL_ERROR "SKS_MPI=${SKS_MPI} needs MPI: install it with `apt-get install libopenmpi-dev openmpi-bin`")
  endif()
  message(STATUS "${PROJECT_NAME} is built without MPI: to share work between machines it needs "
    "`apt-get install libopenmpi-dev openmpi-bin`")
  return()
endif()
file(GLOB mpi_sources CONFIGURE_DEPENDS src/tools/cluster/mpi/*.cpp)
add_library(${PROJECT_NAME}_mpi MODULE ${mpi_sources})
target_include_directories(${PROJECT_NAME}_mpi PRIVATE src)
target_link_libraries(${PROJECT_NAME}_mpi PRIVATE sks_build_flags ${PROJECT_NAME}_core MPI::MPI_CXX)
# Debian wants it of what is in a folder of libraries; CMake gives modules none.
target_link_options(${PROJECT_NAME}_mpi PRIVATE "LINKER:-soname,lib${PROJECT_NAME}_mpi.so")
set_target_properties(${PROJECT_NAME}_mpi PROPERTIES INSTALL_RPATH "\$ORIGIN")
add_dependencies(sks ${PROJECT_NAME}_mpi)
install(TARGETS ${PROJECT_NAME}_mpi LIBRARY DESTINATION ${sks_lib_dir})
