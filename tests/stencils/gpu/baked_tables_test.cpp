// SPDX-License-Identifier: Apache-2.0
// Tables of every scheme, however they are made, are on a GPU what the scalar kernel makes of them, within two
// roundings of the sum of the magnitudes of their terms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "eval/gpu/comparisons.h"
#include "eval/gpu/made_tables.h"
#include "eval/gpu/test_device.h"
#include "laws/tested_schemes.h"
#include "meshes/face_varying_meshes.h"
#include "meshes/free_form_shapes.h"
#include "meshes/shared_meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/gpu/gpu_evaluator.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::testing {
namespace {

/// What was compared.
struct Compared {
  int tables = 0;
  size_t numbers = 0, normals = 0;
  std::set<std::string> parts;  ///< that the tables had
};

void note_parts(const Baked& baked, Compared& compared) {
  const auto& a = baked.table.table.arrays();
  compared.parts.insert(name(baked.statistics.method));
  if (!a.groups.empty()) compared.parts.insert("patches");
  if (!a.patch_points.empty()) compared.parts.insert("places of patches");
  if (!a.copies.empty()) compared.parts.insert("copies");
  if (a.first) compared.parts.insert("first step");
  if (a.rest) compared.parts.insert("rows");
  compared.parts.insert(std::to_string(a.quantities) + " quantities");
  ++compared.tables;
}

void expect_the_scalar_kernel(const Baked& baked, Compared& compared) {
  const PatternTable<float> table = in_float(baked.table.table);
  const GpuEvaluator evaluator(table, test_device());
  const std::vector<float> points = random_numbers(size_t(table.num_control_points()) * 3, 7);
  const std::vector<double> terms = sums_of_terms(table, points, 3);
  std::vector<float> right(terms.size()), made(terms.size());
  apply_as_device(test_device(), table, points, 3, right);
  evaluator.apply(points, 3, made);
  expect_near_terms(made, right, terms);
  note_parts(baked, compared);
  compared.numbers += made.size();
  if (table.quantities() == 1) return;
  const auto length = size_t(table.num_points() * 3);
  std::vector<float> normals(length), own(length);
  Evaluation<float> e;
  e.points = points, e.normals = normals;
  PatternEvaluator<float>(table).apply(e);
  e.normals = own;
  evaluator.apply(e);
  compared.normals += expect_near_normals(own, normals, std::span(right).subspan(length, 2 * length),
                                          std::span(terms).subspan(length, 2 * length));
}

constexpr BakeMethod all_methods[] = {BakeMethod::automatic, BakeMethod::patterns, BakeMethod::rows_then_patterns,
                                      BakeMethod::rows};

/// By each method that is possible.
void compare_all_methods(Patterns& patterns, const Mesh& mesh, BakeRequest request, Compared& compared) {
  int possible = 0;
  for (const BakeMethod method : all_methods) {
    request.method = method;
    std::optional<Baked> baked;
    try {
      baked = bake(patterns, mesh, request);
    } catch (const InvalidParameter&) {
      continue;  // this scheme does not, or this mesh
    }
    ++possible;
    SCOPED_TRACE(name(request.rows) + std::string(", ") + name(method));
    expect_the_scalar_kernel(*baked, compared);
  }
  // Automatic, and rows; second derivatives at the vertices of a level there are by patterns alone, of some schemes.
  const bool may_be_none = request.rows == TableRows::limit && request.derivatives == 2;
  EXPECT_GE(possible, may_be_none ? 0 : 2);
}

/// Closed, and with all that a mesh may have: borders, sharp edges and vertices, a hole.
std::vector<Mesh> few_meshes(const Scheme<double>& scheme) {
  std::vector<Mesh> meshes = hard_meshes(scheme, 4);
  meshes.erase(meshes.begin() + 1, meshes.end() - 1);
  return meshes;
}

std::vector<TestedScheme> registered_schemes() {
  std::vector<TestedScheme> tested;
  for (const Scheme<double>& scheme : all_schemes()) tested.push_back({scheme.name, {}});
  return tested;
}

class GpuLevels : public ::testing::TestWithParam<TestedScheme> {};

TEST_P(GpuLevels, AreWhatTheScalarKernelMakes) {
  const Scheme<double> scheme = GetParam().scheme();
  Patterns patterns(scheme);
  Compared compared;
  for (const Mesh& mesh : few_meshes(scheme))
    for (int level = scheme.period; level <= std::max(scheme.period, effort(scheme) == 1 ? 3 : 1);
         level += scheme.period) {
      SCOPED_TRACE("level " + std::to_string(level));
      compare_all_methods(patterns, mesh, {.rows = TableRows::level, .level = level}, compared);
    }
  EXPECT_GE(compared.tables, 4);
  EXPECT_GT(compared.numbers, 1000u);
  EXPECT_TRUE(compared.parts.contains("rows"));
  EXPECT_TRUE(compared.parts.contains("patches"));
}

INSTANTIATE_TEST_SUITE_P(Schemes, GpuLevels, ::testing::ValuesIn(registered_schemes()), test_name);

class GpuLimits : public ::testing::TestWithParam<TestedScheme> {};

TEST_P(GpuLimits, AreWhatTheScalarKernelMakes) {
  const Scheme<double> scheme = GetParam().scheme();
  Patterns patterns(scheme);
  Compared compared;
  std::vector<Mesh> meshes = few_meshes(scheme);
  if (!scheme.has_one_ring_limits()) meshes.erase(meshes.begin(), meshes.end() - 1);
  for (const Mesh& mesh : meshes)
    for (const int derivatives : {0, 1, 2}) {
      SCOPED_TRACE(std::to_string(derivatives) + " derivatives");
      compare_all_methods(patterns, mesh, {.rows = TableRows::grid, .grid = 4, .derivatives = derivatives}, compared);
      compare_all_methods(patterns, mesh, {.rows = TableRows::limit, .level = 1, .derivatives = derivatives}, compared);
      BakeRequest places{.rows = TableRows::samples, .derivatives = derivatives};
      const LimitMap surface(scheme, mesh, {}, patterns.types());
      for (Index f = 0; f < surface.addresses().size(); ++f) {
        places.samples.push_back({f, 0.25, 0.125});
        if (f % 2 == 0) places.samples.push_back({f, 0, 0});
      }
      compare_all_methods(patterns, mesh, places, compared);
    }
  EXPECT_GE(compared.tables, 18);
  EXPECT_GT(compared.numbers, 10'000u);
  EXPECT_GT(compared.normals, 100u);
  for (const char* part : {"rows", "patches", "1 quantities", "3 quantities", "6 quantities"})
    EXPECT_TRUE(compared.parts.contains(part)) << part;
}

INSTANTIATE_TEST_SUITE_P(Schemes, GpuLimits, ::testing::ValuesIn(schemes_and_degrees()), test_name);

/// The tests above leave out no scheme and, together, no part of a table.
TEST(GpuTables, AreOfEverySchemeAndHaveEveryPart) {
  EXPECT_EQ(registered_schemes().size(), all_schemes().size());
  std::set<std::string> names;
  for (const TestedScheme& tested : schemes_and_degrees()) names.insert(tested.name);
  // Their types take a minute each: the full sweep has them.
  EXPECT_EQ(names.size(), all_schemes().size() - (full_sweep() ? 0 : 2));
  EXPECT_GE(names.size(), 10u);

  Patterns patterns(find_scheme("catmull-clark").value());
  Compared compared;
  Mesh mesh = with_random_channel(hard_polygons(4, {.open = true, .semi_sharp = true}), 0.2);
  mesh.holes = {3, 7};
  for (const TableRows rows : {TableRows::level, TableRows::limit})
    compare_all_methods(patterns, mesh, {.rows = rows, .level = 2, .face_varying = true, .tags = true}, compared);
  mesh = torus(9, 8);
  compare_all_methods(patterns, mesh, {.rows = TableRows::level, .level = 3}, compared);
  compare_all_methods(patterns, mesh, {.rows = TableRows::grid, .grid = 9, .derivatives = 2}, compared);
  BakeRequest places{.rows = TableRows::samples, .derivatives = 1};
  for (Index i = 0; i < 300; ++i) places.samples.push_back({i * 7 % 72, double(i % 5) / 8, double(i % 4) / 8});
  compare_all_methods(patterns, mesh, places, compared);
  for (const char* part :
       {"patches", "places of patches", "copies", "first step", "rows", "1 quantities", "3 quantities", "6 quantities"})
    EXPECT_TRUE(compared.parts.contains(part)) << "no table has " << part;
  EXPECT_GE(compared.tables, 15);
}

TEST(GpuTables, OfTheSharedMeshes) {
  if (shared_meshes().empty()) GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES;
  Compared compared;
  Patterns catmull_clark(find_scheme("catmull-clark").value()), loop(find_scheme("loop").value());
  for (const SharedMesh& shared : shared_meshes()) {
    const Mesh mesh = read_mesh(shared.path);
    if (mesh.num_faces() > (full_sweep() ? 100'000 : 3000)) continue;
    SCOPED_TRACE(shared.name);
    Patterns& patterns = shared.scheme == "loop" ? loop : catmull_clark;
    expect_the_scalar_kernel(bake(patterns, mesh, {.rows = TableRows::level, .level = 2}), compared);
    expect_the_scalar_kernel(bake(patterns, mesh, {.rows = TableRows::limit, .level = 1, .derivatives = 1}), compared);
  }
  EXPECT_GE(compared.tables, 100);
  EXPECT_GT(compared.numbers, 500'000u);
  EXPECT_GT(compared.normals, 10'000u);
}

/// Rational surfaces: quotients of the same sums, and what their roundings become.
TEST(GpuTables, OfRationalSurfaces) {
  Compared compared;
  for (const RationalShape& shape : {unit_sphere(), torus(), pipe(), elevated(unit_sphere())}) {
    const PatchSet patches({std::make_shared<const SplineSurface>(shape.surface)}, Coordinates::homogeneous);
    std::vector<BakeRequest> requests{{.rows = TableRows::level, .level = 2}};
    for (const int derivatives : {0, 1, 2}) {
      requests.push_back({.rows = TableRows::grid, .grid = 5, .derivatives = derivatives});
      requests.push_back({.rows = TableRows::samples, .derivatives = derivatives});
      for (Index f = 0; f < patches.faces().size; ++f) requests.back().samples.push_back({f, 0.25, 0.625});
    }
    for (const BakeRequest& request : requests) {
      const Baked baked = bake(patches, request);
      ASSERT_TRUE(baked.table.info.rational);
      const PatternTable<float> table = in_float(baked.table.table);
      std::vector<float> points(shape.columns.data(), shape.columns.data() + shape.columns.size());
      std::vector<float> columns(size_t(table.quantities() * table.num_points() * 4));
      apply_as_device(test_device(), table, points, 4, columns);
      const std::vector<double> errors =
          roundings_of_quotients(columns, sums_of_terms(table, points, 4), table.quantities(), 4);
      const GpuEvaluator evaluator(table, test_device());
      const auto length = size_t(table.num_points() * 3);
      std::vector<float> right(errors.size()), made(errors.size()), normals(length), own(length);
      const auto evaluation = [&](std::vector<float>& all, std::vector<float>& unit) {
        Evaluation<float> e;
        e.channels = 4, e.rational = true, e.points = points;
        e.least_weight = noise_of_weights(e, table.num_control_points());
        for (int q = 0; q < table.quantities(); ++q)
          e.quantities[size_t(q)] = std::span(all).subspan(size_t(q) * length, length);
        if (table.quantities() > 1) e.normals = unit;
        return e;
      };
      PatternEvaluator<float>(table).apply(evaluation(right, normals));
      evaluator.apply(evaluation(made, own));
      for (size_t i = 0; i < made.size(); ++i) {
        ASSERT_TRUE(std::isfinite(errors[i]));
        ASSERT_LE(std::abs(double(made[i]) - double(right[i])), errors[i]) << "number " << i;
      }
      note_parts(baked, compared);
      compared.numbers += made.size();
      if (table.quantities() == 1) continue;
      std::vector<double> terms;
      for (size_t i = length; i < 3 * length; ++i) terms.push_back(errors[i] / float_rounding);
      compared.normals += expect_near_normals(own, normals, std::span(right).subspan(length, 2 * length), terms);
    }
  }
  EXPECT_EQ(compared.tables, 4 * 7);
  EXPECT_GT(compared.numbers, 5'000u);
  EXPECT_GT(compared.normals, 500u);
}

}  // namespace
}  // namespace sublimit::testing
