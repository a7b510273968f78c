# The tarball of the sources: the same bytes twice, complete without git, with a licence for each file: cmake -DSOURCE=DIR -DBUILD=DIR
# -DVERSION=x.y.z -P sources.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
set(scratch ${BUILD}/tarball)
file(REMOVE_RECURSE ${scratch})
set(dist ${SOURCE}/stencils/packaging/dist.cmake)
set(name sublimit-${VERSION})

# In other places, locales, time zones and modes of files.
set(ENV{SOURCE_DATE_EPOCH} 1700000000)
run(${CMAKE_COMMAND} -DSOURCE=${SOURCE} -DVERSION=${VERSION} -DOUT=${scratch}/first -P ${dist})
set(ENV{TZ} Pacific/Auckland)
run(sh -ec "umask 077 && exec ${CMAKE_COMMAND} '-DSOURCE=${SOURCE}' -DVERSION=${VERSION} '-DOUT=${scratch}/second' -P '${dist}'")
# From what was unpacked, where no git is.
file(ARCHIVE_EXTRACT INPUT ${scratch}/first/${name}.tar.gz DESTINATION ${scratch})
set(tree ${scratch}/${name})
unset(ENV{SOURCE_DATE_EPOCH})
run(${CMAKE_COMMAND} -DSOURCE=${tree} -DVERSION=${VERSION} -DOUT=${scratch}/third -P ${dist})
foreach(other second third)
  file(SHA256 ${scratch}/first/${name}.tar.gz first_sum)
  file(SHA256 ${scratch}/${other}/${name}.tar.gz other_sum)
  if(NOT first_sum STREQUAL other_sum)
    message(FATAL_ERROR "the tarball differs: ${scratch}/first and ${scratch}/${other}")
  endif()
endforeach()

# It configures by itself.
execute_process(COMMAND ${CMAKE_COMMAND} --preset release -B ${scratch}/build WORKING_DIRECTORY ${tree}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
find_program(REUSE_PROGRAM reuse)
if(REUSE_PROGRAM)
  execute_process(COMMAND ${REUSE_PROGRAM} --root ${tree} lint RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "reuse lint:\n${text}")
  endif()
elseif("$ENV{CI}")
  message(FATAL_ERROR "there is no reuse; .ci/install-deps --all installs it")
endif()
