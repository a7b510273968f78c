// SPDX-License-Identifier: Apache-2.0
// What decides the points of a table is in what it says of itself; what does not is not.
#include "sublimit/stencils/bake/detail/table_info.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {
namespace {

struct Job {
  std::string scheme = "catmull-clark";
  SchemeOptions options = {};
  Mesh mesh = cube();
  BakeRequest request{.level = 2};
  SubdivisionOptions rules = {};
  TableInfo info() const { return table_info(find_scheme(scheme, options).value(), mesh, request, rules); }
  bool is_that_of(const Job& other) const {
    BakedTable<double> table;
    table.info = other.info();
    return is_table_of(table, info(), request);
  }
};

TEST(TableInfo, TellsJobsApart) {
  const Job plain;
  EXPECT_TRUE(plain.is_that_of(plain));
  std::vector<Job> others(9);
  others[0].scheme = "bilinear";
  others[1].options = {{"triangles", "smooth"}};
  others[2].mesh = jittered(prism(5));
  others[3].request.level = 3;
  others[4].request.rows = TableRows::limit;
  others[5].rules.boundary = Boundary::none;
  others[6].rules.creasing = Creasing::chaikin;
  others[7].mesh.creases = {{0, 1, 2}};
  others[8].mesh.holes = {3};
  for (size_t i = 0; i < others.size(); ++i) {
    EXPECT_FALSE(plain.is_that_of(others[i])) << i;
    EXPECT_TRUE(others[i].is_that_of(others[i])) << i;
  }
  // Of tables that carry them, texture coordinates and how they are refined; of others they do not matter.
  std::vector<Job> carrying(5);
  for (Job& job : carrying) {
    job.request.face_varying = true;
    job.mesh.face_varying = {{.name = "uv", .values = Points::Zero(1, 2), .indices = std::vector<Index>(24, 0)}};
  }
  carrying[1].mesh.face_varying[0].values(0, 1) = 1;
  carrying[2].request.face_varying_interpolation = FaceVaryingInterpolation::none;
  carrying[3].mesh.face_varying[0].indices[5] = 1;
  carrying[4].request.tags = true;
  for (size_t i = 0; i < carrying.size(); ++i) {
    EXPECT_FALSE(plain.is_that_of(carrying[i])) << i;
    for (size_t j = 0; j < i; ++j) EXPECT_FALSE(carrying[i].is_that_of(carrying[j])) << i << " " << j;
  }
  carrying[1].request.face_varying = false;
  EXPECT_TRUE(plain.is_that_of(carrying[1]));
  carrying[0].request.face_varying_interpolation = FaceVaryingInterpolation::all;
  Job by_tag = carrying[0];
  by_tag.request.face_varying_interpolation.reset();
  EXPECT_TRUE(by_tag.is_that_of(carrying[0]));
  Job sharper = others[7];
  sharper.mesh.creases[0].sharpness = 2.5f;
  EXPECT_FALSE(sharper.is_that_of(others[7]));
}

TEST(TableInfo, TellsFacesBetweenPlacesApart) {
  Patterns patterns(find_scheme("catmull-clark").value());
  BakeRequest request{.rows = TableRows::samples, .samples = {{0, 0, 0}, {0, 1, 0}, {0, 0.5, 0.5}}};
  request.face_sizes = {3}, request.face_vertices = {0, 1, 2};
  const BakedTable<double> table = bake(patterns, cube(), request).table;
  const auto is_same = [&] { return is_table_of(table, table_info(patterns.scheme(), cube(), request), request); };
  EXPECT_TRUE(is_same());
  request.face_vertices = {1, 2, 0};
  EXPECT_FALSE(is_same());
  request.face_sizes.clear(), request.face_vertices.clear();
  EXPECT_FALSE(is_same());
}

TEST(TableInfo, LeavesOutWhatDoesNotMatter) {
  const Job plain;
  Job moved, explicit_rules, same_number;
  moved.mesh = jittered(cube());
  EXPECT_TRUE(moved.is_that_of(plain));
  explicit_rules.rules = {.boundary = Boundary::edge_and_corner, .creasing = Creasing::uniform};
  explicit_rules.options = {{"triangles", "catmark"}};
  EXPECT_TRUE(explicit_rules.is_that_of(plain));
  same_number.scheme = "kobbelt";
  same_number.options = {{"tension", "0.5"}};
  Job ratio = same_number;
  ratio.options = {{"tension", "1/2"}};
  EXPECT_TRUE(same_number.is_that_of(ratio));
  EXPECT_EQ(ratio.info().options.at("tension"), "1/2");
}

TEST(TableInfo, TagsOfTheMeshAreRules) {
  Job tagged;
  tagged.mesh.boundary = Boundary::edge_only;
  tagged.mesh.creasing = Creasing::chaikin;
  EXPECT_EQ(tagged.info().options.at("boundary"), "edge-only");
  EXPECT_EQ(tagged.info().options.at("creasing"), "chaikin");
  tagged.rules.boundary = Boundary::none;
  EXPECT_EQ(tagged.info().options.at("boundary"), "none");
}

TEST(TableInfo, PlacesAndDerivativesMatter) {
  const BakeRequest request{.rows = TableRows::samples, .samples = {{0, 0.25, 0.5}, {3, 1, 0}}};
  Patterns patterns(find_scheme("catmull-clark").value());
  BakedTable<double> table = bake(patterns, cube(), request).table;
  EXPECT_TRUE(is_table_of(table, table.info, request));
  for (const int change : {0, 1, 2}) {
    BakeRequest other = request;
    if (change == 0) other.samples[1].v = 0.5;
    if (change == 1) other.samples.pop_back();
    if (change == 2) other.derivatives = 1;
    EXPECT_FALSE(is_table_of(table, table.info, other)) << change;
  }
}

}  // namespace
}  // namespace sublimit::testing
