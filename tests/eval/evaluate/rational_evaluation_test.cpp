// SPDX-License-Identifier: Apache-2.0
// Homogeneous columns divided at the end: Leibniz's rule gives the columns back.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshes/random_tables.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/detail/eval_handle.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/kernels/apply_patches.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

/// A table, columns whose last channel is the weight, what the table makes of them undivided, and divided.
template <class Real>
struct Rational {
  PatternTable<Real> table;
  int channels;  ///< with the weight
  int frames;
  std::vector<Real> columns, undivided;
  std::vector<std::vector<Real>> divided, unit;  ///< quantities; t, b, n
  Evaluation<Real> evaluation;

  Rational(const RandomTable& options, int channel_count, int frame_count = 1)
      : table(random_table<Real>(options)), channels(channel_count), frames(frame_count) {
    columns = random_numbers<Real>(size_t(frames * table.num_control_points() * channels), options.seed + 1);
    evaluation.channels = channels;
    evaluation.frames = frames;
    evaluation.points = columns;
    evaluation.rational = true;
    evaluation.least_weight = noise_of_weights(evaluation, table.num_control_points());
    const size_t size = size_t(frames * table.num_points() * (channels - 1));
    divided.assign(size_t(table.quantities()), std::vector<Real>(size, Real(-77)));
    for (size_t q = 0; q < divided.size(); ++q) evaluation.quantities[q] = divided[q];
    if (channels != 4 || table.quantities() < 3) return;
    unit.assign(3, std::vector<Real>(size, Real(-77)));
    evaluation.tangents = unit[0];
    evaluation.bitangents = unit[1];
    evaluation.normals = unit[2];
  }
  void apply(bool reproducible = false) {
    const PatternEvaluator<Real> evaluator(table, {.reproducible = reproducible});
    evaluator.apply(evaluation);
    undivided.clear();
    for (int f = 0; f < frames; ++f) {
      std::vector<Real> made(size_t(table.quantities() * table.num_points() * channels));
      const size_t size = size_t(table.num_control_points() * channels);
      evaluator.apply(std::span<const Real>(columns).subspan(size_t(f) * size, size), channels, made);
      undivided.insert(undivided.end(), made.begin(), made.end());
    }
  }
  double column(int frame, int q, std::int64_t point, int c) const {
    return undivided[size_t(((frame * table.quantities() + q) * table.num_points() + point) * channels + c)];
  }
  double x(int frame, int q, std::int64_t point, int c) const {
    return divided[size_t(q)][size_t((frame * table.num_points() + point) * (channels - 1) + c)];
  }
};

/// A_q = sum of factor w_i x_j over these.
struct Product {
  int i, j, factor;
};
const std::vector<Product> leibniz[] = {{{0, 0, 1}},
                                        {{0, 1, 1}, {1, 0, 1}},
                                        {{0, 2, 1}, {2, 0, 1}},
                                        {{0, 3, 1}, {1, 1, 2}, {3, 0, 1}},
                                        {{0, 4, 1}, {1, 2, 1}, {2, 1, 1}, {4, 0, 1}},
                                        {{0, 5, 1}, {2, 2, 2}, {5, 0, 1}}};

template <class Real>
void expect_leibniz(const RandomTable& options, int channels, int frames = 1) {
  Rational<Real> of(options, channels, frames);
  of.apply();
  const double rounding = 400 * double(std::numeric_limits<Real>::epsilon());
  std::vector<bool> is_copy(size_t(of.table.num_points()));
  const auto copies = of.table.arrays().copies.span();
  for (size_t i = 0; i < copies.size(); i += 2) is_copy[size_t(copies[i])] = true;
  for (int f = 0; f < frames; ++f)
    for (std::int64_t p = 0; p < of.table.num_points(); ++p) {
      const double w = of.column(f, 0, p, channels - 1);
      // Of a copy only the position is another point's; nothing divides it by its own weight.
      for (int q = 0; q < of.table.quantities() && !(is_copy[size_t(p)] && q > 0); ++q)
        for (int c = 0; c < channels - 1; ++c) {
          if (std::abs(w) <= double(of.evaluation.least_weight)) {
            ASSERT_EQ(of.x(f, q, p, c), 0);
            continue;
          }
          double sum = 0, size = std::abs(of.column(f, q, p, c));
          for (const Product& term : leibniz[q]) {
            const double value = term.factor * of.column(f, term.i, p, channels - 1) * of.x(f, term.j, p, c);
            sum += value;
            size += std::abs(value);
          }
          ASSERT_NEAR(sum, of.column(f, q, p, c), rounding * (1 + size))
              << "seed " << options.seed << ", quantity " << q << " of point " << p << ", channel " << c;
        }
    }
}

TEST(RationalEvaluation, ObeysLeibnizOnEveryTarget) {
  for (const std::int64_t target : kernels::targets()) {
    kernels::use_target(target);
    for (const RandomTable& options : random_tables()) {
      for (const int channels : {2, 4, 6}) expect_leibniz<double>(options, channels);
      expect_leibniz<float>(options, 4);
      expect_leibniz<double>(options, 4, 3);
    }
  }
  kernels::use_target(0);
}

TEST(RationalEvaluation, WithEqualWeightsIsThePlainOne) {
  for (const RandomTable& options : random_tables()) {
    Rational<double> of(options, 4);
    // Rows of random tables sum to anything: so does what they make of weights, and points follow it.
    for (size_t i = 3; i < of.columns.size(); i += 4) of.columns[i] = 0.5;
    of.apply();
    for (std::int64_t p = 0; p < of.table.num_points(); ++p) {
      const double w = of.column(0, 0, p, 3);
      if (std::abs(w) <= of.evaluation.least_weight || !of.table.arrays().copies.empty()) continue;
      for (int c = 0; c < 3; ++c) EXPECT_EQ(of.x(0, 0, p, c), of.column(0, 0, p, c) / w);
    }
  }
}

TEST(RationalEvaluation, HasFramesOfDividedDerivatives) {
  int count = 0;
  for (const RandomTable& options : random_tables()) {
    Rational<double> of(options, 4);
    if (of.unit.empty()) continue;
    of.apply();
    const auto vector = [&](const std::vector<double>& all, std::int64_t p) {
      return std::array{all[size_t(3 * p)], all[size_t(3 * p + 1)], all[size_t(3 * p + 2)]};
    };
    const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    for (std::int64_t p = 0; p < of.table.num_points(); ++p) {
      const auto xu = vector(of.divided[1], p), xv = vector(of.divided[2], p);
      const auto t = vector(of.unit[0], p), b = vector(of.unit[1], p), n = vector(of.unit[2], p);
      if (dot(n, n) == 0) {
        EXPECT_EQ(dot(t, t), 0);
        continue;
      }
      // Between directions that are parallel but for rounding the normal is what rounding makes it.
      if (const double cosine = dot(xu, xv) / std::sqrt(dot(xu, xu) * dot(xv, xv)); std::abs(cosine) > 1 - 1e-6)
        continue;
      ++count;
      // Lengths from a square root and a division; of crossed directions, which may be that near to parallel, and of
      // the binormal made of them, a thousand times as much may cancel and more.
      constexpr double unit = 1e-14, along = 1e-12, crossed = 1e-9;
      EXPECT_NEAR(dot(n, n), 1, unit);
      EXPECT_NEAR(dot(t, t), 1, unit);
      EXPECT_NEAR(dot(b, b), 1, crossed);
      EXPECT_NEAR(dot(n, xu), 0, crossed * std::sqrt(dot(xu, xu)));
      EXPECT_NEAR(dot(n, xv), 0, crossed * std::sqrt(dot(xv, xv)));
      EXPECT_NEAR(dot(t, xu), std::sqrt(dot(xu, xu)), along * std::sqrt(dot(xu, xu)));
    }
  }
  EXPECT_GT(count, 1000);
}

TEST(RationalEvaluation, HasTheSameBitsInAnyLayoutAndAnyParts) {
  for (const RandomTable& options : random_tables()) {
    Rational<float> of(options, 4), planar(options, 4), parts(options, 4), alone(options, 4);
    of.apply(true);
    const std::int64_t count = of.table.num_points();
    planar.evaluation.result_layout = PointLayout::planar(count);
    planar.apply(true);
    for (size_t q = 0; q < of.divided.size(); ++q)
      for (std::int64_t p = 0; p < count; ++p)
        for (std::int64_t c = 0; c < 3; ++c)
          ASSERT_EQ(planar.divided[q][size_t(c * count + p)], of.divided[q][size_t(3 * p + c)]) << options.seed;
    const PatternEvaluator<float> evaluator(parts.table, {.reproducible = true});
    std::vector<float> inputs(size_t(evaluator.num_inputs(parts.evaluation)));
    evaluator.apply_first(parts.evaluation, inputs);
    for (std::int64_t begin = evaluator.num_patches(); begin > 0; begin -= std::min<std::int64_t>(begin, 7))
      evaluator.apply_patches(parts.evaluation, inputs, begin - std::min<std::int64_t>(begin, 7), begin);
    evaluator.apply_rest(parts.evaluation, inputs);
    EXPECT_EQ(parts.divided, of.divided);
    EXPECT_EQ(parts.unit, of.unit);
    // A derivative that is wanted alone.
    const size_t last = of.divided.size() - 1;
    for (size_t q = 0; q < last; ++q) alone.evaluation.quantities[q] = {};
    alone.evaluation.tangents = alone.evaluation.bitangents = alone.evaluation.normals = {};
    alone.apply(true);
    EXPECT_EQ(alone.divided[last], of.divided[last]);
  }
}

TEST(RationalEvaluation, IsTheSameInC) {
  RandomTable options;
  options.quantities = 6;
  options.rest = true;
  Rational<double> of(options, 4);
  of.apply();
  BakedTable<double> baked;
  baked.table = of.table;
  baked.info.rational = true;
  sublimit_table* table = nullptr;
  ASSERT_EQ(c::guarded([&] { c::hand_out(std::move(baked), 0, &table); }), SUBLIMIT_OK);
  EXPECT_EQ(sublimit_table_is_rational(table), 1);
  EXPECT_EQ(sublimit_table_is_rational(nullptr), 0);
  std::vector<std::vector<double>> results(9, std::vector<double>(size_t(3 * of.table.num_points())));
  sublimit_evaluation_d e = {};
  e.channels = 4;
  e.points = of.columns.data();
  e.num_point_numbers = of.columns.size();
  for (size_t q = 0; q < 6; ++q) e.quantities[q] = results[q].data();
  e.tangents = results[6].data();
  e.bitangents = results[7].data();
  e.normals = results[8].data();
  e.num_result_numbers = results[0].size();
  e.rational = 1;
  e.least_weight = of.evaluation.least_weight;
  ASSERT_EQ(sublimit_evaluate_d(table, &e), SUBLIMIT_OK) << sublimit_last_error();
  for (size_t q = 0; q < 6; ++q) EXPECT_EQ(results[q], of.divided[q]);
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(results[6 + k], of.unit[k]);
  e.channels = 1;
  EXPECT_EQ(sublimit_evaluate_d(table, &e), SUBLIMIT_INVALID_PARAMETER);
  sublimit_table_free(table);
}

TEST(RationalEvaluation, RefusesWhatCannotBeDivided) {
  Rational<double> of(RandomTable{}, 4);
  const PatternEvaluator<double> evaluator(of.table);
  Evaluation<double> e = of.evaluation;
  e.channels = 1;
  expect_error<InvalidParameter>([&] { evaluator.apply(e); }, {"1 channels of rational points; 2 to 64 are right"});
  e = of.evaluation;
  e.least_weight = -1;
  expect_error<InvalidParameter>([&] { evaluator.apply(e); }, {"least weight"});
  e = of.evaluation;
  e.points = e.points.first(e.points.size() - 1);
  expect_error<InvalidParameter>([&] { noise_of_weights(e, of.table.num_control_points()); }, {"points hold"});
}

}  // namespace
}  // namespace sublimit::testing
