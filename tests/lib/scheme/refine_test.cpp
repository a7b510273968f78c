// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/refine.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/subdivide.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const Scheme<double> catmull_clark_scheme = find_scheme("catmull-clark").value();

// Corner (1,1,1) of the cube: n = 3, (n-2)/n v = 1/3, neighbours' mean (1,1,-1)+.. = 1/3 each, face centroids' mean 1/3
// each: (1 + 1/3 + 1/3) / 3 = 5/9. An edge point: (0, 1, 1) with face points (0,1,0) and (0,0,1): 3/4. A face point: 1.
TEST(Refine, CubeCornerIsAtFiveNinths) {
  const std::vector<Level> levels = refine(catmull_clark_scheme, cube(), 1);
  const Points x = apply(levels[1].S, cube().positions);
  for (Index v = 0; v < 8; ++v)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::abs(x(v, c)), 5.0 / 9, rounding(7));
  for (Index f = 0; f < 6; ++f) EXPECT_NEAR(x.row(8 + f).cwiseAbs().maxCoeff(), 1, rounding(4));
  for (Index e = 0; e < 12; ++e) EXPECT_NEAR(x.row(14 + e).cwiseAbs().maxCoeff(), 0.75, rounding(6));
}

TEST(Refine, LevelZeroIsTheControlMesh) {
  const std::vector<Level> levels = refine(catmull_clark_scheme, cube(), 0);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].topology().num_faces(), 6);
  EXPECT_EQ(apply(refinement_matrix(levels), cube().positions), cube().positions);
}

TEST(Refine, MatrixOfAllLevelsIsTheProductOfEach) {
  for (const NamedMesh& named : tagged_meshes()) {
    if (named.mesh.num_faces() > 30) continue;
    const std::vector<Level> levels = refine(catmull_clark_scheme, named.mesh, 3);
    Points x = named.mesh.positions;
    for (int k = 1; k <= 3; ++k) x = apply(levels[k].S, x);
    const Points y = apply(refinement_matrix(levels), named.mesh.positions);
    EXPECT_LE((x - y).cwiseAbs().maxCoeff(), rounding(12 * 4, diagonal(named.mesh.positions))) << named.name;
  }
}

TEST(Refine, ProductIsEigensProduct) {
  const std::vector<Level> levels = refine(catmull_clark_scheme, jittered(torus(9, 7)), 2);
  const SparseMatrix ours = product(levels[2].S, levels[1].S), theirs = levels[2].S * levels[1].S;
  EXPECT_LE((ours - theirs).norm(), rounding(64));
  for (Index r = 0; r < ours.rows(); ++r)
    for (Index k = ours.outerIndexPtr()[r] + 1; k < ours.outerIndexPtr()[r + 1]; ++k)
      EXPECT_LT(ours.innerIndexPtr()[k - 1], ours.innerIndexPtr()[k]);
}

// A subset has the rows that the whole mesh has: compare by the position of every vertex, for every rule.
TEST(RefineSubset, HasTheRowsOfTheWhole) {
  for (const NamedMesh& named : tagged_meshes()) {
    if (named.mesh.num_faces() > 60) continue;
    const std::vector<Level> levels = refine(catmull_clark_scheme, named.mesh, 2);
    std::vector<Points> whole{named.mesh.positions};
    for (int k = 1; k <= 2; ++k) whole.push_back(apply(levels[k].S, whole.back()));
    const std::vector<Index> chosen{0, named.mesh.num_faces() / 2};
    Subset part = subset(levels[0], chosen);
    Points x = apply(part.level.S, whole[0]);
    std::vector<Index> face_in_whole = part.parents;  // of the chosen faces' children, by provenance
    std::vector<Index> chosen_in_whole;
    for (const Index f : part.faces) chosen_in_whole.push_back(part.parents[f]);
    for (int k = 1; k <= 2; ++k) {
      part = refine(catmull_clark_scheme, part);
      x = apply(part.level.S, x);
      std::vector<Index> children;
      for (Index f = 0; f < levels[k].topology().num_faces(); ++f)
        if (std::find(chosen_in_whole.begin(), chosen_in_whole.end(), levels[k].steps[0].face_parent[f]) !=
            chosen_in_whole.end())
          children.push_back(f);
      chosen_in_whole = children;
      ASSERT_EQ(part.faces.size(), children.size()) << named.name;
      for (size_t i = 0; i < children.size(); ++i) {
        const auto own = part.level.topology().vertices(Face{part.faces[i]});
        const auto theirs = levels[k].topology().vertices(Face{children[i]});
        for (size_t c = 0; c < own.size(); ++c)
          EXPECT_LE((x.row(own[c]) - whole[k].row(theirs[c])).norm(), rounding(64, diagonal(whole[0]))) << named.name;
      }
    }
  }
}

TEST(Refine, TellsWhatCannotBe) {
  EXPECT_THROW(refine(catmull_clark_scheme, cube(), -1), InvalidParameter);
  try {
    refine(catmull_clark_scheme, cube(), 40);
    FAIL() << "40 levels were taken";
  } catch (const ResourceError& error) {
    EXPECT_NE(std::string(error.what()).find("memory"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("32-bit"), std::string::npos) << error.what();
  }
  EXPECT_THROW(refine(find_scheme("loop").value(), cube(), 1), UnsupportedTopology);
  EXPECT_THROW(apply(SparseMatrix(3, 4), Points::Zero(5, 3)), InvalidParameter);
  EXPECT_THROW(product(SparseMatrix(3, 4), SparseMatrix(3, 4)), InvalidParameter);
  const std::vector<Level> levels = refine(catmull_clark_scheme, cube(), 0);
  EXPECT_THROW(subset(levels[0], std::vector<Index>{6}), InvalidParameter);
}

// Masks that look beyond their face count on its size. A preparation that was taken away, or that a level says to have
// behind it, has not made these faces quadrilaterals.
TEST(Refine, RefusesFacesThatAPreparationShouldHaveCut) {
  const Scheme<double> whole = find_scheme("kobbelt").value();
  Scheme<double> cleared = whole;
  cleared.preparation.clear();
  for (const Mesh& mesh : {polygon_ring({4, 3, 5}), prism(5), octahedron()}) {
    Index other = 0;  // the first face that is no quadrilateral
    while (mesh.face_sizes[other] == 4) ++other;
    const std::string face = "face " + std::to_string(other) + " of level ";
    const Level control = control_level(whole, mesh);
    expect_error<UnsupportedTopology>([&] { next_level(cleared, control); }, {face + "0", "kobbelt", "faces of 4"});
    Level later = control;
    later.number = 1;
    expect_error<UnsupportedTopology>([&] { next_level(whole, later); }, {face + "1", "preparation"});
    const Level prepared = next_level(whole, control);
    EXPECT_EQ(prepared.topology().uniform_face_size(), 4);
    EXPECT_NO_THROW(next_level(cleared, prepared));
  }
  // A scheme of one's own that says nothing of sizes: all faces like the first one, here the triangle in the middle.
  Scheme<double> own = cleared;
  own.corners = 0;
  expect_error<UnsupportedTopology>(
      [&] {
        next_level(own, control_level(own, polygon_ring({4, 4, 5})));
      },
      {"face 1 of level 0", "faces of 3"});
}

TEST(Refine, HasTheSameBitsForAnyNumberOfThreads) {
  const Mesh mesh = quads_from_triangles(jittered(triangle_torus(40, 30)));
  const auto run = [&](int threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, size_t(threads));
    const SparseMatrix P = refinement_matrix(refine(catmull_clark_scheme, mesh, 2));
    std::vector<double> bits(P.valuePtr(), P.valuePtr() + P.nonZeros());
    bits.insert(bits.end(), P.innerIndexPtr(), P.innerIndexPtr() + P.nonZeros());
    return bits;
  };
  EXPECT_EQ(run(1), run(4));
}

TEST(Subdivide, TakesAndGivesEigenMatrices) {
  const Mesh mesh = icosahedron();
  FaceMatrix F(20, 3);
  for (Index i = 0; i < 60; ++i) F(i / 3, i % 3) = mesh.face_vertices[i];
  const auto [S, F1] = subdivide("loop", 12, F, 2);
  const std::vector<Level> levels = refine(find_scheme("loop").value(), mesh, 2);
  EXPECT_EQ(F1.rows(), 320);
  EXPECT_EQ((S - refinement_matrix(levels)).norm(), 0);
  EXPECT_THROW(subdivide("lop", 12, F), InvalidOption);
}

TEST(Schemes, AreFoundByNameAndOffered) {
  EXPECT_FALSE(find_scheme("catmul-clark").has_value());
  EXPECT_EQ(nearest_scheme_names("catmul-clark", 1), std::vector<std::string>{"catmull-clark"});
  EXPECT_EQ(nearest_scheme_names("catmull", 1), std::vector<std::string>{"catmull-clark"});
  EXPECT_THROW(find_scheme("loop", {{"triangles", "smooth"}}), InvalidOption);
  EXPECT_THROW(find_scheme("catmull-clark", {{"triangles", "round"}}), InvalidOption);
  EXPECT_TRUE(find_scheme("catmull-clark", {{"triangles", "smooth"}}).has_value());
}

// Warped smoothly or not, degenerate control points are told apart: a cone's axis has no normal; a fold has one by its
// next modes only if these span a plane.
TEST(LimitPoints, DegenerateTangentsHaveAStatus) {
  Mesh mesh = fan(6, 4);
  LimitCache cache(catmull_clark_scheme);
  const Level level = control_level(catmull_clark_scheme, mesh);
  const LimitMatrices limit = limit_matrices(level, cache);
  const auto side =
      size_t(std::find(limit.side_vertex.begin(), limit.side_vertex.end(), 0) - limit.side_vertex.begin());
  EXPECT_NE(limit_points(limit, level.topology(), mesh.positions).status[side], LimitStatus::undefined_normal);
  mesh.positions.setZero();  // all points in one
  EXPECT_EQ(limit_points(limit, level.topology(), mesh.positions).status[side], LimitStatus::undefined_normal);
  EXPECT_TRUE(limit_points(limit, level.topology(), mesh.positions).normal.row(Index(side)).isZero());
}

}  // namespace
}  // namespace sublimit::testing
