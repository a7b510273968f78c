# BUILD: makes what watches the instrumented library, in a tree below it. TARGET: runs that, a fuzzer for SECONDS on a copy of its corpus.
# WHOLE: with all of the library instrumented, in a tree of its own.
set(binary ${BUILD}/instrumented)
if(WHOLE)
  set(binary ${BUILD}/instrumented_whole)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
if(NOT TARGET)
  # Warnings are errors where the flags that ship are; another compiler sees other things. Kernels are compiled for one kind of
  # registers. Parts that neither readers nor limits of surfaces need are left out; what recipes make patches with,
  # decompositions, which are Eigen's, and kernels that no fuzzer calls are those of the libraries that ship. Reports name functions
  # and not lines (-g1), which would take a sixth of the time.
  set(part "")
  if(NOT WHOLE)
    set(part -DSUBLIMIT_REST_OF_LIBRARY=${BUILD}/lib/libsublimit_lib.a -DSUBLIMIT_REST_OF_EVAL=${BUILD}/eval/libsublimit_eval.a
        "-DSUBLIMIT_EVAL_WITHOUT=/kernels/(project_points|transpose_patches)[.]cpp$"
        "-DSUBLIMIT_LIB_WITHOUT=/lib/sublimit/((cad|fit|primvar|curves|search|tessellation|patches|geometric|implicit|integrals|nets|parts)/|core/detail/(dense_decompositions|complex_decompositions|sparse_lu)[.]cpp$)")
  endif()
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${binary} -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DHWY_COMPILE_ONLY_STATIC"
      -DCMAKE_CXX_COMPILER=clang++-14 -DSUBLIMIT_BUILD_PROGRAM=OFF
      -DSUBLIMIT_BUILD_IMPLICIT_MESH=OFF -DSUBLIMIT_BUILD_CAD=OFF -DSUBLIMIT_BUILD_GPU=OFF -DSUBLIMIT_BUILD_FUZZERS=ON
      -DSUBLIMIT_WARNINGS_AS_ERRORS=OFF
      -DSUBLIMIT_SHARED_MESHES=${MESHES} ${part})
  run(${CMAKE_COMMAND} --build ${binary} --target fuzz_obj fuzz_mesh fuzz_usd fuzz_table fuzz_recipe sweep_tests)
  return()
endif()
if("${TARGET}" STREQUAL sweep_tests)
  run(${binary}/bin/sweep_tests --gtest_brief=1 --gtest_filter=Sweep/*)
  return()
endif()
set(corpus ${binary}/corpus_${TARGET})
file(REMOVE_RECURSE ${corpus})
file(COPY ${SOURCE}/tests/fuzz/corpus/${TARGET}/ DESTINATION ${corpus})
run(${binary}/bin/fuzz_${TARGET} -max_total_time=${SECONDS} -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
    -artifact_prefix=${binary}/ -dict=${SOURCE}/tests/fuzz/${TARGET}.dict ${corpus})
