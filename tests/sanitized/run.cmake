# Builds TARGET under the address and undefined-behaviour sanitizers, the library with it, and runs it.
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
set(binary ${BUILD}/sanitized)
# Warnings are errors where the flags that ship are; other flags make g++ see other things.
run(${CMAKE_COMMAND} --preset asan -S ${SOURCE} -B ${binary} -DSUBLIMIT_SHARED_MESHES=${MESHES}
    -DSUBLIMIT_UNITY_BUILD=OFF -DSUBLIMIT_WARNINGS_AS_ERRORS=OFF
    "-DSUBLIMIT_LIB_WITHOUT=/(fit|primvar|regularity)/|/(curve_|limit_curve|local_modes)")
run(${CMAKE_COMMAND} --build ${binary} --target ${TARGET})
run(${binary}/bin/${TARGET} --gtest_brief=1)
