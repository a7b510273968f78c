// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/gpu_evaluator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <thread>
#include <vector>

#include "eval/gpu/comparisons.h"
#include "eval/gpu/made_tables.h"
#include "eval/gpu/test_device.h"
#include "laws/keeps_references.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/gpu/detail/packed_table.h"

namespace sublimit::testing {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr double eps = float_rounding;

static_assert(keeps_named_only<GpuEvaluator, PatternTable<float>, const GpuDevice&>);

/// One of all combinations of parts, and a number of channels.
MadeTable parts_of(unsigned seed) {
  MadeTable parts;
  parts.quantities = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 3 : 6;
  parts.first = (seed & 1) != 0, parts.rest = (seed & 2) != 0, parts.copies = (seed & 4) != 0;
  parts.placed = (seed & 8) != 0;
  parts.many = seed % 7 == 6;
  return parts;
}

TEST(GpuEvaluator, IsTestedWithEveryKindOfTiles) {
  for (const unsigned seed : {6u, 13u, 20u})  // of 1, 3 and 6 quantities
    for (size_t size = 0; size <= seed % 3; ++size)
      for (const bool many : {false, true})
        EXPECT_GT(gpu::PackedTable(made_table(parts_of(seed), seed)).patches[size][many].count, 0) << seed;
  const gpu::PackedTable small(made_table(parts_of(0), 0));
  EXPECT_GT(small.patches[0][false].count, 0);
  EXPECT_EQ(small.patches[0][true].count, 0);  // one launch
}

TEST(GpuEvaluator, MakesWhatTheScalarKernelMakes) {
  for (unsigned seed = 0; seed < 48; ++seed) {
    const PatternTable<float> table = made_table(parts_of(seed), seed);
    const int channels = 1 + int(seed % 7);
    const std::vector<float> points = random_numbers(size_t(table.num_control_points() * channels), seed);
    std::vector<float> right(size_t(table.quantities() * table.num_points() * channels)), made(right.size(), nan);
    apply_as_device(test_device(), table, points, channels, right);
    const GpuEvaluator evaluator(table, test_device());
    evaluator.apply(points, channels, made);
    SCOPED_TRACE(seed);
    expect_near_terms(made, right, sums_of_terms(table, points, channels));
    std::vector<float> again(right.size(), nan);
    evaluator.apply(points, channels, again);
    EXPECT_EQ(made, again);  // to the bit
  }
}

/// Frames, strides and planes, whatever lies between.
TEST(GpuEvaluator, TakesTheLayoutsThatEvaluatorsTake) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const PatternTable<float> table = made_table(parts_of(seed), seed);
    const int frames = 1 + int(seed % 3), channels = 1 + int(seed % 5);
    Evaluation<float> e;
    e.channels = channels, e.frames = frames;
    const std::int64_t controls = table.num_control_points(), made = table.num_points();
    e.point_layout = seed % 2 == 0 ? PointLayout::planar(controls + 3) : PointLayout::interleaved(channels + 2);
    e.result_layout = seed % 4 < 2 ? PointLayout::interleaved(channels + seed % 2) : PointLayout::planar(made + 1);
    const std::vector<float> points = random_numbers(size_t(frames * (controls + 3) * (channels + 2)), seed);
    e.points = points;
    const auto length = size_t(frames * (made + 1) * (channels + 1));
    std::vector<std::vector<float>> right(6, std::vector<float>(length, -7)), results = right;
    const auto want = [&](std::vector<std::vector<float>>& all) {
      for (int q = 0; q < table.quantities(); ++q)
        if (q != 1) e.quantities[size_t(q)] = all[size_t(q)];  // u is not wanted
    };
    want(results);
    const GpuEvaluator evaluator(table, test_device());
    evaluator.apply(e);
    // What points that lie together become, whatever is between them here.
    const auto place = [](const PointLayout& l, std::int64_t frame, int f, std::int64_t i, int c) {
      return size_t(f * frame + i * l.point + c * l.channel);
    };
    const auto frame_of = [&](const PointLayout& l, std::int64_t count) {
      return l.point < channels ? l.channel * channels : l.point * count;
    };
    for (int f = 0; f < frames; ++f) {
      std::vector<float> dense(size_t(controls * channels)), all(size_t(table.quantities() * made * channels), nan);
      for (std::int64_t i = 0; i < controls; ++i)
        for (int c = 0; c < channels; ++c)
          dense[size_t(i * channels + c)] = points[place(e.point_layout, frame_of(e.point_layout, controls), f, i, c)];
      evaluator.apply(dense, channels, all);
      for (int q = 0; q < table.quantities(); ++q)
        for (std::int64_t i = 0; q != 1 && i < made; ++i)
          for (int c = 0; c < channels; ++c)
            right[size_t(q)][place(e.result_layout, frame_of(e.result_layout, made), f, i, c)] =
                all[size_t((q * made + i) * channels + c)];
    }
    SCOPED_TRACE(seed);
    EXPECT_EQ(results, right);  // to the bit, and nothing else is written
  }
}

using Vector = std::array<double, 3>;
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) {
  const double size = std::sqrt(dot(a, a));
  return {a[0] / size, a[1] / size, a[2] / size};
}

TEST(GpuEvaluator, MakesUnitTangentFrames) {
  for (unsigned seed : {1u, 4u, 7u, 10u, 13u, 20u, 2u, 5u, 14u}) {
    const PatternTable<float> table = made_table(parts_of(seed), seed);
    ASSERT_GE(table.quantities(), 3);
    const std::vector<float> points = random_numbers(size_t(table.num_control_points() * 3), seed);
    const auto length = size_t(3 * table.num_points());
    std::vector<std::vector<float>> all(6, std::vector<float>(length, nan));  // u, v, then without them: v, t, b, n
    std::vector<float> alone(length, nan);
    Evaluation<float> e;
    e.points = points;
    e.quantities[1] = all[0], e.quantities[2] = all[1];
    e.tangents = all[3], e.bitangents = all[4], e.normals = all[5];
    const GpuEvaluator evaluator(table, test_device());
    evaluator.apply(e);
    Evaluation<float> normals;
    normals.points = points, normals.normals = alone;
    evaluator.apply(normals);
    EXPECT_EQ(alone, all[5]);  // whatever else is wanted
    SCOPED_TRACE(seed);
    size_t compared = 0;
    for (size_t i = 0; i < length; i += 3) {
      const auto at = [&](size_t k) { return Vector{all[k][i], all[k][i + 1], all[k][i + 2]}; };
      const Vector u = at(0), v = at(1), n = cross(u, v);
      const double sine = std::sqrt(dot(n, n) / (dot(u, u) * dot(v, v)));
      if (!(sine > 1e-3)) continue;  // u x v is little more than its rounding
      ++compared;
      const Vector right[] = {unit(u), cross(unit(n), unit(u)), unit(n)};
      for (size_t k = 0; k < 3; ++k)
        for (size_t c = 0; c < 3; ++c) ASSERT_NEAR(at(3 + k)[c], right[k][c], 4 * eps / sine) << "point " << i / 3;
    }
    EXPECT_GT(compared, length / 3 / 2);
  }
}

/// No frame where both derivatives point the same way: u x u is zero to the bit.
TEST(GpuEvaluator, MakesNoFrameOfParallelDerivatives) {
  PatternTable<float>::Arrays a;
  a.quantities = 3;
  a.blocks = {{1, 2, 0}};
  a.weights = {0.5f, 0.5f, -0.3f, 0.3f, -0.6f, 0.6f};
  a.groups = {{0, 1, 0, 1}};
  a.rows = {0};
  a.columns = {0, 1};
  const PatternTable<float> table(2, std::move(a));
  const std::vector<float> points{0.1f, 0.7f, 0.3f, 1.3f, 0.2f, 0.9f};
  std::vector<float> t(3, nan), b(3, nan), n(3, nan);
  Evaluation<float> e;
  e.points = points, e.tangents = t, e.bitangents = b, e.normals = n;
  GpuEvaluator(table, test_device()).apply(e);
  for (const auto& all : {t, b, n}) EXPECT_EQ(all, std::vector<float>(3, 0));
}

TEST(GpuEvaluator, DividesRationalPoints) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    MadeTable parts = parts_of(seed);
    parts.copies = false;  // whose derivatives are others'
    const PatternTable<float> table = made_table(parts, seed);
    const int channels = 2 + int(seed % 6);
    const std::vector<float> points = random_numbers(size_t(table.num_control_points() * channels), seed);
    const auto of_quantity = size_t(table.num_points()) * size_t(channels - 1);
    std::vector<float> columns(size_t(table.quantities() * table.num_points() * channels)), right, made;
    apply_as_device(test_device(), table, points, channels, columns);
    right.resize(size_t(table.quantities()) * of_quantity, nan), made = right;
    Evaluation<float> e;
    e.channels = channels, e.rational = true, e.points = points;
    e.least_weight = noise_of_weights(e, table.num_control_points());
    const auto results = [&](std::vector<float>& all) {
      for (size_t q = 0; q < size_t(table.quantities()); ++q)
        e.quantities[q] = std::span(all).subspan(q * of_quantity, of_quantity);
      return e;
    };
    PatternEvaluator<float>(table).apply(results(right));
    GpuEvaluator(table, test_device()).apply(results(made));
    const std::vector<double> roundings =
        roundings_of_quotients(columns, sums_of_terms(table, points, channels), table.quantities(), size_t(channels));
    SCOPED_TRACE(seed);
    for (size_t i = 0; i < made.size(); ++i) ASSERT_LE(std::abs(double(made[i]) - right[i]), roundings[i]) << i;
  }
}

TEST(GpuEvaluator, MakesPolesZero) {
  PatternTable<float>::Arrays a;
  a.blocks = {{2, 2, 0}};
  a.weights = {0.5f, 0.5f, 1, 0};
  a.groups = {{0, 2, 0, 1}};
  a.rows = {0, 1};
  a.columns = {0, 1};
  const PatternTable<float> table(2, std::move(a));
  const std::vector<float> points{1, 2, 3, 2, 1, 2, 3, -2};
  std::vector<float> made(6, nan);
  Evaluation<float> e;
  e.channels = 4, e.rational = true, e.points = points, e.quantities[0] = made;
  e.least_weight = noise_of_weights(e, 2);
  GpuEvaluator(table, test_device()).apply(e);
  EXPECT_EQ(made, (std::vector<float>{0, 0, 0, 0.5f, 1, 1.5f}));
}

TEST(GpuEvaluator, TransposeIsTheAdjoint) {
  for (unsigned seed = 0; seed < 48; ++seed) {
    const PatternTable<float> table = made_table(parts_of(seed), seed);
    const int channels = 1 + int(seed % 7);
    const std::vector<float> points = random_numbers(size_t(table.num_control_points() * channels), seed);
    const std::vector<float> values =
        random_numbers(size_t(table.quantities() * table.num_points() * channels), seed + 1);
    std::vector<float> made(values.size()), gradient(points.size(), nan);
    const GpuEvaluator evaluator(table, test_device());
    evaluator.apply(points, channels, made);
    evaluator.apply_transpose(values, channels, gradient);
    const auto dot = [](std::span<const float> x, std::span<const float> y) {
      return std::inner_product(x.begin(), x.end(), y.begin(), 0.0, std::plus<>(),
                                [](float a, float b) { return double(a) * double(b); });
    };
    SCOPED_TRACE(seed);
    const double size = std::sqrt(dot(made, made) * dot(values, values));
    EXPECT_NEAR(dot(made, values), dot(points, gradient), 8 * eps * size);
    std::vector<float> right(points.size()), again(points.size(), nan);
    PatternEvaluator<float>(table).apply_transpose(values, channels, right);
    expect_near_terms(gradient, right, sums_of_transposed_terms(table, values, channels), roundings_of_another_order);
    evaluator.apply_transpose(values, channels, again);
    EXPECT_EQ(gradient, again);  // to the bit
    if (table.quantities() == 1) continue;
    // Values of positions alone.
    const std::span<const float> first = std::span(values).first(values.size() / size_t(table.quantities()));
    PatternEvaluator<float>(table).apply_transpose(first, channels, right);
    evaluator.apply_transpose(first, channels, again);
    expect_near_terms(again, right, sums_of_transposed_terms(table, first, channels), roundings_of_another_order);
  }
}

TEST(GpuEvaluator, RoundsToHalves) {
  const GpuDevice device = test_device();
  if (!device.info().halves) GTEST_SKIP() << device.info().name << " has no half floats";
  for (unsigned seed = 0; seed < 16; ++seed) {
    const PatternTable<float> table = made_table(parts_of(seed), seed);
    const int channels = 1 + int(seed % 4);
    const std::vector<float> points = random_numbers(size_t(table.num_control_points() * channels), seed);
    std::vector<float> right(size_t(table.num_points() * channels));
    Evaluation<float> e;
    e.channels = channels, e.points = points, e.quantities[0] = right;
    const GpuEvaluator evaluator(table, device);
    evaluator.apply(e);

    GpuBuffer in(device, std::int64_t(4 * points.size())), out(device, std::int64_t(2 * right.size() + 4));
    in.write(std::as_bytes(std::span(points)));
    std::vector<std::uint16_t> made(right.size() + 2, 0x7e00);
    out.write(std::as_bytes(std::span(made)));
    GpuEvaluation g;
    g.channels = channels, g.points = in.address(), g.halves = true;
    g.quantities[0] = out.address() + (seed % 2 == 0 ? 0 : 2);  // at whole words, and not
    GpuBuffer scratch(device, evaluator.num_scratch_bytes(g));
    g.scratch = scratch.address();
    evaluator.prepare(g);
    GpuCommands commands(device);
    evaluator.record(commands, g);
    commands.submit_and_wait();
    out.read(std::as_writable_bytes(std::span(made)));
    SCOPED_TRACE(seed);
    const size_t begin = seed % 2;
    for (size_t i = 0; i < right.size(); ++i)
      ASSERT_NEAR(half_value(made[begin + i]), right[i], 0x1p-11 * std::abs(right[i]) + 0x1p-25) << i;
    EXPECT_EQ(made[right.size() + begin], 0x7e00);  // nothing beyond
    EXPECT_EQ(made[begin == 1 ? 0 : right.size() + 1], 0x7e00);
  }
}

TEST(GpuEvaluator, RefusesWhatItCannotMake) {
  const PatternTable<float> table = made_table({.quantities = 1, .first = true}, 3);
  const GpuDevice device = test_device();
  const GpuEvaluator evaluator(table, device);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  GpuEvaluation e;
  e.points = 4, e.quantities[0] = 4, e.scratch = 4;
  EXPECT_EQ(message([&] { evaluator.prepare(e); }), "nothing");
  e.scratch = 0;
  EXPECT_EQ(message([&] { evaluator.prepare(e); }),
            "evaluation: a table with a first step needs scratch on the device");
  e.scratch = 4, e.points = 2;
  EXPECT_EQ(message([&] { evaluator.prepare(e); }),
            "evaluation: points on the device at an address that is no multiple of 4");
  e.points = 0;
  EXPECT_EQ(message([&] { evaluator.prepare(e); }), "evaluation: no points on the device");
  e.points = 4, e.normals = 4;
  EXPECT_EQ(message([&] { evaluator.prepare(e); }), "evaluation: tangent frames of a table without derivatives");
  e.normals = 0, e.channels = 65;
  EXPECT_EQ(message([&] { evaluator.prepare(e); }), "evaluation: 65 channels; 1 to 64 are right");
  e.channels = 3, e.point_layout.point = std::int64_t{1} << 40;
  EXPECT_EQ(message([&] { evaluator.prepare(e); }), "strides of 1099511627776 numbers; a GPU takes up to 1073741823");
  std::vector<float> points(7), result(size_t(3 * table.num_points()));
  EXPECT_THROW(evaluator.apply(points, 3, result), InvalidParameter);
  e = {};
  if (device.info().api == GpuApi::vulkan) {
    EXPECT_EQ(message([&] { evaluator.record(static_cast<CUstream_st*>(nullptr), e); }),
              "commands of CUDA for a device of Vulkan");
    e.quantities[0] = 4, e.points = 4, e.scratch = 4;
    const GpuDevice another(0);
    GpuCommands commands(another);
    const GpuEvaluator unprepared(table, another);
    EXPECT_EQ(message([&] { unprepared.record(commands, e); }),
              "an evaluation that the GPU was not prepared for; call `prepare` with it first");
  }
  EXPECT_THROW(GpuBuffer(device, -1), InvalidParameter);
  GpuBuffer small(device, 4);
  EXPECT_THROW(small.write(std::as_bytes(std::span(points))), InvalidParameter);
  EXPECT_THROW(GpuDevice(1000), InvalidOption);

  // A point that is copied, and then written: all copies are made at once.
  PatternTable<float>::Arrays a = table.arrays();
  a.copies = {0, 1, 1, 2};
  const PatternTable<float> entangled(table.num_control_points(), std::move(a));
  EXPECT_EQ(message([&] { GpuEvaluator(entangled, device); }),
            "a table whose copies take point 1 and then write it cannot be applied on a GPU; copy it last");
}

TEST(GpuEvaluator, TakesTablesWithNothingInThem) {
  const PatternTable<float> empty(0, {}), controls(5, {});
  PatternTable<float>::Arrays a;
  a.blocks = {{2, 0, 0}, {0, 3, 0}};
  a.groups = {{0, 2, 0, 1}, {1, 0, 2, 1}};
  a.rows = {1, 0};
  a.columns = {0, 1, 2};
  const PatternTable<float> without_columns(3, std::move(a));
  for (const PatternTable<float>* table : {&empty, &controls, &without_columns}) {
    const GpuEvaluator evaluator(*table, test_device());
    const std::vector<float> points(size_t(3 * table->num_control_points()), 1);
    std::vector<float> made(size_t(3 * table->num_points()), nan), gradient(points.size(), nan);
    evaluator.apply(points, 3, made);
    EXPECT_EQ(made, std::vector<float>(made.size(), 0));
    evaluator.apply_transpose(made, 3, gradient);
    EXPECT_EQ(gradient, std::vector<float>(gradient.size(), 0));
  }
}

/// Patches of one point, of more rows than a workgroup has threads, of more columns than fit in its memory.
TEST(GpuEvaluator, TakesBlocksOfAnySize) {
  unsigned seed = 100;
  for (const int rows : {1, 2, 3, 5, 63, 65, 130, 257, 1100})
    for (const int columns : {1, 17, 300}) {
      MadeTable parts{.quantities = seed % 2 == 0 ? 1 : 3, .placed = seed % 4 == 3};
      parts.largest_rows = rows, parts.largest_columns = columns, parts.largest_count = 6000 / (rows * columns) + 2;
      const PatternTable<float> table = made_table(parts, ++seed);
      const std::vector<float> points = random_numbers(size_t(table.num_control_points() * 3), seed);
      std::vector<float> right(size_t(table.quantities() * table.num_points() * 3)), made(right.size(), nan);
      apply_as_device(test_device(), table, points, 3, right);
      GpuEvaluator(table, test_device()).apply(points, 3, made);
      SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
      expect_near_terms(made, right, sums_of_terms(table, points, 3));
    }
}

TEST(GpuEvaluator, IsUsedByManyThreadsAtOnce) {
  const GpuDevice device = test_device();
  std::vector<PatternTable<float>> tables;
  for (unsigned seed = 0; seed < 4; ++seed) tables.push_back(made_table(parts_of(seed), seed));
  std::vector<GpuEvaluator> evaluators;
  for (const auto& table : tables) evaluators.emplace_back(table, device);
  std::vector<std::thread> threads;
  std::vector<int> wrong(8);
  for (size_t thread = 0; thread < 8; ++thread)
    threads.emplace_back([&, thread] {
      for (unsigned i = 0; i < 12; ++i) {
        const size_t number = (thread + i) % tables.size();
        const PatternTable<float>& table = tables[number];
        const std::vector<float> points = random_numbers(size_t(table.num_control_points() * 3), unsigned(thread) + i);
        std::vector<float> right(size_t(table.quantities() * table.num_points() * 3)), made(right.size(), nan);
        table.apply(points, 3, right);
        evaluators[number].apply(points, 3, made);
        for (size_t k = 0; k < made.size(); ++k) wrong[thread] += !(std::abs(made[k] - right[k]) <= 1e-4f);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(8));
}

/// Tables beside each other in one submission.
TEST(GpuEvaluator, RecordsSeveralTablesIntoOneSubmission) {
  const GpuDevice device = test_device();
  std::vector<PatternTable<float>> tables;
  for (unsigned seed = 0; seed < 20; ++seed) tables.push_back(made_table(parts_of(seed), seed));
  std::vector<GpuEvaluator> evaluators;
  std::vector<GpuBuffer> buffers;
  std::vector<std::vector<float>> right, made;
  GpuCommands commands(device);
  for (const auto& table : tables) {
    const std::vector<float> points = random_numbers(size_t(table.num_control_points() * 3), 7);
    evaluators.emplace_back(table, device);
    const auto length = size_t(table.num_points() * 3);
    right.emplace_back(length);
    made.emplace_back(length);
    Evaluation<float> host;
    host.points = points, host.quantities[0] = right.back();
    evaluators.back().apply(host);
    GpuEvaluation e;
    buffers.emplace_back(device, std::int64_t(4 * points.size())).write(std::as_bytes(std::span(points)));
    e.points = buffers.back().address();
    e.quantities[0] = buffers.emplace_back(device, std::int64_t(4 * length)).address();
    e.scratch = buffers.emplace_back(device, evaluators.back().num_scratch_bytes(e)).address();
    evaluators.back().prepare(e);
    evaluators.back().record(commands, e);
  }
  commands.submit_and_wait();
  for (size_t i = 0; i < tables.size(); ++i) {
    buffers[3 * i + 1].read(std::as_writable_bytes(std::span(made[i])));
    EXPECT_EQ(made[i], right[i]) << "table " << i;  // as if it were alone
  }
}

}  // namespace
}  // namespace sublimit::testing
