# A wheel, in a virtual environment with NumPy of the system, and the sources that pip makes one from: cmake -DPYTHON=... -DSOURCE=DIR
# -DBUILD=DIR -DVERSION=x.y.z -P wheel.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
set(scratch ${BUILD}/wheels)
file(REMOVE_RECURSE ${scratch})
set(ENV{SUBLIMIT_BUILD_DIR} ${BUILD})
run(${PYTHON} -m pip wheel --quiet --no-build-isolation --no-deps -w ${scratch} ${SOURCE}/stencils/python)
file(GLOB wheel ${scratch}/sublimit-${VERSION}-*.whl)
run(${PYTHON} -m venv --system-site-packages --without-pip ${scratch}/venv)
run(${PYTHON} -m pip --python ${scratch}/venv/bin/python install --quiet --no-index --no-deps ${wheel})
execute_process(COMMAND ${scratch}/venv/bin/python -c "
import sublimit
assert sublimit.__file__.startswith('${scratch}/venv'), sublimit.__file__
mesh = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
assert sublimit.limit(mesh, 'loop').points.shape == (4, 3)
" WORKING_DIRECTORY ${scratch} COMMAND_ERROR_IS_FATAL ANY)

# The sources: those of the project, and what a wheel is made by, which is what it is made by here.
execute_process(COMMAND ${PYTHON} -c "from setuptools import build_meta; build_meta.build_sdist('${scratch}')" WORKING_DIRECTORY ${SOURCE}/stencils/python
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(ARCHIVE_EXTRACT INPUT ${scratch}/sublimit-${VERSION}.tar.gz DESTINATION ${scratch})
set(tree ${scratch}/sublimit-${VERSION})
include(${SOURCE}/stencils/packaging/sources.cmake)
sublimit_sources(${SOURCE} files)
foreach(file IN LISTS files)
  if(file MATCHES "^(bench|tests)/")
    continue()
  endif()
  file(SHA256 ${SOURCE}/${file} ours)
  file(SHA256 ${tree}/source/${file} theirs)
  if(NOT ours STREQUAL theirs)
    message(FATAL_ERROR "${tree}/source/${file} is not ${file}")
  endif()
endforeach()
# Configured from there, the module can be built; that it is, the wheel has shown.
execute_process(COMMAND ${CMAKE_COMMAND} --preset release -B ${scratch}/build -DSUBLIMIT_BUILD_PYTHON=ON -DSUBLIMIT_PYTHON=${PYTHON}
                WORKING_DIRECTORY ${tree}/source OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
