# sweep_tests: every scheme on the same shapes. On its own, so that little has to be built with it where the library is instrumented.
set(tests ${CMAKE_CURRENT_LIST_DIR}/..)
add_executable(sweep_tests ${tests}/lib/every_scheme_sweep_test.cpp ${tests}/lib/every_surface_sweep_test.cpp
               ${tests}/meshes/broken_topology.cpp)
target_include_directories(sweep_tests PRIVATE ${tests})
target_link_libraries(sweep_tests PRIVATE sublimit::lib GTest::gtest_main sublimit_house)
target_compile_definitions(sweep_tests PRIVATE SUBLIMIT_SHARED_MESHES="${SUBLIMIT_SHARED_MESHES}")
