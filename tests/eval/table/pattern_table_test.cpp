// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table/pattern_table.h"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>

#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

/// Two blocks: means of two points, and copies of one. Three patches in two groups.
PatternTable<double>::Arrays some_arrays() {
  PatternTable<double>::Arrays a;
  a.blocks = {{2, 2, 0}, {1, 1, 4}};
  a.weights = {0.5, 0.5, 0.25, 0.75, 1};
  a.rows = {1, 0, 0};
  a.groups = {{0, 2, 0, 2}, {1, 1, 2, 1}};
  a.columns = {0, 1, 1, 2, 2};
  return a;
}

TEST(PatternTable, AppliesRowsOfBlocksToGatheredPoints) {
  const PatternTable<double> table(3, some_arrays());
  ASSERT_EQ(table.num_points(), 5);
  const std::vector<double> points{0, 4, 12}, expected{3, 2, 10, 8, 12};
  std::vector<double> made(5);
  table.apply(points, 1, made);
  EXPECT_EQ(made, expected);
  std::fill(made.begin(), made.end(), 0.0);
  PatternEvaluator<double>(table).apply(points, 1, made);
  EXPECT_EQ(made, expected);
  std::fill(made.begin(), made.end(), 0.0);
  table.expanded().apply(points, 1, made);
  EXPECT_EQ(made, expected);
}

TEST(PatternTable, TakesAFirstStepByRows) {
  PatternTable<double>::Arrays a = some_arrays();
  a.first.emplace(2, std::vector<std::int64_t>{0, 1, 3, 4}, std::vector<std::int32_t>{0, 0, 1, 1},
                  std::vector<double>{1, 0.5, 0.5, 1});
  const PatternTable<double> table(2, std::move(a));
  const std::vector<double> points{0, 8}, expected{3, 2, 7, 6, 8};  // by way of 0, 4, 8
  std::vector<double> made(5);
  table.apply(points, 1, made);
  EXPECT_EQ(made, expected);
  PatternEvaluator<double>(table).apply(points, 1, made);
  EXPECT_EQ(made, expected);
  table.expanded().apply(points, 1, made);
  EXPECT_EQ(made, expected);
}

TEST(PatternTable, RefusesArraysThatDoNotFit) {
  using Arrays = PatternTable<double>::Arrays;
  const auto expect_refused = [](const auto& change, std::initializer_list<std::string_view> words) {
    Arrays a = some_arrays();
    change(a);
    expect_error<InvalidParameter>([&] { PatternTable<double>(3, a); }, words);
  };
  expect_refused([](Arrays& a) { a.columns = {0, 3, 1, 2, 2}; }, {"control point 3", "there are 3"});
  expect_refused([](Arrays& a) { a.columns = {0, -1, 1, 2, 2}; }, {"control point -1"});
  expect_refused([](Arrays& a) { a.columns = {0, 1, 1, 2}; }, {"columns from 4, 1 of them", "there are 4"});
  expect_refused([](Arrays& a) { a.columns = {0, 1, 1, 2, 2, 0}; }, {"patches have 5 columns", "there are 6"});
  expect_refused([](Arrays& a) { a.rows = {2, 0, 0}; }, {"row 2", "there are 2"});
  expect_refused([](Arrays& a) { a.groups[1].rows = 3; }, {"rows from 3", "there are 3"});
  expect_refused([](Arrays& a) { a.groups[1].block = 2; }, {"block 2", "there are 2"});
  const std::int64_t least = std::numeric_limits<std::int64_t>::min();
  expect_refused([](Arrays& a) { a.groups[0].num_patches = -1; }, {"a group of -1 patches"});
  expect_refused([=](Arrays& a) { a.groups[0].num_patches = least; }, {"a group of -9223372036854775808 patches"});
  expect_refused(
      [](Arrays& a) {
        a.blocks[0] = {2, 0, 0};
        a.groups[0].num_patches = std::numeric_limits<std::int64_t>::max();
      },
      {"too many patches"});
  expect_refused([](Arrays& a) { a.groups[0].num_patches = std::numeric_limits<std::int64_t>::max(); }, {"columns"});
  expect_refused([](Arrays& a) { a.groups[0].num_rows = -1; }, {"rows"});
  expect_refused([](Arrays& a) { a.blocks[0].columns = 1 << 30; }, {"weights"});
  expect_refused([](Arrays& a) { a.blocks[1].weights = -1; }, {"weights from -1"});
  expect_refused(
      [](Arrays& a) {
        a.weights = {0.5, 0.5, 0.25, std::numeric_limits<double>::infinity(), 1};
      },
      {"not finite"});
  expect_refused(
      [](Arrays& a) {
        a.first.emplace(2, std::vector<std::int64_t>{0}, std::vector<std::int32_t>{}, std::vector<double>{});
      },
      {"first step takes 2 points, not 3"});
  expect_error<InvalidParameter>([] { PatternTable<double>(-1, some_arrays()); }, {"-1 control points"});
}

TEST(PatternTable, RefusesPointsOfTheWrongNumber) {
  const PatternTable<double> table(3, some_arrays());
  std::vector<double> few(2), points(3), made(5), more(6);
  expect_error<InvalidParameter>([&] { table.apply(few, 1, made); }, {"points holds 2", "3 x 1"});
  expect_error<InvalidParameter>([&] { table.apply(points, 1, more); }, {"result holds 6", "5 x 1"});
  expect_error<InvalidParameter>([&] { table.apply(points, 0, made); }, {"0 channels"});
  expect_error<InvalidParameter>([&] { PatternEvaluator<double>(table).apply(few, 1, made); }, {"points holds 2"});
}

TEST(PatternTable, MayBeEmpty) {
  const PatternTable<float> table;
  EXPECT_EQ(table.num_points(), 0);
  table.apply({}, 3, {});
  PatternEvaluator<float>(table).apply({}, 3, {});
  EXPECT_EQ(table.expanded().num_rows(), 0);
}

}  // namespace
}  // namespace sublimit::testing
