# Configures, builds and runs the foreign project KIND: against an install of the build tree BUILD into a prefix of its own, or,
# for `subdirectory`, with the sources. Of `components` nothing is built.
set(scratch ${BUILD}/consumer/${KIND})
set(binary ${scratch}/build)
file(REMOVE_RECURSE ${scratch})

# run(OUTPUT command...) -- prints what the command prints, and sets OUTPUT to it.
function(run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE printed ECHO_OUTPUT_VARIABLE)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${status}): ${command}")
  endif()
  set(${output} "${printed}" PARENT_SCOPE)
endfunction()

set(targets all)
if(KIND STREQUAL subdirectory)
  set(targets consumer own_scheme)  # all would be the whole library
  set(place "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG")  # whether it can be built, not how fast it is
else()
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${scratch}/prefix OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  set(place -DCMAKE_PREFIX_PATH=${scratch}/prefix)
  if(KIND MATCHES "^(jobs|headers)$")
    list(APPEND place "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG")  # whether they can be written, not how fast they are
  endif()
endif()

set(configure ${CMAKE_COMMAND} -S ${SOURCE}/tests/consumer/${KIND} -B ${binary} -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DSUBLIMIT_SOURCE=${SOURCE} ${place})
run(log ${configure})
if(KIND STREQUAL components)
  execute_process(COMMAND ${configure} -DREQUIRED_PART=nonsense RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE printed)
  string(REGEX REPLACE "[ \n]+" " " printed "${printed}")
  if(status EQUAL 0 OR NOT printed MATCHES "sublimit::nonsense: there is no such component, but base, eval, ")
    message(FATAL_ERROR "a required component that does not exist ends a configuration (${status}) with\n${printed}")
  endif()
  return()
endif()
run(log ${CMAKE_COMMAND} --build ${binary} --target ${targets})
if(NOT KIND STREQUAL jobs)
  run(log ${binary}/consumer)
endif()

if(NOT KIND STREQUAL subdirectory)
  run(log ${CMAKE_CTEST_COMMAND} --test-dir ${binary} --no-tests=error --output-on-failure)
endif()
if(KIND STREQUAL lib)
  # A position and a normal for each of the 98 vertices of a cube's second level.
  run(points ${binary}/readme_example ${binary}/cube.obj)
  string(REGEX MATCHALL "\n" lines "${points}")
  list(LENGTH lines count)
  if(NOT count EQUAL 196 OR points MATCHES "nan|inf")
    message(FATAL_ERROR "the README's example should print 196 finite rows for a cube, not ${count}")
  endif()
endif()
