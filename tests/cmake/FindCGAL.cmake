# SPDX-License-Identifier: Apache-2.0
# CGAL's headers, a reference of tests and benchmarks: target CGAL::CGAL. CGAL's own CMake config would add compiler flags
# and watch the build type; its subdivision needs neither these nor GMP, only its headers and Boost's.
find_path(CGAL_INCLUDE_DIR NAMES CGAL/subdivision_method_3.h)
mark_as_advanced(CGAL_INCLUDE_DIR)

set(CGAL_VERSION "")
if(CGAL_INCLUDE_DIR)
  file(STRINGS ${CGAL_INCLUDE_DIR}/CGAL/version.h version_line REGEX "^#define CGAL_VERSION ")
  string(REGEX REPLACE "^#define CGAL_VERSION +" "" CGAL_VERSION "${version_line}")
  unset(version_line)
endif()
find_package(Boost 1.74 QUIET)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CGAL
  REQUIRED_VARS CGAL_INCLUDE_DIR Boost_FOUND
  VERSION_VAR CGAL_VERSION
  REASON_FAILURE_MESSAGE "install libcgal-dev: tests and benchmarks run CGAL live, and without it they prove nothing")

if(CGAL_FOUND AND NOT TARGET CGAL::CGAL)
  add_library(CGAL::CGAL INTERFACE IMPORTED)
  target_include_directories(CGAL::CGAL SYSTEM INTERFACE ${CGAL_INCLUDE_DIR})
  target_link_libraries(CGAL::CGAL INTERFACE Boost::headers)
endif()
