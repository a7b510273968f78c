# Without a TARGET: builds all fuzzers with clang, the library instrumented. With one: runs it for SECONDS on a copy of
# its corpus.
set(binary ${BUILD}/fuzz)
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
if(NOT TARGET)
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${binary} -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -g1" -DCMAKE_CXX_COMPILER=clang++-14
      -DSUBLIMIT_BUILD_PROGRAM=OFF -DSUBLIMIT_BUILD_FUZZERS=ON
      "-DSUBLIMIT_LIB_WITHOUT=/(analysis|fit|limit|primvar|schemes)/|sublimit/[^/]*$")  # meshes and splits are left
  run(${CMAKE_COMMAND} --build ${binary} --target fuzz_obj fuzz_table)
  return()
endif()
set(corpus ${binary}/corpus_${TARGET})
file(REMOVE_RECURSE ${corpus})
file(COPY ${SOURCE}/tests/fuzz/corpus/${TARGET}/ DESTINATION ${corpus})
run(${binary}/bin/fuzz_${TARGET} -max_total_time=${SECONDS} -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
    -artifact_prefix=${binary}/ -dict=${SOURCE}/tests/fuzz/${TARGET}.dict ${corpus})
