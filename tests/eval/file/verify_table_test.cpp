// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/detail/verify_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "eval/file/table_samples.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/safetensors.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Arrays = PatternTable<double>::Arrays;

/// What is found in the file of two quadrilaterals, changed.
std::vector<std::string> findings(const std::function<void(BakedTable<double>&, Arrays&)>& change) {
  const TemporaryDirectory directory;
  BakedTable<double> table = two_quads<double>(3);
  Arrays arrays = table.table.arrays();
  change(table, arrays);
  table.table = PatternTable<double>(table.table.num_control_points(), std::move(arrays));
  save_table(directory / "t", table);
  return verify_table(directory / "t").findings;
}

void expect_finding(const std::vector<std::string>& found, const std::string& text) {
  ASSERT_EQ(found.size(), 1u) << (found.empty() ? text : found[1]);
  EXPECT_EQ(found[0], text);
}

std::vector<double> changed(const SharedArray<double>& numbers, size_t at, double value) {
  std::vector<double> copy(numbers.begin(), numbers.end());
  copy[at] = value;
  return copy;
}

TEST(VerifyTable, FindsNothingInGoodTables) {
  const TemporaryDirectory directory;
  save_table(directory / "d", two_quads<double>(3));
  const Verification d = verify_table(directory / "d");
  EXPECT_EQ(d.findings, std::vector<std::string>());
  EXPECT_EQ(d.bytes, std::int64_t(std::filesystem::file_size(directory / "d")));
  EXPECT_EQ(d.arrays, 15);
  EXPECT_EQ(d.checksums, 16);
  EXPECT_EQ(d.rows, 30);  // 9 of the block and 1 by itself, 3 quantities
  EXPECT_EQ(d.points, 16);
  EXPECT_EQ(d.spare_bytes, 0);
  save_table(directory / "f", two_quads<float>());
  EXPECT_EQ(verify_table(directory / "f").findings, std::vector<std::string>());
  save_table(directory / "e", BakedTable<float>{});
  EXPECT_EQ(verify_table(directory / "e").findings, std::vector<std::string>());
  BakedTable<double> table = everything<double>();
  save_table(directory / "a", table);
  EXPECT_EQ(verify_table(directory / "a").findings, std::vector<std::string>());
}

TEST(VerifyTable, FindsSumsThatAreOff) {
  expect_finding(findings([](BakedTable<double>&, Arrays& a) { a.weights = changed(a.weights, 0, 1 + 1e-9); }),
                 "'weights': row 0 of block 0, quantity 0: weights of a position sum to 1.000000001");
  expect_finding(findings([](BakedTable<double>&, Arrays& a) { a.weights = changed(a.weights, 36, -0.5); }),
                 "'weights': row 0 of block 0, quantity 1: weights of a derivative sum to 0.5");
  expect_finding(findings([](BakedTable<double>&, Arrays& a) {
                   a.rest.emplace(7, a.rest->offsets(), a.rest->columns(), std::vector<double>{0.5, 0, 0});
                 }),
                 "'rest.weights': row 0: weights of a position sum to 0.5");
  const std::vector<std::string> all =
      findings([](BakedTable<double>&, Arrays& a) { a.weights = std::vector<double>(a.weights.size(), 1.0); });
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[5], "22 more rows of 'weights' have the wrong sum");
}

TEST(VerifyTable, LetsDerivativesVanish) {
  const auto left = [](double rounding) {
    return findings([&](BakedTable<double>&, Arrays& a) {
      std::vector<double> weights(a.weights.begin(), a.weights.end());
      std::fill_n(weights.begin() + 36, 4, 0.0);  // row 0 of the derivative along u
      weights[36] = rounding;
      a.weights = std::move(weights);
    });
  };
  EXPECT_EQ(left(0), std::vector<std::string>());
  EXPECT_EQ(left(1e-16), std::vector<std::string>());
  expect_finding(left(1e-9), "'weights': row 0 of block 0, quantity 1: weights of a derivative sum to 1e-09");
}

TEST(VerifyTable, LetsRowsWithoutASurfaceBeEmpty) {
  const auto empty_rest = [](const std::string& status) {
    return findings([&](BakedTable<double>& t, Arrays& a) {
      a.rest.emplace(7, a.rest->offsets(), a.rest->columns(), std::vector<double>{0, 0, 0});
      t.info.statuses = {"regular", status};
      t.rest_status = {1};
    });
  };
  EXPECT_EQ(empty_rest("hole"), std::vector<std::string>());
  EXPECT_EQ(empty_rest("outside"), std::vector<std::string>());
  expect_finding(empty_rest("crease"), "'rest.weights': row 0: weights of a position sum to 0");
}

TEST(VerifyTable, FindsPointsThatAreNotMadeOnce) {
  expect_finding(findings([](BakedTable<double>&, Arrays& a) {
                   a.patch_points = {0, 8};
                 }),
                 "'patch_points': point 8 is made by two patches");
  EXPECT_EQ(findings([](BakedTable<double>&, Arrays& a) { a.patch_points = {6, 0}; }), std::vector<std::string>());
  expect_finding(findings([](BakedTable<double>&, Arrays& a) {
                   a.copies = {3, 4, 3, 5};
                 }),
                 "'copies': point 3 is a copy of two");
  expect_finding(findings([](BakedTable<double>&, Arrays& a) {
                   a.copies = {3, 4, 4, 5};
                 }),
                 "'copies': point 4 is a copy, and copied");
}

TEST(VerifyTable, FindsWhatNothingRefersTo) {
  expect_finding(findings([](BakedTable<double>&, Arrays& a) {
                   std::vector<double> more(a.weights.begin(), a.weights.end());
                   more.resize(more.size() + 3);
                   a.weights = more;
                 }),
                 "'weights': 3 of them are in no block");
  expect_finding(findings([](BakedTable<double>&, Arrays& a) {
                   std::vector<std::int32_t> more(a.rows.begin(), a.rows.end());
                   more.push_back(0);
                   a.rows = more;
                 }),
                 "'rows': 1 of them are in no group");
  const std::vector<std::string> second_block = findings([](BakedTable<double>&, Arrays& a) {
    std::vector<double> more(a.weights.begin(), a.weights.end());
    more.resize(more.size() + 3);
    a.blocks.push_back({1, 1, std::int64_t(a.weights.size())});
    a.weights = more;
  });
  expect_finding(second_block, "'blocks': no group uses block 1");
  const std::vector<std::string> same = findings([](BakedTable<double>&, Arrays& a) { a.blocks.push_back({1, 1, 0}); });
  ASSERT_EQ(same.size(), 2u);
  EXPECT_EQ(same[0], "'blocks': two of them have the same weights");
}

TEST(VerifyTable, CountsRowsThatNoPatchMakes) {
  const TemporaryDirectory directory;
  BakedTable<double> table = two_quads<double>();
  Arrays arrays = table.table.arrays();
  arrays.rows = std::vector<std::int32_t>(15, 3);
  table.table = PatternTable<double>(7, std::move(arrays));
  save_table(directory / "t", table);
  const Verification v = verify_table(directory / "t");
  EXPECT_EQ(v.findings, std::vector<std::string>());
  EXPECT_EQ(v.spare_bytes, 8 * 4 * 8);
}

TEST(VerifyTable, ComparesChecksumsAndNames) {
  const TemporaryDirectory directory;
  save_table(directory / "t", two_quads<double>());
  std::string text = read_file(directory / "t");
  const auto bytes = std::as_bytes(std::span(text));
  Safetensors file = read_safetensors(bytes, "t");
  const std::vector<float> more{1, 2};
  file.tensors.push_back(tensor("more", std::span<const float>(more), {2}));
  write_safetensors(directory / "more", file);
  expect_finding(verify_table(directory / "more").findings, "'more': no part of a table, 8 bytes");
  // Another control point, which no sum shows.
  const Tensor& columns = *file.find("columns");
  text[size_t(columns.bytes.data() - bytes.data())] ^= 1;
  expect_finding(verify_table(bytes, "t").findings, "'columns': its checksum does not match");
}

TEST(VerifyTable, ThrowsWhatLoadingThrows) {
  const TemporaryDirectory directory;
  expect_error<IoError>([&] { verify_table(directory / "none"); }, {"none"});
  expect_error<FormatError>([&] { verify_table(directory.write("text", "no table")); }, {"text: "});
}

}  // namespace
}  // namespace sublimit::testing
