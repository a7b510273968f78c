# Builds a fuzzer with clang, the library instrumented, and runs it for SECONDS on a copy of its corpus.
set(binary ${BUILD}/fuzz)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${status}): ${command}")
  endif()
endfunction()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${binary} -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++-14
    -DSUBLIMIT_BUILD_PROGRAM=OFF -DSUBLIMIT_BUILD_FUZZERS=ON)
run(${CMAKE_COMMAND} --build ${binary} --target fuzz_${TARGET})
file(REMOVE_RECURSE ${binary}/corpus)
file(COPY ${SOURCE}/tests/fuzz/corpus/${TARGET}/ DESTINATION ${binary}/corpus)
run(${binary}/bin/fuzz_${TARGET} -max_total_time=${SECONDS} -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
    -dict=${SOURCE}/tests/fuzz/${TARGET}.dict ${binary}/corpus)
