# pip installs the package from a checkout, and leaves the checkout as it was: cmake -DPYTHON=... -DSOURCE=DIR -DBUILD=DIR -P pip.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
set(target ${BUILD}/pip)
file(REMOVE_RECURSE ${target})
set(ENV{SUBLIMIT_BUILD_DIR} ${BUILD})
file(GLOB_RECURSE before RELATIVE ${SOURCE} ${SOURCE}/stencils/python/*)
run(${PYTHON} -m pip install --quiet --no-build-isolation --no-deps --target ${target} ${SOURCE}/stencils/python)
file(GLOB_RECURSE after RELATIVE ${SOURCE} ${SOURCE}/stencils/python/*)
if(NOT before STREQUAL after)
  message(FATAL_ERROR "pip left files beside the sources:\n${after}\ninstead of\n${before}")
endif()
set(ENV{PYTHONPATH} ${target})
run(${PYTHON} -c "
import sublimit
assert sublimit.__version__ and '${target}' in sublimit.__file__, sublimit.__file__
mesh = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
assert len(sublimit.refine(mesh, 'loop', levels=2).points) == 34
assert sublimit.limit(mesh, 'loop').points.shape == (4, 3)
")
