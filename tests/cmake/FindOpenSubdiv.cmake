# SPDX-License-Identifier: Apache-2.0
# OpenSubdiv's CPU library, the reference of tests and benchmarks: target OpenSubdiv::osdCPU.
# Debian's own CMake config aborts (it names a static library that the package lacks), hence this module.
find_path(OpenSubdiv_INCLUDE_DIR NAMES opensubdiv/far/topologyRefiner.h)
find_library(OpenSubdiv_osdCPU_LIBRARY NAMES osdCPU)
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_osdCPU_LIBRARY)

set(OpenSubdiv_VERSION "")
if(OpenSubdiv_INCLUDE_DIR)
  file(STRINGS ${OpenSubdiv_INCLUDE_DIR}/opensubdiv/version.h version_lines
       REGEX "^#define OPENSUBDIV_VERSION_(MAJOR|MINOR|PATCH) ")
  foreach(part MAJOR MINOR PATCH)
    string(REGEX MATCH "_${part} ([0-9]+)" match "${version_lines}")
    list(APPEND OpenSubdiv_VERSION ${CMAKE_MATCH_1})
  endforeach()
  list(JOIN OpenSubdiv_VERSION "." OpenSubdiv_VERSION)
  unset(version_lines)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdiv
  REQUIRED_VARS OpenSubdiv_osdCPU_LIBRARY OpenSubdiv_INCLUDE_DIR
  VERSION_VAR OpenSubdiv_VERSION
  REASON_FAILURE_MESSAGE "install libosd-dev: tests and benchmarks run OpenSubdiv live, and without it they prove nothing")

if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
  add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
  set_target_properties(OpenSubdiv::osdCPU PROPERTIES
    IMPORTED_LOCATION ${OpenSubdiv_osdCPU_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OpenSubdiv_INCLUDE_DIR})
endif()
