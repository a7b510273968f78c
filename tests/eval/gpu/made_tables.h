// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables of random weights with all optional parts of a table, and sums of the magnitudes of their terms.
#include <cmath>
#include <random>
#include <vector>

#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit::testing {

struct MadeTable {
  int quantities = 1;
  bool first = false, rest = false, copies = false, placed = false;
  int largest_rows = 80, largest_columns = 40, largest_count = 40;  ///< bounds for blocks, and for patches in a group
  int groups = 8;
  bool many = false;  ///< so many patches of so many rows that a GPU groups most rows by four
};

/// Returns a random table.
/// @param parts  optional parts and sizes of the table
inline PatternTable<float> made_table(const MadeTable& parts, unsigned seed) {
  std::mt19937 random(seed);
  const auto up_to = [&](int last) { return std::uniform_int_distribution<int>(0, last)(random); };
  const auto weight = [&] { return std::uniform_real_distribution<float>(-1, 1)(random); };
  constexpr std::int32_t controls = 50;
  const std::int32_t inputs = parts.first ? 70 : controls;
  const auto rows = [&](std::int64_t count, std::int32_t columns) {
    std::vector<std::int64_t> offsets{0};
    std::vector<std::int32_t> numbers;
    std::vector<float> weights;
    for (std::int64_t i = 0; i < count; ++i) {
      for (int k = up_to(9); k > 0; --k) numbers.push_back(up_to(columns - 1)), weights.push_back(weight());
      offsets.push_back(std::ssize(numbers));
    }
    return StencilTable<float>(columns, offsets, numbers, weights);
  };
  PatternTable<float>::Arrays a;
  a.quantities = parts.quantities;
  std::vector<float> weights;
  std::vector<std::int32_t> chosen, columns;
  for (int b = 0; b < 4; ++b) {
    const std::int32_t block_rows = parts.many ? 61 + up_to(19) : 1 + up_to(parts.largest_rows - 1),
                       block_columns = up_to(parts.largest_columns);
    a.blocks.push_back({block_rows, block_columns, std::ssize(weights)});
    for (int i = 0; i < parts.quantities * block_rows * block_columns; ++i) weights.push_back(weight());
  }
  std::vector<std::int64_t> sizes;
  for (int g = 0; g < (parts.many ? 4 : parts.groups); ++g) {
    const std::int32_t block = up_to(3), count = g % 2 == 0 ? up_to(2) : parts.many ? 1500 : up_to(parts.largest_count);
    const auto first_row = std::ssize(chosen);
    for (std::int32_t row = 0; row < a.blocks[size_t(block)].rows; ++row)
      if (g < 2 || up_to(2) > 0) chosen.push_back(row);
    a.groups.push_back({block, std::int32_t(std::ssize(chosen) - first_row), first_row, count});
    for (int i = 0; i < count * a.blocks[size_t(block)].columns; ++i) columns.push_back(up_to(inputs - 1));
    for (int i = 0; i < count; ++i) sizes.push_back(std::ssize(chosen) - first_row);
  }
  a.weights = std::move(weights);
  a.rows = std::move(chosen), a.columns = std::move(columns);
  if (parts.placed) {  // last patches first
    std::vector<std::int64_t> places(sizes.size());
    std::int64_t at = 0;
    for (size_t i = sizes.size(); i-- > 0; at += sizes[i]) places[i] = at;
    a.patch_points = places;
  }
  std::int64_t points = 0;
  for (const std::int64_t size : sizes) points += size;
  if (parts.first) a.first = rows(inputs, controls);
  if (parts.rest) {
    a.rest = rows(std::int64_t{77} * parts.quantities, inputs);
    points += 77;
  }
  if (parts.copies && points > 10) a.copies = {3, 5, 4, 5, 0, std::int32_t(points - 1), 7, 3};
  return {controls, std::move(a)};
}

template <class Numbers>
std::vector<double> magnitudes(const Numbers& numbers) {
  std::vector<double> all;
  for (const auto x : numbers) all.push_back(std::abs(double(x)));
  return all;
}

/// Returns the table with each weight replaced by its magnitude.
inline PatternTable<double> table_of_magnitudes(const PatternTable<float>& table) {
  const auto step = [&](const StencilTable<float>& s) {
    return StencilTable<double>(s.num_control_points(), s.offsets(), s.columns(), magnitudes(s.weights()));
  };
  const auto& f = table.arrays();
  PatternTable<double>::Arrays a;
  a.quantities = f.quantities;
  for (const auto& b : f.blocks) a.blocks.push_back({b.rows, b.columns, b.weights});
  for (const auto& g : f.groups) a.groups.push_back({g.block, g.num_rows, g.rows, g.num_patches});
  a.weights = magnitudes(f.weights);
  a.rows = f.rows, a.columns = f.columns, a.patch_points = f.patch_points, a.copies = f.copies;
  if (f.first) a.first = step(*f.first);
  if (f.rest) a.rest = step(*f.rest);
  return {table.num_control_points(), std::move(a)};
}

/// Returns for each result of the table the sum of the magnitudes of its terms.
inline std::vector<double> sums_of_terms(const PatternTable<float>& table, std::span<const float> points,
                                         int channels) {
  std::vector<double> result(size_t(table.quantities()) * size_t(table.num_points()) * size_t(channels));
  table_of_magnitudes(table).apply(magnitudes(points), channels, result);
  return result;
}

/// Returns these sums for the results of the transpose.
inline std::vector<double> sums_of_transposed_terms(const PatternTable<float>& table, std::span<const float> values,
                                                    int channels) {
  const PatternTable<double> sums = table_of_magnitudes(table);
  std::vector<double> result(size_t(table.num_control_points()) * size_t(channels));
  PatternEvaluator<double>(sums).apply_transpose(magnitudes(values), channels, result);
  return result;
}

inline std::vector<float> random_numbers(size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-1, 1);
  std::vector<float> all(count);
  for (float& x : all) x = number(random);
  return all;
}

}  // namespace sublimit::testing
