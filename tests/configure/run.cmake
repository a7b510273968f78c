# What a tree builds does not depend on what was installed when it was first configured: cmake -DSOURCE=DIR -DBUILD=DIR -DCOMPILER=... -P run.cmake
set(scratch ${BUILD}/configured)
file(REMOVE_RECURSE ${scratch})
set(packages_of_IMPLICIT_MESH "libopenvdb-dev")
set(packages_of_CAD "libocct-data-exchange-dev libocct-modeling-algorithms-dev")
set(packages_of_GPU "glslc libvulkan-dev")

# configure(STATUS PRINTED PRESET arguments...) -- as the workflows do, in a tree of its own.
function(configure status printed preset)
  execute_process(COMMAND ${CMAKE_COMMAND} --preset ${preset} -B ${scratch} -DCMAKE_CXX_COMPILER=${COMPILER} ${ARGN}
                  WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  set(${status} ${result} PARENT_SCOPE)
  string(REGEX REPLACE "[ \n]+" " " text "${text}")  # messages are wrapped
  set(${printed} "${text}" PARENT_SCOPE)
endfunction()
function(expect text part why)
  string(FIND "${text}" "${part}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${why}: there should be\n  ${part}\nin\n${text}")
  endif()
endfunction()

# As on a machine that has what the first command installs.
configure(status text release -DSUBLIMIT_HIDE=IMPLICIT_MESH,CAD,GPU,CUDA)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the program should be built without optional libraries:\n${text}")
endif()
foreach(part IMPLICIT_MESH CAD GPU)
  expect("${text}" "(Debian: ${packages_of_${part}})" "what ${part} needs is said")
endforeach()
expect("${text}" "CUDA the same kernels for CUDA, by clang: left out" "a part of a part goes with it")

# A part that is asked for is never left out in silence.
configure(status text test)
if(status EQUAL 0)
  message(FATAL_ERROR "tests of parts that cannot be built should not be configured:\n${text}")
endif()
foreach(part IMPLICIT_MESH CAD GPU)
  expect("${text}" "SUBLIMIT_BUILD_${part}=ON" "the error names each part")
  expect("${text}" "(Debian: ${packages_of_${part}})" "the error says what to install")
endforeach()
configure(status text test -DSUBLIMIT_BUILD_CAD=perhaps)
expect("${text}" "SUBLIMIT_BUILD_CAD is perhaps; it can be AUTO, ON or OFF" "other values are refused")

# read_tree(NAME) -- what the tree builds, as build_NAME, and the number of its tests, as total_NAME.
function(read_tree name)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "the preset test should be configured:\n${text}")
  endif()
  file(READ ${scratch}/build.ninja build)
  string(REGEX REPLACE "[^\n]*(_PDB = |VerifyGlobs[.]cmake)[^\n]*\n" "" build "${build}")  # what CMake itself read and wrote
  execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${scratch} --show-only OUTPUT_VARIABLE tests COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "Total Tests: ([0-9]+)" total "${tests}")
  set(total_${name} ${CMAKE_MATCH_1} PARENT_SCOPE)
  set(build_${name} "${build}" PARENT_SCOPE)
endfunction()

# Then the libraries are installed, and the tests are configured in the same tree: as in a tree that never was without them.
configure(status text test -USUBLIMIT_HIDE)
read_tree(later)
file(RENAME ${scratch}/build.ninja ${BUILD}/configured_later.ninja)
file(REMOVE_RECURSE ${scratch})
configure(status text test)
read_tree(at_once)
if(NOT total_later EQUAL total_at_once OR total_later EQUAL 0)
  message(FATAL_ERROR "${total_later} tests in the tree that was without libraries first, ${total_at_once} in the other one")
endif()
if(NOT build_later STREQUAL build_at_once)
  message(FATAL_ERROR "the trees build other things: compare ${BUILD}/configured_later.ninja with ${scratch}/build.ninja")
endif()
message(STATUS "${total_later} groups of tests, and the same build, either way")
