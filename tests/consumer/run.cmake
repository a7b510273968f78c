# Configures, builds and runs the foreign project KIND: against an install of the build tree BUILD into a prefix of its own, or,
# for `subdirectory`, with the sources.
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

set(place -DSUBLIMIT_SOURCE=${SOURCE})
set(targets consumer)
if(KIND STREQUAL subdirectory)
  list(APPEND targets own_scheme)
else()
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${scratch}/prefix OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  set(place -DCMAKE_PREFIX_PATH=${scratch}/prefix -DSUBLIMIT_README=${SOURCE}/README.md)
endif()
if(KIND STREQUAL lib)
  list(APPEND targets own_arrays readme_example readme_limits readme_tables readme_curves readme_scheme readme_fit)
endif()

run(log ${CMAKE_COMMAND} -S ${SOURCE}/tests/consumer/${KIND} -B ${binary} -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} ${place})
run(log ${CMAKE_COMMAND} --build ${binary} --target ${targets})
run(log ${binary}/consumer)

if(KIND STREQUAL lib)
  run(log ${binary}/own_arrays)
  run(log ${binary}/readme_limits)
  run(log ${binary}/readme_tables)
  run(log ${binary}/readme_curves)
  run(log ${binary}/readme_scheme)
  run(log ${binary}/readme_fit)
  # A position and a normal for each of the 98 vertices of a cube's second level.
  file(WRITE ${binary}/cube.obj "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
       "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
  run(points ${binary}/readme_example ${binary}/cube.obj)
  string(REGEX MATCHALL "\n" lines "${points}")
  list(LENGTH lines count)
  if(NOT count EQUAL 196 OR points MATCHES "nan|inf")
    message(FATAL_ERROR "the README's example should print 196 finite rows for a cube, not ${count}")
  endif()
endif()
