// SPDX-License-Identifier: Apache-2.0
// Every frame after the first one is made without memory from the system, whatever kind of table and of request.
#include "support/allocations.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <functional>
#include <string>
#include <vector>

#include "meshes/random_tables.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"

namespace sublimit::testing {
namespace {

struct Frame {
  std::string name;
  std::function<void()> make;
};

/// All that an evaluator can be asked for, with the memory for it.
template <class Real>
class Requests {
 public:
  explicit Requests(const PatternTable<Real>& table)
      : evaluator_(table), quantities_(table.quantities()), frames_(2), num_points_(size_t(table.num_points())) {
    const size_t inputs = size_t(table.num_control_points()), most_channels = 4;
    points_ = random_numbers<Real>(frames_ * inputs * most_channels, 1);
    results_.resize(size_t(quantities_), std::vector<Real>(frames_ * num_points_ * most_channels));
    made_.resize(size_t(quantities_) * num_points_ * 3);
    for (std::vector<Real>& unit : units_) unit.resize(frames_ * num_points_ * 3);
    transposed_.resize(inputs * 3);
  }

  std::vector<Frame> frames() {
    std::vector<Frame> all{
        {"apply",
         [&] {
           evaluator_.apply({points_.data(), transposed_.size()}, 3, made_);
         }},
        {"quantities", [&] { evaluator_.apply(evaluation(3)); }},
        {"planar frames", [&] { evaluator_.apply(planar()); }},
        {"rational", [&] { evaluator_.apply(rational()); }},
        {"transpose", [&] { evaluator_.apply_transpose(made_, 3, transposed_); }},
    };
    if (quantities_ >= 3) all.push_back({"tangent frames", [&] { evaluator_.apply(framed()); }});
    return all;
  }

 private:
  Evaluation<Real> evaluation(int channels) {
    Evaluation<Real> e;
    e.channels = channels;
    e.points = points_;
    for (size_t q = 0; q < results_.size(); ++q) e.quantities[q] = results_[q];
    return e;
  }
  Evaluation<Real> planar() {
    Evaluation<Real> e = evaluation(3);
    e.frames = int(frames_);
    e.result_layout = PointLayout::planar(std::int64_t(num_points_));
    return e;
  }
  Evaluation<Real> rational() {
    Evaluation<Real> e = evaluation(4);
    e.rational = true;
    return e;
  }
  Evaluation<Real> framed() {
    Evaluation<Real> e = evaluation(3);
    e.tangents = units_[0], e.bitangents = units_[1], e.normals = units_[2];
    return e;
  }

  PatternEvaluator<Real> evaluator_;
  int quantities_;
  size_t frames_, num_points_;
  std::vector<Real> points_, made_, transposed_, units_[3];
  std::vector<std::vector<Real>> results_;
};

/// @return  allocations of the first frames
template <class Real>
std::int64_t expect_one_time_only(const RandomTable& options) {
  const PatternTable<Real> table = random_table<Real>(options);
  Requests<Real> requests(table);
  std::int64_t first = 0;
  for (const Frame& frame : requests.frames()) {
    SCOPED_TRACE(frame.name + ", seed " + std::to_string(options.seed));
    const auto allocated = [&] {
      const std::int64_t before = allocations();
      frame.make();
      return allocations() - before;
    };
    first += allocated();
    EXPECT_EQ(allocated(), 0);
    EXPECT_EQ(allocated(), 0);
  }
  return first;
}

TEST(Allocation, OfEveryFrameButTheFirstIsNone) {
  if (!allocations_are_counted()) GTEST_SKIP() << "SKIPPED: sanitizers have allocators of their own";
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::int64_t first = 0;
  std::vector<RandomTable> tables = random_tables();
  RandomTable large = tables.back();  // more blocks of patches than one: by the scheduler
  large.most_patches = 1000;
  tables.push_back(large);
  for (const RandomTable& options : tables)
    first += expect_one_time_only<float>(options) + expect_one_time_only<double>(options);
  EXPECT_GT(first, 0) << "the counter does not count";
}

TEST(Allocation, OfRowsIsNone) {
  if (!allocations_are_counted()) GTEST_SKIP() << "SKIPPED: sanitizers have allocators of their own";
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::mt19937 random(1);
  const StencilTable<double> table = random_rows<double>(50, 20000, random);
  const std::vector<double> points = random_numbers<double>(150, 1);
  std::vector<double> made(60000);
  table.apply(points, 3, made);
  const std::int64_t before = allocations();
  table.apply(points, 3, made);
  EXPECT_EQ(allocations() - before, 0);
}

}  // namespace
}  // namespace sublimit::testing
