// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/eval.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <thread>

#include "sublimit/base/error.h"
#include "sublimit/eval/detail/eval_handle.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/eval/table/baked_table.h"
#include "support/temporary_directory.h"

extern "C" {
const char* check_rows();
const char* check_patterns();
const char* check_misuse();
}

namespace sublimit::testing {
namespace {

TEST(EvalInC, AppliesRows) { EXPECT_STREQ(check_rows(), nullptr); }
TEST(EvalInC, AppliesPatterns) { EXPECT_STREQ(check_patterns(), nullptr); }
TEST(EvalInC, RefusesMisuse) { EXPECT_STREQ(check_misuse(), nullptr); }

template <class Thrown>
sublimit_status status_of(const Thrown& thrown) {
  return c::guarded([&] { throw thrown; });
}

TEST(EvalInC, HasAStatusForEveryError) {
  EXPECT_EQ(status_of(InvalidMesh("a")), SUBLIMIT_INVALID_MESH);
  EXPECT_EQ(status_of(UnsupportedTopology("a")), SUBLIMIT_UNSUPPORTED_TOPOLOGY);
  EXPECT_EQ(status_of(InvalidOption("a")), SUBLIMIT_INVALID_OPTION);
  EXPECT_EQ(status_of(InvalidParameter("a")), SUBLIMIT_INVALID_PARAMETER);
  EXPECT_EQ(status_of(FormatError("a")), SUBLIMIT_FORMAT_ERROR);
  EXPECT_EQ(status_of(AnalysisError("a")), SUBLIMIT_ANALYSIS_ERROR);
  EXPECT_EQ(status_of(IoError("a")), SUBLIMIT_IO_ERROR);
  EXPECT_EQ(status_of(ResourceError("what it says")), SUBLIMIT_RESOURCE_ERROR);
  EXPECT_STREQ(sublimit_last_error(), "what it says");
  EXPECT_EQ(status_of(std::bad_alloc()), SUBLIMIT_BAD_ALLOC);
  EXPECT_STREQ(sublimit_last_error(), "out of memory");
  EXPECT_EQ(status_of(std::logic_error("a")), SUBLIMIT_UNKNOWN_ERROR);
  EXPECT_EQ(status_of(7), SUBLIMIT_UNKNOWN_ERROR);
}

TEST(EvalInC, KeepsTheLastErrorOfEachThread) {
  EXPECT_EQ(status_of(IoError("of this thread")), SUBLIMIT_IO_ERROR);
  std::string there;
  std::thread([&] {
    there = sublimit_last_error();
    status_of(IoError("of that thread"));
  }).join();
  EXPECT_EQ(there, "");
  EXPECT_STREQ(sublimit_last_error(), "of this thread");
}

TEST(EvalInC, CutsLongMessages) {
  EXPECT_EQ(status_of(IoError(std::string(5000, 'a'))), SUBLIMIT_IO_ERROR);
  EXPECT_EQ(std::string(sublimit_last_error()), std::string(1023, 'a'));
}

TEST(EvalInC, TellsWhatATableIs) {
  BakedTable<float> baked;
  PatternTable<float>::Arrays arrays;
  arrays.blocks = {{1, 1, 0}};
  arrays.weights = {1};
  arrays.groups = {{0, 1, 0, 4}};
  arrays.rows = {0};
  arrays.columns = {0, 1, 2, 3};
  baked.table = PatternTable<float>(4, std::move(arrays));
  baked.info.scheme = "catmull-clark";
  baked.info.topology_hash = 12;
  baked.faces = {{4}, {0, 1, 2, 3}};
  sublimit_table* table = nullptr;
  ASSERT_EQ(c::guarded([&] { c::hand_out(std::move(baked), 0, &table); }), SUBLIMIT_OK);
  EXPECT_STREQ(sublimit_table_scheme(table), "catmull-clark");
  EXPECT_EQ(sublimit_table_topology_hash(table), 12u);
  std::int64_t faces = 0, corners = 0;
  ASSERT_EQ(sublimit_table_faces(table, &faces, &corners, nullptr, nullptr), SUBLIMIT_OK);
  EXPECT_EQ(faces, 1);
  EXPECT_EQ(corners, 4);
  std::array<std::int32_t, 1> sizes{};
  std::array<std::int32_t, 4> vertices{};
  ASSERT_EQ(sublimit_table_faces(table, &faces, &corners, sizes.data(), vertices.data()), SUBLIMIT_OK);
  EXPECT_EQ(sizes[0], 4);
  EXPECT_EQ(vertices, (std::array<std::int32_t, 4>{0, 1, 2, 3}));
  corners = 3;
  EXPECT_EQ(sublimit_table_faces(table, &faces, &corners, sizes.data(), vertices.data()), SUBLIMIT_INVALID_PARAMETER);
  EXPECT_STREQ(sublimit_last_error(), "corners has room for 3 numbers; 4 are needed");
  EXPECT_EQ(sublimit_topology_hash(4, sizes.data(), 1, vertices.data(), 4), topology_hash(4, sizes, vertices));
  sublimit_table_free(table);
}

TEST(EvalInC, LoadsFilesAndBytes) {
  BakedTable<double> baked;
  PatternTable<double>::Arrays arrays;
  arrays.rest.emplace(2, std::vector<std::int64_t>{0, 2}, std::vector<std::int32_t>{0, 1},
                      std::vector<double>{0.5, 0.5});
  baked.table = PatternTable<double>(2, std::move(arrays));
  baked.info.scheme = "catmull-clark";
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "table.safetensors").string();
  save_table(path, baked);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  for (const bool from_memory : {false, true})
    for (const std::uint32_t flags : {0, SUBLIMIT_CHECKSUMS | SUBLIMIT_REPRODUCIBLE}) {
      sublimit_table* table = nullptr;
      ASSERT_EQ(from_memory ? sublimit_table_load_memory(bytes.data(), bytes.size(), flags, &table)
                            : sublimit_table_load(path.c_str(), flags, &table),
                SUBLIMIT_OK)
          << sublimit_last_error();
      EXPECT_EQ(sublimit_table_precision(table), SUBLIMIT_DOUBLE);
      EXPECT_STREQ(sublimit_table_scheme(table), "catmull-clark");
      const std::array<double, 2> points{2, 6};
      double made = 0;
      EXPECT_EQ(sublimit_apply_d(table, points.data(), 2, 1, &made, 1), SUBLIMIT_OK);
      EXPECT_EQ(made, 4);
      sublimit_table_free(table);
    }
  sublimit_table* none = nullptr;
  EXPECT_EQ(sublimit_table_load("no such file", 0, &none), SUBLIMIT_IO_ERROR);
  EXPECT_EQ(sublimit_table_load(nullptr, 0, &none), SUBLIMIT_INVALID_PARAMETER);
  EXPECT_EQ(sublimit_table_load(path.c_str(), 0, nullptr), SUBLIMIT_INVALID_PARAMETER);
  EXPECT_EQ(sublimit_table_load_memory(nullptr, 8, 0, &none), SUBLIMIT_INVALID_PARAMETER);
  EXPECT_EQ(sublimit_table_load_memory(bytes.data(), bytes.size() / 2, 0, &none), SUBLIMIT_FORMAT_ERROR);
  EXPECT_EQ(none, nullptr);
}

}  // namespace
}  // namespace sublimit::testing
