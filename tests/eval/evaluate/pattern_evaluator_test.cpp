// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/evaluate/pattern_evaluator.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "meshes/random_tables.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/kernels/apply_patches.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

/// A sum of m terms of size one in this precision.
template <class Real>
double rounding_of(double terms) {
  return 4 * terms * double(std::numeric_limits<Real>::epsilon());
}
/// A row of a random table takes no more than 40 columns, each of up to 8 points of a first step.
constexpr double most_terms = 40 * 8;

template <class Real>
struct Case {
  PatternTable<Real> table;
  std::vector<Real> points;
  int channels;
  Case(const RandomTable& options, int channel_count)
      : table(random_table<Real>(options)),
        points(random_numbers<Real>(size_t(table.num_control_points()) * size_t(channel_count), options.seed + 1)),
        channels(channel_count) {}
  size_t quantity() const { return size_t(table.num_points()) * size_t(channels); }
  size_t size() const { return quantity() * size_t(table.quantities()); }
  std::vector<Real> by_table() const {
    std::vector<Real> result(size());
    table.apply(points, channels, result);
    return result;
  }
  std::vector<Real> made(const PatternEvaluator<Real>& evaluator) const {
    std::vector<Real> result(size(), std::numeric_limits<Real>::quiet_NaN());
    evaluator.apply(points, channels, result);
    return result;
  }
};

/// The widest registers again, however a test ends.
struct Target {
  explicit Target(std::int64_t target) { kernels::use_target(target); }
  ~Target() { kernels::use_target(0); }
};

template <class Real>
void expect_near(const std::vector<Real>& a, const std::vector<Real>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << "number " << i;
}

template <class Real>
void expect_bits_of_the_table(const std::vector<int>& channels) {
  for (const RandomTable& options : random_tables())
    for (const int c : channels) {
      const Case<Real> of(options, c);
      EXPECT_EQ(of.made(PatternEvaluator<Real>(of.table, {.reproducible = true})), of.by_table())
          << "seed " << options.seed << ", " << c << " channels";
    }
}

TEST(PatternEvaluator, HasTheBitsOfTheTableWhereItIsReproducible) {
  expect_bits_of_the_table<float>({1, 2, 3, 4, 5, 8, 64});
  expect_bits_of_the_table<double>({1, 3, 7});
}

TEST(PatternEvaluator, HasThemOnEveryTarget) {
  ASSERT_GE(kernels::targets().size(), 2u) << "the scalar one, and this machine's";
  for (const std::int64_t target : kernels::targets()) {
    const Target scope(target);
    expect_bits_of_the_table<float>({1, 3, 6});
    expect_bits_of_the_table<double>({3, 4});
  }
}

TEST(PatternEvaluator, IsTheTableToRoundingOnEveryTarget) {
  for (const std::int64_t target : kernels::targets()) {
    const Target scope(target);
    for (const RandomTable& options : random_tables())
      for (const int c : {1, 3, 4}) {
        const Case<float> in_float(options, c);
        const PatternEvaluator<float> evaluator(in_float.table);
        expect_near(in_float.made(evaluator), in_float.by_table(), rounding_of<float>(most_terms) * 8);
        EXPECT_EQ(in_float.made(evaluator), in_float.made(evaluator));
        const Case<double> in_double(options, c);
        expect_near(in_double.made(PatternEvaluator<double>(in_double.table)), in_double.by_table(),
                    rounding_of<double>(most_terms) * 8);
      }
  }
}

TEST(PatternEvaluator, InFloatIsNearTheOneInDouble) {
  for (const RandomTable& options : random_tables()) {
    const Case<double> of(options, 3);
    const PatternTable<float> table = in_float(of.table);
    const std::vector<float> points(of.points.begin(), of.points.end());
    std::vector<float> made(of.size());
    PatternEvaluator<float>(table).apply(points, 3, made);
    const std::vector<double> exact = of.made(PatternEvaluator<double>(of.table));
    expect_near(std::vector<double>(made.begin(), made.end()), exact, rounding_of<float>(most_terms) * 8);
  }
}

/// What can be asked for, all at once, of one frame; the results' places.
template <class Real>
struct All {
  std::vector<std::vector<Real>> results;
  Evaluation<Real> evaluation;
  explicit All(const Case<Real>& of, int frames = 1, PointLayout layout = {}, size_t length = 0) {
    evaluation.channels = of.channels;
    evaluation.frames = frames;
    evaluation.points = of.points;
    evaluation.result_layout = layout;
    const bool framed = of.channels == 3 && of.table.quantities() >= 3;
    const size_t count = size_t(of.table.quantities()) + (framed ? 3 : 0);
    for (size_t i = 0; i < count; ++i)
      results.emplace_back(length ? length : of.quantity() * size_t(frames), Real(-77));
    for (int q = 0; q < of.table.quantities(); ++q) evaluation.quantities[size_t(q)] = results[size_t(q)];
    if (!framed) return;
    evaluation.tangents = results[count - 3];
    evaluation.bitangents = results[count - 2];
    evaluation.normals = results[count - 1];
  }
};

TEST(PatternEvaluator, HasTheSameBitsForAnyNumberOfThreadsAndAnyRanges) {
  RandomTable large;
  large.quantities = 3;
  large.blocks = 60;
  large.copies = large.first = large.rest = large.placed = true;
  std::vector<RandomTable> tables = random_tables();
  tables.push_back(large);
  for (const RandomTable& options : tables) {
    const Case<float> of(options, 3);
    const PatternEvaluator<float> evaluator(of.table);
    All<float> expected(of);
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      evaluator.apply(expected.evaluation);
    }
    for (const size_t threads : {2, 3, 8}) {
      const tbb::global_control some(tbb::global_control::max_allowed_parallelism, threads);
      All<float> made(of);
      evaluator.apply(made.evaluation);
      EXPECT_EQ(made.results, expected.results);
    }
    std::mt19937 random(options.seed);
    for (int trial = 0; trial < 3; ++trial) {
      All<float> made(of);
      std::vector<float> inputs(size_t(evaluator.num_inputs(made.evaluation)));
      evaluator.apply_first(made.evaluation, inputs);
      std::vector<std::pair<std::int64_t, std::int64_t>> ranges;
      for (std::int64_t begin = 0, end; begin < evaluator.num_patches(); begin = end) {
        end = std::min(evaluator.num_patches(), begin + 1 + std::int64_t(random() % 40));
        ranges.push_back({begin, end});
      }
      std::shuffle(ranges.begin(), ranges.end(), random);
      for (const auto& [begin, end] : ranges) evaluator.apply_patches(made.evaluation, inputs, begin, end);
      evaluator.apply_rest(made.evaluation, inputs);
      EXPECT_EQ(made.results, expected.results);
    }
  }
}

TEST(PatternEvaluator, ServesManyThreadsAtOnce) {
  RandomTable options;
  options.quantities = 3;
  options.blocks = 40;
  options.copies = options.first = options.rest = true;
  const Case<float> of(options, 3);
  const PatternEvaluator<float> evaluator(of.table);
  const std::vector<float> expected = of.made(evaluator);
  std::vector<float> transposed(of.points.size());
  evaluator.apply_transpose(expected, 3, transposed);
  std::atomic<int> different = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int trial = 0; trial < 8; ++trial) {
        if (of.made(evaluator) != expected) ++different;
        std::vector<float> again(of.points.size());
        evaluator.apply_transpose(expected, 3, again);
        if (again != transposed) ++different;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(different, 0);
}

TEST(PatternEvaluator, TakesPointsAndResultsOfAnyLayout) {
  for (const RandomTable& options : random_tables())
    for (const int channels : {1, 2, 3, 4, 7}) {
      const Case<float> of(options, channels);
      const PatternEvaluator<float> evaluator(of.table);
      const std::vector<float> expected = of.made(evaluator);
      const auto points = std::int64_t(of.table.num_control_points()), made_points = of.table.num_points();
      struct Layouts {
        PointLayout in, out;
      };
      const PointLayout planar_in = PointLayout::planar(points + 3), planar_out = PointLayout::planar(made_points + 1),
                        wide = PointLayout::interleaved(channels + 2),
                        both{3 * channels, 2, 3 * channels * made_points + 5};
      for (const Layouts& layouts :
           {Layouts{planar_in, {}}, Layouts{{}, planar_out}, Layouts{wide, wide}, Layouts{planar_in, both}}) {
        const auto length = size_t(layouts.in.point ? layouts.in.point : channels) * size_t(points) +
                            size_t(layouts.in.channel) * size_t(channels);
        std::vector<float> given(length, -55);
        for (std::int64_t i = 0; i < points; ++i)
          for (int c = 0; c < channels; ++c)
            given[size_t(i * (layouts.in.point ? layouts.in.point : channels) + c * layouts.in.channel)] =
                of.points[size_t(i * channels + c)];
        const std::int64_t point = layouts.out.point ? layouts.out.point : channels;
        All<float> made(of, 1, layouts.out, size_t(point * made_points + layouts.out.channel * channels));
        made.evaluation.points = given;
        made.evaluation.point_layout = layouts.in;
        evaluator.apply(made.evaluation);
        for (size_t q = 0; q < size_t(of.table.quantities()); ++q) {
          std::vector<float> rest = made.results[q];
          for (std::int64_t i = 0; i < made_points; ++i)
            for (int c = 0; c < channels; ++c) {
              float& number = rest[size_t(i * point + c * layouts.out.channel)];
              ASSERT_EQ(number, expected[q * of.quantity() + size_t(i * channels + c)]);
              number = -77;
            }
          // What lies between is left alone.
          ASSERT_EQ(rest, std::vector<float>(rest.size(), -77));
        }
      }
    }
}

TEST(PatternEvaluator, TakesSeveralFrames) {
  for (RandomTable options : random_tables()) {
    Case<float> of(options, 3);
    const PatternEvaluator<float> evaluator(of.table);
    const size_t frames = 3, one = of.points.size();
    const std::vector<float> all = random_numbers<float>(one * frames, 9);
    of.points = all;
    All<float> made(of, int(frames));
    evaluator.apply(made.evaluation);
    for (size_t f = 0; f < frames; ++f) {
      of.points.assign(all.begin() + std::ptrdiff_t(f * one), all.begin() + std::ptrdiff_t((f + 1) * one));
      All<float> expected(of);
      evaluator.apply(expected.evaluation);
      for (size_t i = 0; i < made.results.size(); ++i) {
        const auto begin = made.results[i].begin() + std::ptrdiff_t(f * of.quantity());
        ASSERT_EQ(std::vector<float>(begin, begin + std::ptrdiff_t(of.quantity())), expected.results[i]);
      }
    }
  }
}

TEST(PatternEvaluator, MakesOnlyWhatIsWanted) {
  RandomTable options;
  options.quantities = 6;
  options.copies = options.first = options.rest = true;
  const Case<float> of(options, 3);
  const PatternEvaluator<float> evaluator(of.table);
  All<float> expected(of);
  evaluator.apply(expected.evaluation);
  for (size_t only = 0; only < expected.results.size(); ++only) {
    All<float> made(of);
    std::array<std::span<float>*, 9> spans{};
    for (size_t q = 0; q < 6; ++q) spans[q] = &made.evaluation.quantities[q];
    spans[6] = &made.evaluation.tangents, spans[7] = &made.evaluation.bitangents, spans[8] = &made.evaluation.normals;
    for (size_t i = 0; i < spans.size(); ++i)
      if (i != only) *spans[i] = {};
    evaluator.apply(made.evaluation);
    for (size_t i = 0; i < made.results.size(); ++i)
      EXPECT_EQ(made.results[i], i == only ? expected.results[i] : std::vector<float>(of.quantity(), -77.f));
  }
}

/// Frames by their definition, in long double.
void expect_frames(const Case<double>& of, const All<double>& made) {
  using Vector = std::array<long double, 3>;
  const auto read = [&](size_t which, size_t i) {
    return Vector{made.results[which][3 * i], made.results[which][3 * i + 1], made.results[which][3 * i + 2]};
  };
  const auto cross = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const size_t t = size_t(of.table.quantities());
  for (size_t i = 0; i < size_t(of.table.num_points()); ++i) {
    const Vector u = read(1, i), v = read(2, i), n = cross(u, v);
    const long double length = std::sqrt(dot(n, n)), stretch = std::sqrt(dot(u, u) * dot(v, v));
    if (length == 0) {
      for (size_t k = 0; k < 3; ++k) EXPECT_EQ(read(t + k, i), (Vector{0, 0, 0}));
      continue;
    }
    // The angle between u and v divides what rounding does to n.
    const auto tolerance = double(rounding_of<double>(10) * stretch / length);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(made.results[t][3 * i + c], double(u[c] / std::sqrt(dot(u, u))), tolerance);
      EXPECT_NEAR(made.results[t + 2][3 * i + c], double(n[c] / length), tolerance);
    }
    const Vector b = cross(read(t + 2, i), read(t, i));
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(made.results[t + 1][3 * i + c], double(b[c]), tolerance);
  }
}

TEST(PatternEvaluator, MakesTangentFramesOfDerivatives) {
  for (const std::int64_t target : kernels::targets()) {
    const Target scope(target);
    for (const RandomTable& options : random_tables()) {
      if (options.quantities < 3) continue;
      for (const double size : {1.0, 1e-160, 1e150}) {
        Case<double> of(options, 3);
        for (double& x : of.points) x *= size;
        All<double> made(of);
        PatternEvaluator<double>(of.table, {.reproducible = true}).apply(made.evaluation);
        expect_frames(of, made);
      }
    }
  }
}

TEST(PatternEvaluator, HasFramesOfZeroWhereDerivativesAreAlongALine) {
  RandomTable options;
  options.quantities = 3;
  options.rest = true;
  Case<float> of(options, 3);
  for (size_t i = 0; i < of.points.size(); ++i)
    if (i % 3 != 1) of.points[i] = 0;
  All<float> made(of);
  PatternEvaluator<float>(of.table).apply(made.evaluation);
  for (size_t i = 3; i < 6; ++i) EXPECT_EQ(made.results[i], std::vector<float>(of.quantity(), 0.f));
}

template <class Real>
void expect_transpose(const RandomTable& options, int channels, bool reproducible) {
  const Case<Real> of(options, channels);
  const PatternEvaluator<Real> evaluator(of.table, {.reproducible = reproducible});
  const std::vector<Real> Sx = of.made(evaluator), y = random_numbers<Real>(of.size(), 5);
  std::vector<Real> Sty(of.points.size(), Real(-77));
  evaluator.apply_transpose(y, channels, Sty);
  for (int c = 0; c < channels; ++c) {
    long double left = 0, right = 0, size = 0;
    for (size_t i = size_t(c); i < Sx.size(); i += size_t(channels)) {
      left += static_cast<long double>(Sx[i]) * y[i];
      size += std::abs(static_cast<long double>(Sx[i]) * y[i]);
    }
    for (size_t i = size_t(c); i < Sty.size(); i += size_t(channels))
      right += static_cast<long double>(of.points[i]) * Sty[i];
    EXPECT_NEAR(double(left), double(right), rounding_of<Real>(most_terms) * double(size + 1))
        << "seed " << options.seed << ", channel " << c << " of " << channels;
  }
}

TEST(PatternEvaluator, HasATranspose) {
  for (const std::int64_t target : kernels::targets()) {
    const Target scope(target);
    for (const RandomTable& options : random_tables())
      for (const int channels : {1, 3, 5})
        for (const bool reproducible : {false, true}) {
          expect_transpose<double>(options, channels, reproducible);
          expect_transpose<float>(options, channels, reproducible);
        }
  }
}

TEST(PatternEvaluator, TransposesThePositionsAlone) {
  RandomTable options;
  options.quantities = 3;
  options.copies = options.first = options.rest = true;
  const Case<double> of(options, 3);
  const PatternEvaluator<double> evaluator(of.table);
  std::vector<double> y = random_numbers<double>(of.quantity(), 5), alone(of.points.size()), all(of.points.size());
  evaluator.apply_transpose(y, 3, alone);
  y.resize(of.size(), 0.0);
  evaluator.apply_transpose(y, 3, all);
  EXPECT_EQ(alone, all);
}

TEST(PatternEvaluator, TransposesWithTheSameBitsEverywhere) {
  RandomTable options;
  options.quantities = 3;
  options.blocks = 60;
  options.copies = options.first = options.rest = true;
  const Case<float> of(options, 3);
  const std::vector<float> y = random_numbers<float>(of.size(), 5);
  std::vector<float> expected;
  for (const std::int64_t target : kernels::targets())
    for (const size_t threads : {1, 4}) {
      const Target scope(target);
      const tbb::global_control some(tbb::global_control::max_allowed_parallelism, threads);
      std::vector<float> made(of.points.size());
      PatternEvaluator<float>(of.table, {.reproducible = true}).apply_transpose(y, 3, made);
      if (expected.empty()) expected = made;
      EXPECT_EQ(made, expected);
    }
}

TEST(PatternEvaluator, RefusesWhatDoesNotFit) {
  RandomTable options;
  options.quantities = 3;
  const Case<float> of(options, 3);
  const PatternEvaluator<float> evaluator(of.table);
  const auto expect_refused = [&](const auto& change, std::initializer_list<std::string_view> words) {
    All<float> made(of);
    change(made.evaluation);
    expect_error<InvalidParameter>([&] { evaluator.apply(made.evaluation); }, words);
  };
  using E = Evaluation<float>;
  expect_refused([](E& e) { e.channels = 0; }, {"0 channels", "1 to 64"});
  expect_refused([](E& e) { e.channels = 65; }, {"65 channels"});
  expect_refused([](E& e) { e.frames = -1; }, {"-1 frames"});
  expect_refused([](E& e) { e.frames = 2; }, {"points hold 150", "300 are needed"});
  expect_refused([](E& e) { e.points = e.points.first(149); }, {"points hold 149", "150 are needed"});
  expect_refused([](E& e) { e.quantities[2] = e.quantities[2].first(5); }, {"derivatives along v hold 5"});
  expect_refused([](E& e) { e.quantities[3] = e.quantities[2]; }, {"derivatives by uu", "3 quantities"});
  expect_refused([](E& e) { e.normals = e.normals.first(5); }, {"normals hold 5"});
  expect_refused([](E& e) { e.result_layout.point = 2; }, {"results overlap", "2 from point to point"});
  expect_refused([](E& e) { e.point_layout.point = -3; }, {"points overlap"});
  expect_refused([](E& e) { e.point_layout.channel = 0; }, {"points overlap"});
  expect_refused([](E& e) { e.result_layout = PointLayout::planar(8); }, {"results overlap"});
  expect_refused([](E& e) { e.frames = 2, e.result_layout.frame = 3; }, {"results overlap", "3 from frame to frame"});
  expect_refused([](E& e) { e.point_layout.point = std::int64_t{1} << 62; }, {"points hold 150"});
  expect_refused([](E& e) { e.channels = 2; }, {"tangent frames of 2 channels"});
  std::vector<float> few(5);
  expect_error<InvalidParameter>([&] { evaluator.apply_transpose(few, 3, few); }, {"values hold 5"});
  expect_error<InvalidParameter>([&] { evaluator.apply_transpose(std::vector<float>(of.size()), 3, few); },
                                 {"result holds 5"});
  All<float> made(of);
  expect_error<InvalidParameter>([&] { evaluator.apply_patches(made.evaluation, {}, 0, evaluator.num_patches() + 1); },
                                 {"patches from 0"});
  options.quantities = 1;
  const Case<float> plain(options, 3);
  All<float> positions(plain);
  positions.evaluation.normals = positions.evaluation.quantities[0];
  expect_error<InvalidParameter>([&] { PatternEvaluator<float>(plain.table).apply(positions.evaluation); },
                                 {"without derivatives"});
  options.first = true;
  const Case<float> stepped(options, 3);
  All<float> in_parts(stepped);
  expect_error<InvalidParameter>([&] { PatternEvaluator<float>(stepped.table).apply_rest(in_parts.evaluation, few); },
                                 {"inputs hold 5", "270 are needed"});
}

}  // namespace
}  // namespace sublimit::testing
