// SPDX-License-Identifier: Apache-2.0
// Counts what this program allocates on one thread.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <new>

#include "sublimit/pattern_evaluator.h"
#include "support/random_tables.h"

namespace {
thread_local std::int64_t allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace sublimit::testing {
namespace {

TEST(Allocation, OfTheSecondApplyIsNone) {
  RandomTable options;
  options.quantities = 3;
  // As many as one thread does without a scheduler, which allocates for itself.
  options.blocks = 6;
  options.most_patches = 8;
  options.copies = options.first = options.rest = true;
  const PatternTable<float> table = random_table<float>(options);
  ASSERT_LE(table.num_patches(), 256);
  const PatternEvaluator<float> evaluator(table);
  const std::vector<float> points = random_numbers<float>(size_t(table.num_control_points()) * 3, 1);
  std::vector<float> made(size_t(table.num_points()) * 9), normals(made.size() / 3), transposed(points.size());
  Evaluation<float> evaluation;
  evaluation.points = points;
  evaluation.normals = normals;
  const auto run = [&] {
    const std::int64_t before = allocations;
    evaluator.apply(points, 3, made);
    evaluator.apply(evaluation);
    evaluator.apply_transpose(made, 3, transposed);
    return allocations - before;
  };
  EXPECT_GT(run(), 0) << "the counter does not count";
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(run(), 0);
}

}  // namespace
}  // namespace sublimit::testing
