// SPDX-License-Identifier: Apache-2.0
#pragma once
// Random tables by patterns, with many blocks, groups of few and of many patches, and all optional parts of a
// table.
#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "sublimit/eval/table/pattern_table.h"

namespace sublimit::testing {

struct RandomTable {
  unsigned seed = 1;
  int quantities = 1;
  int blocks = 6;
  int most_rows = 70;     ///< most rows of a block
  int most_patches = 24;  ///< most patches of a group
  bool placed = false;    ///< patches store their points in random order
  bool copies = false, first = false, rest = false;
};

template <class Real>
std::vector<Real> random_numbers(size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Real> numbers(count);
  for (Real& x : numbers) x = static_cast<Real>(std::uniform_real_distribution<>(-1, 1)(random));
  return numbers;
}

template <class Real>
StencilTable<Real> random_rows(std::int32_t num_control_points, std::int64_t num_rows, std::mt19937& random) {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  for (std::int64_t r = 0; r < num_rows; ++r) {
    std::set<std::int32_t> row;
    for (auto count = random() % 9; count > 0; --count) row.insert(std::int32_t(random() % size_t(num_control_points)));
    columns.insert(columns.end(), row.begin(), row.end());
    offsets.push_back(std::int64_t(columns.size()));
  }
  std::vector<Real> weights = random_numbers<Real>(columns.size(), unsigned(random()));
  return StencilTable<Real>(num_control_points, std::move(offsets), std::move(columns), std::move(weights));
}

template <class Real>
PatternTable<Real> random_table(const RandomTable& options) {
  std::mt19937 random(options.seed);
  const auto below = [&](int n) { return static_cast<std::int32_t>(random() % unsigned(n)); };
  typename PatternTable<Real>::Arrays a;
  const std::int32_t num_control_points = 50, num_inputs = options.first ? 90 : num_control_points;
  if (options.first) a.first = random_rows<Real>(num_control_points, num_inputs, random);
  a.quantities = options.quantities;
  std::vector<std::int32_t> rows, columns;
  std::int64_t weights = 0, points = 0;
  std::vector<std::int32_t> sizes;  // points of each patch
  for (int b = 0; b < options.blocks; ++b) {
    const std::int32_t block_rows = 1 + below(options.most_rows), block_columns = 1 + below(40);
    a.blocks.push_back({block_rows, block_columns, weights});
    weights += std::int64_t{options.quantities} * block_rows * block_columns;
    // Groups as lattices make them (a core and some of the rest, in one order), of any order, and with rows twice.
    std::vector<std::int32_t> order(static_cast<size_t>(block_rows));
    std::iota(order.begin(), order.end(), 0);
    if (b % 2) std::shuffle(order.begin(), order.end(), random);
    for (int g = 0; g < 4; ++g) {
      std::vector<std::int32_t> chosen;
      for (size_t i = 0; i < order.size(); ++i)
        if (i < order.size() / 2 || below(3) == 0) chosen.push_back(order[i]);
      if (b % 3 == 2 && g == 1) std::shuffle(chosen.begin(), chosen.end(), random);
      if (b % 4 == 3 && g == 2 && !chosen.empty()) chosen.push_back(chosen.front());
      const std::int32_t patches = g == 0 ? 1 + below(2) : below(options.most_patches);
      a.groups.push_back(
          {b, static_cast<std::int32_t>(chosen.size()), static_cast<std::int64_t>(rows.size()), patches});
      rows.insert(rows.end(), chosen.begin(), chosen.end());
      for (std::int32_t i = 0; i < patches * block_columns; ++i) columns.push_back(below(num_inputs));
      sizes.insert(sizes.end(), size_t(patches), static_cast<std::int32_t>(chosen.size()));
      points += std::int64_t{patches} * static_cast<std::int64_t>(chosen.size());
    }
  }
  a.weights = random_numbers<Real>(static_cast<size_t>(weights), unsigned(random()));
  a.rows = rows;
  a.columns = columns;
  if (options.placed) {
    std::vector<size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::shuffle(order.begin(), order.end(), random);
    std::vector<std::int64_t> starts(sizes.size());
    std::int64_t next = 0;
    for (const size_t patch : order) starts[patch] = next, next += sizes[patch];
    a.patch_points = starts;
  }
  if (options.rest) {
    a.rest = random_rows<Real>(num_inputs, std::int64_t{options.quantities} * 37, random);
    points += 37;
  }
  if (options.copies) {
    std::vector<std::int32_t> pairs;
    for (std::int32_t to = 0; to + 1 < points; to += 1 + below(9))
      pairs.insert(pairs.end(), {to, static_cast<std::int32_t>(points) - 1});
    a.copies = pairs;
  }
  return PatternTable<Real>(num_control_points, std::move(a));
}

/// Returns tables with each optional part alone, and with all of them.
inline std::vector<RandomTable> random_tables() {
  std::vector<RandomTable> tables;
  for (const int quantities : {1, 3, 6}) {
    RandomTable plain;
    plain.quantities = quantities;
    plain.seed = unsigned(quantities);
    RandomTable placed = plain, copied = plain, first = plain, rest = plain, all = plain, small = plain, tall = plain;
    placed.placed = copied.copies = first.first = rest.rest = true;
    all.placed = all.copies = all.first = all.rest = true;
    small.most_rows = 18, small.blocks = 40;
    tall.most_rows = 700, tall.blocks = 4, tall.most_patches = 5;
    all.seed += 100, small.seed += 200, tall.seed += 300;
    tables.insert(tables.end(), {plain, placed, copied, first, rest, all, small, tall});
  }
  return tables;
}

}  // namespace sublimit::testing
