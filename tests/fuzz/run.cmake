# Builds a fuzzer with clang, the library instrumented, and runs it for SECONDS on a copy of its corpus.
set(binary ${BUILD}/fuzz)
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${binary} -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++-14
    -DSUBLIMIT_BUILD_PROGRAM=OFF -DSUBLIMIT_BUILD_FUZZERS=ON)
run(${CMAKE_COMMAND} --build ${binary} --target fuzz_${TARGET})
file(REMOVE_RECURSE ${binary}/corpus)
file(COPY ${SOURCE}/tests/fuzz/corpus/${TARGET}/ DESTINATION ${binary}/corpus)
run(${binary}/bin/fuzz_${TARGET} -max_total_time=${SECONDS} -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
    -dict=${SOURCE}/tests/fuzz/${TARGET}.dict ${binary}/corpus)
