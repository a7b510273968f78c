// SPDX-License-Identifier: Apache-2.0
// Limits near corners by local refinement against OpenSubdiv's Far, live, wherever its patches are regular: what the
// table of accuracies holds to be true.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "meshes/irregular_meshes.h"
#include "meshes/shared_meshes.h"
#include "peers/compare_with_opensubdiv.h"
#include "peers/dyadic_limits.h"
#include "peers/opensubdiv_limit_reference.h"
#include "sublimit/io/read_mesh.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Radians: where rounding alone may turn a normal further, there is nothing to compare.
constexpr double most_noise = 1e-3;

void expect_equal(const Mesh& mesh, int last = 8) {
  DyadicLimits truth(scheme_for(mesh, "catmull-clark"), mesh);
  const FarLimit far(mesh, reference_options(mesh, "catmull-clark", 0), {.inf_sharp_patches = true});
  const double size = diagonal(mesh.positions);
  double position = 0, normal = 0;
  int compared = 0, extraordinary = 0;
  for (const SquareCorner& corner : truth.corners()) {
    if (corner.kind == SquareCorner::Kind::regular) continue;
    ++extraordinary;
    for (const DyadicLimit& limit : truth.towards(corner, last)) {
      const ReferencePoint theirs = far.at(limit.place).value();
      if (!theirs.regular) continue;
      ++compared;
      position = std::max(position, (limit.position - theirs.position).norm() / size);
      const Eigen::Vector3d n = theirs.du.cross(theirs.dv);
      // Of tangents of size t, each wrong by eps 2^k times the box, an angle is.
      const double noise = rounding(16 + 4 * theirs.depth, size) * std::ldexp(1, theirs.depth) *
                           (theirs.du.norm() + theirs.dv.norm()) / n.norm();
      if (!limit.has_normal || !(noise < most_noise)) continue;
      normal = std::max(normal, std::atan2(n.cross(limit.normal).norm(), n.dot(limit.normal)) / noise);
    }
  }
  EXPECT_LE(position, reference);
  EXPECT_LE(normal, 1);
  EXPECT_TRUE(compared > 0 || extraordinary == 0);
}

class DyadicLimitsOf : public ::testing::TestWithParam<NamedMesh> {};
TEST_P(DyadicLimitsOf, EqualFar) { expect_equal(GetParam().mesh); }
INSTANTIATE_TEST_SUITE_P(OpenSubdiv, DyadicLimitsOf, ::testing::ValuesIn(closed_polygon_meshes()),
                         [](const auto& tested) { return tested.param.name; });

TEST(DyadicLimits, EqualFarOnCreasedMeshes) {
  for (const SharedMesh& shared : shared_meshes()) {
    if (shared.name != "catmark_car" && shared.name != "catmark_helmet" && shared.name != "catmark_bishop") continue;
    SCOPED_TRACE(shared.name);
    expect_equal(read_mesh(shared.path), 4);
  }
  Mesh cube_ = jittered(cube());
  add_crease(cube_, {0, 1, 3}, std::vector<float>{10, 2.5f});
  expect_equal(cube_);
}

}  // namespace
}  // namespace sublimit::testing
