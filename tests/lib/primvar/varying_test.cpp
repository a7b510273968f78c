// SPDX-License-Identifier: Apache-2.0
#include "sublimit/primvar/varying.h"

#include <gtest/gtest.h>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(Varying, IsBilinearUnderCatmullClark) {
  Mesh mesh = jittered(polygon_ring({5, 4, 3, 6, 4}));
  add_crease(mesh, {0, 1}, 2);
  const Scheme<double> scheme = find_scheme("catmull-clark").value(), bilinear = find_scheme("bilinear").value();
  const SparseMatrix P = varying_matrix(scheme, refine(scheme, mesh, 3)),
                     B = refinement_matrix(refine(bilinear, mesh, 3));
  EXPECT_EQ((P - B).norm(), 0);
}

TEST(Varying, LiesOnTheTrianglesUnderSchemesForTriangles) {
  for (const char* name : {"loop", "butterfly"}) {
    Mesh mesh = triangle_grid(3, 2);
    mesh.positions.col(2) = 2 * mesh.positions.col(0) - mesh.positions.col(1);  // a plane is reproduced
    const Scheme<double> scheme = find_scheme(name).value();
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    const Points x = apply(varying_matrix(scheme, levels), mesh.positions);
    EXPECT_LE((x.col(2) - 2 * x.col(0) + x.col(1)).cwiseAbs().maxCoeff(), rounding(10, 6));
    for (Index v = 0; v < mesh.num_vertices(); ++v) EXPECT_EQ(x.row(v), mesh.positions.row(v));
  }
}

TEST(Varying, NeedsASplitThatKeepsEdges) {
  const Scheme<double> scheme = find_scheme("doo-sabin").value();
  const std::vector<Level> levels = refine(scheme, cube(), 1);
  expect_error<InvalidOption>([&] { varying_matrix(scheme, levels); }, {"varying", "doo-sabin", "catmull-clark"});
  expect_error<InvalidParameter>([&] { varying_matrix(scheme, {}); }, {"no levels"});
  expect_error<InvalidParameter>([&] { uniform_parents({}); }, {"no levels"});
}

TEST(Uniform, ChildrenInherit) {
  const Mesh mesh = polygon_ring({5, 4, 3, 6, 4});
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const std::vector<Level> levels = refine(scheme, mesh, 2);
  std::vector<Index> children(mesh.num_faces(), 0);
  for (const Index f : uniform_parents(levels)) ++children[f];
  for (Index f = 0; f < mesh.num_faces(); ++f) EXPECT_EQ(children[f], 4 * mesh.face_sizes[f]);
  const SparseMatrix P = uniform_matrix(levels);
  EXPECT_EQ(P.rows(), levels[2].topology().num_faces());
  EXPECT_EQ((P * Eigen::VectorXd::Ones(P.cols()) - Eigen::VectorXd::Ones(P.rows())).norm(), 0);
}

TEST(Uniform, EverySchemeHasIt) {
  for (const Scheme<double>& scheme : all_schemes()) {
    const Mesh mesh = scheme.face_size() == 3 ? icosahedron() : cube();
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    const std::vector<Index> parents = uniform_parents(levels);
    EXPECT_EQ(std::ssize(parents), levels[2].topology().num_faces());
    for (Index f = 0; f < mesh.num_faces(); ++f)
      EXPECT_TRUE(std::find(parents.begin(), parents.end(), f) != parents.end());
  }
}

}  // namespace
}  // namespace sublimit::testing
