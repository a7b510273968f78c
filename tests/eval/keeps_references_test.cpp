// SPDX-License-Identifier: Apache-2.0
// What refers to a table, or to bytes, takes no temporary one, or keeps it.
#include "laws/keeps_references.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/eval/evaluate/detail/packed_blocks.h"
#include "sublimit/eval/evaluate/detail/pattern_transpose.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/file/detail/table_tensors.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/eval/table/shared_array.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Options = PatternEvaluator<float>::Options;
static_assert(keeps_named_only<PatternEvaluator<float>, PatternTable<float>>);
static_assert(keeps_named_only<PatternEvaluator<float>, PatternTable<float>, Options>);
static_assert(keeps_named_only<PatternEvaluator<double>, PatternTable<double>>);
static_assert(keeps_named_only<PatternTranspose<float>, PatternTable<float>>);
static_assert(keeps_named_only<TableTensors, BakedTable<float>>);
static_assert(!std::is_move_constructible_v<TableTensors>);  // it refers to arrays of its own

using Bytes = std::vector<std::byte>;
template <class B>
constexpr bool are_read = requires(B&& bytes) {
  read_safetensors(std::forward<B>(bytes), "x");
};
static_assert(are_read<Bytes&> && are_read<std::span<const std::byte>> && !are_read<Bytes>);

TEST(KeepsReferences, TablesOfTemporaryBytesKeepThem) {
  const TemporaryDirectory directory;
  PatternTable<double>::Arrays arrays;  // a point between two
  arrays.blocks = {{1, 2, 0}};
  arrays.weights = {0.25, 0.75};
  arrays.groups = {{0, 1, 0, 1}};
  arrays.rows = {0};
  arrays.columns = {0, 1};
  BakedTable<double> table;
  table.table = PatternTable<double>(2, arrays);
  save_table(directory / "t", table);
  const std::string text = read_file(directory / "t");
  const auto bytes = [&] {
    Bytes copied(text.size());
    std::memcpy(copied.data(), text.data(), text.size());
    return copied;
  };
  const auto loaded = std::get<BakedTable<double>>(load_table(bytes(), "t"));
  const Bytes elsewhere = bytes();  // takes the memory, if it was given back
  const std::vector<double> points{4, 8};
  std::vector<double> result(1);
  loaded.table.apply(points, 1, result);
  EXPECT_EQ(result[0], 7);
}

TEST(KeepsReferences, ArraysThatWereMovedFromAreEmpty) {
  SharedArray<int> array{1, 2, 3};
  SharedArray<int> other = std::move(array);
  EXPECT_TRUE(array.empty());  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(other.size(), 3u);
  array = std::move(other);
  EXPECT_TRUE(other.empty());  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(array.back(), 3);
  const SharedArray<int> copy = array;
  EXPECT_EQ(copy.data(), array.data());
}

}  // namespace
}  // namespace sublimit::testing
