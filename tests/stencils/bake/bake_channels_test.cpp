// SPDX-License-Identifier: Apache-2.0
// Tables with texture coordinates and tags are the refined mesh, in another order of points and faces.
#include "sublimit/stencils/bake/detail/bake_channels.h"

#include <gtest/gtest.h>

#include "laws/tested_schemes.h"
#include "meshes/face_varying_meshes.h"
#include "meshes/same_mesh.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/eval/file/detail/check_table.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/stencils/bake/detail/applied_points.h"
#include "sublimit/stencils/bake/detail/table_mesh.h"
#include "sublimit/stencils/files/level_files.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// What `apply` writes, read back.
Mesh applied(const BakedTable<double>& table, const Mesh& mesh) {
  std::vector<double> values(size_t(table.table.quantities() * table.table.num_points()) * 3);
  table.table.apply({mesh.positions.data(), size_t(mesh.positions.size())}, 3, values);
  Mesh out = AppliedPoints(table).mesh(faces_of(table), std::span<const double>(values));
  add_channels(out, table);
  return parse_obj(format_obj(out), "applied");
}

/// What `refine` writes, read back.
Mesh refined(const Scheme<double>& scheme, const Mesh& mesh, int levels, const SubdivisionOptions& options = {}) {
  const FaceVaryingInterpolation interpolation =
      mesh.face_varying_interpolation.value_or(FaceVaryingInterpolation::all);
  const std::vector<Level> all = refine(scheme, mesh, levels, options);
  Points points = mesh.positions;
  for (int k = 1; k <= levels; ++k) points = apply(all[k].S, points);
  Mesh out = level_output(all.back(), points, mesh, options, true);
  if (!mesh.face_varying.empty()) {
    const auto channel = refine_face_varying(scheme, interpolation, mesh.face_varying[0], all);
    add_channel(out, channel.back(), "uv", refined_values(channel, mesh.face_varying[0].values));
    out.face_varying_interpolation = interpolation;
  }
  return parse_obj(format_obj(out), "refined");
}

BakeRequest request_of(int levels, BakeMethod method) {
  return {.level = levels, .method = method, .face_varying = true, .tags = true};
}

/// Points of 2 and 3 levels: sums of up to 100 terms each, some in differences.
double tolerance(const Mesh& mesh) { return rounding(40, mesh.positions.cwiseAbs().maxCoeff()); }

class BakedChannels : public ::testing::TestWithParam<TestedScheme> {};

TEST_P(BakedChannels, AreThoseOfRefinement) {
  const Scheme<double> scheme = GetParam().scheme();
  Patterns patterns(scheme);
  int count = 0;
  for (const Mesh& hard : hard_meshes(scheme, 4))
    for (const FaceVaryingInterpolation interpolation : all_interpolations) {
      Mesh mesh = with_random_channel(hard, 0.2);
      mesh.face_varying_interpolation = interpolation;
      for (const BakeMethod method : {BakeMethod::automatic, BakeMethod::rows_then_patterns, BakeMethod::rows}) {
        SCOPED_TRACE(std::string(testing::name(interpolation)) + ", " + sublimit::name(method));
        const BakedTable<double> table = bake(patterns, mesh, request_of(2, method)).table;
        const Mesh made = applied(table, mesh);
        EXPECT_EQ(difference(made, refined(scheme, mesh, 2), tolerance(mesh)), "");
        // Refined values themselves, and refining goes on as if nothing had been written.
        EXPECT_EQ(difference(refined(scheme, made, 1), refined(scheme, mesh, 3), tolerance(mesh)), "");
        ++count;
      }
    }
  EXPECT_GE(count, 36);
}

std::vector<TestedScheme> schemes_of_channels() {
  std::vector<TestedScheme> tested;
  for (const char* name : {"catmull-clark", "loop", "bilinear", "butterfly", "kobbelt"})
    if (Patterns::is_possible(find_scheme(name).value())) tested.push_back({name, {}});
  return tested;
}

INSTANTIATE_TEST_SUITE_P(Schemes, BakedChannels, ::testing::ValuesIn(schemes_of_channels()), test_name);

Mesh crease_and_channel() {
  Mesh mesh = with_random_channel(jittered(torus(6, 5)), 0.2);
  mesh.creases = {{0, 1, 2.5f}, {1, 2, 10}};
  mesh.corners = {{7, 1.5f}};
  return mesh;
}

TEST(BakedChannel, LeavesOutFacesOfHoles) {
  Patterns patterns(find_scheme("catmull-clark").value());
  for (const BakeMethod method : {BakeMethod::patterns, BakeMethod::rows}) {
    Mesh mesh = crease_and_channel();
    mesh.face_varying_interpolation = FaceVaryingInterpolation::none;
    // Between two holes there is nothing to tag.
    const Topology t(view(mesh));
    const HalfEdge between = t.first(Face{3});
    mesh.creases.push_back({index(t.tail(between)), index(t.head(between)), 10});
    Mesh right = refined(patterns.scheme(), mesh, 1);
    mesh.holes = {3, index(t.face(t.twin(between)))};
    const BakedTable<double> table = bake(patterns, mesh, request_of(1, method)).table;
    EXPECT_EQ(num_corners(table), 28 * 4 * 4);
    EXPECT_EQ(num_corners(table), std::int64_t(faces_of(table).corners.size()));
    ASSERT_EQ(table.channels.list.size(), 1u);
    EXPECT_EQ(std::int64_t(table.channels.list[0].indices.size()), num_corners(table));
    // The same without these faces: children of a quadrilateral are four, in the order of faces.
    std::vector<Index> sizes, vertices, indices;
    for (Index f = 0; f < right.num_faces(); ++f) {
      if (f / 4 == mesh.holes[0] || f / 4 == mesh.holes[1]) continue;
      sizes.push_back(4);
      for (Index k = 4 * f; k < 4 * f + 4; ++k) {
        vertices.push_back(right.face_vertices[size_t(k)]);
        indices.push_back(right.face_varying[0].indices[size_t(k)]);
      }
    }
    right.face_sizes = sizes;
    right.face_vertices = vertices;
    right.face_varying[0].indices = indices;
    check_table(table);
    const Mesh made = applied(table, mesh);
    EXPECT_LT(made.creases.size(), right.creases.size());
    std::erase_if(right.creases, [&](const Mesh::Crease& c) {
      for (size_t i = 0; i < vertices.size(); ++i) {
        const Index a = vertices[i], b = vertices[i - i % 4 + (i + 1) % 4];
        if ((a == c.tail && b == c.head) || (a == c.head && b == c.tail)) return false;
      }
      return true;
    });
    EXPECT_EQ(difference(made, right, tolerance(mesh)), "");
  }
}

TEST(BakedChannel, OfTheLimitIsAtItsLimit) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  Patterns patterns(scheme);
  const Mesh mesh = with_random_channel(jittered(cube()), 0.3);
  for (const int levels : {0, 2})
    for (const BakeMethod method : {BakeMethod::patterns, BakeMethod::rows}) {
      BakeRequest request = request_of(levels, method);
      request.rows = TableRows::limit;
      request.face_varying_interpolation = FaceVaryingInterpolation::boundaries;
      const Mesh made = applied(bake(patterns, mesh, request).table, mesh);
      const std::vector<Level> all = refine(scheme, mesh, levels);
      LimitCache cache(scheme);
      Points points = mesh.positions;
      for (int k = 1; k <= levels; ++k) points = apply(all[k].S, points);
      Mesh out = level_output(all.back(), apply(limit_matrices(all.back(), cache).position, points), mesh, {}, true);
      const auto channel = refine_face_varying(scheme, FaceVaryingInterpolation::boundaries, mesh.face_varying[0], all);
      add_channel(out, channel.back(), "uv",
                  apply(limit_matrices(channel.back().level, cache).position,
                        refined_values(channel, mesh.face_varying[0].values)));
      EXPECT_EQ(difference(made, parse_obj(format_obj(out), "limit"), tolerance(mesh)), "");
    }
}

TEST(BakedChannel, ComesOnlyWhenAsked) {
  Patterns patterns(find_scheme("catmull-clark").value());
  const Mesh mesh = crease_and_channel();
  const BakedTable<double> plain = bake(patterns, mesh, {.level = 1}).table;
  EXPECT_TRUE(plain.channels.list.empty());
  EXPECT_FALSE(plain.tags.has_value());
  const BakedTable<double> tags = bake(patterns, mesh, {.level = 1, .tags = true}).table;
  EXPECT_TRUE(tags.channels.list.empty());
  EXPECT_EQ(tags.tags->crease_sharpness.size(), 4u);
  EXPECT_EQ(tags.tags->corner_sharpness.size(), 1u);
  const BakedTable<double> values = bake(patterns, mesh, {.level = 1, .face_varying = true}).table;
  EXPECT_EQ(values.channels.interpolation, "all");
  EXPECT_FALSE(values.tags.has_value());
  const BakedTable<double> none = bake(patterns, jittered(cube()), request_of(1, BakeMethod::automatic)).table;
  EXPECT_TRUE(none.channels.list.empty());
  EXPECT_TRUE(none.tags->creases.empty());
  EXPECT_EQ(none.tags->boundary, "edge-and-corner");
  EXPECT_EQ(in_float(values).channels.list.size(), 1u);
}

TEST(BakedChannel, IsOfLevelsAlone) {
  Patterns patterns(find_scheme("catmull-clark").value());
  expect_error<InvalidParameter>(
      [&] { bake(patterns, cube(), {.rows = TableRows::grid, .grid = 3, .face_varying = true}); }, {"level", "grid"});
  expect_error<InvalidParameter>(
      [&] { bake(patterns, cube(), {.rows = TableRows::samples, .samples = {{}}, .tags = true}); },
      {"level", "samples"});
  Patterns dual(find_scheme("doo-sabin").value());
  BakeRequest request = request_of(1, BakeMethod::automatic);
  expect_error<InvalidOption>([&] { bake(dual, with_random_channel(cube(), 1), request); }, {"'all'", "doo-sabin"});
  request.face_varying_interpolation = FaceVaryingInterpolation::none;
  expect_error<UnsupportedTopology>([&] { bake(dual, with_random_channel(cube(), 1), request); }, {"seam"});
}

TEST(BakedChannel, IsPlanned) {
  Patterns patterns(find_scheme("catmull-clark").value());
  const Mesh mesh = with_random_channel(torus(20, 20), 0.1);
  const BakeRequest request = request_of(3, BakeMethod::automatic);
  const BakePlan plain = bake_plan(patterns, mesh, {.level = 3}), with = bake_plan(patterns, mesh, request);
  const BakeStatistics made = bake(patterns, mesh, request).statistics;
  EXPECT_EQ(plain.statistics.channel_bytes, 0);
  EXPECT_EQ(with.statistics.bytes, made.bytes);
  EXPECT_GT(double(with.statistics.channel_bytes), 0.7 * double(made.channel_bytes));
  EXPECT_LT(double(with.statistics.channel_bytes), 1.5 * double(made.channel_bytes));
  EXPECT_GT(with.memory, 3 * plain.memory);
  expect_error<ResourceError>([&] { bake_plan(patterns, mesh, request, {}, 2 * plain.memory); }, {"memory", "limit"});
}

}  // namespace
}  // namespace sublimit::testing
