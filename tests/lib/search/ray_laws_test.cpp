// SPDX-License-Identifier: Apache-2.0
// Rays through marked points of meshes of the tests' own, under every scheme.
#include "laws/ray_laws.h"

#include "laws/full_sweep.h"
#include "meshes/meshes.h"

namespace sublimit::testing {
namespace {

TEST_P(RayLaws, HoldOnClosedMeshes) {
  Mesh creased = jittered(cube());
  add_crease(creased, {0, 1, 3}, {10, 1.5f});
  look_at_mesh(jittered(cube()), "cube");
  look_at_mesh(creased, "creased cube");
  look_at_mesh(jittered(pole(5)), "pole");
  if (full_sweep()) {
    look_at_mesh(torus(7, 5), "torus");
    look_at_mesh(jittered(icosahedron()), "icosahedron");
    look_at_mesh(jittered(prism(6)), "prism");
    look_at_mesh(pole(12), "pole of 12");
    look_at_mesh(cube(), "even cube");
  }
  EXPECT_EQ(without_limit_, 0);
  EXPECT_EQ(given_up_, 0);
  EXPECT_GT(rays_, 100);
}

TEST_P(RayLaws, HoldOnTaggedMeshes) {
  for (const NamedMesh& named : tagged_meshes())
    if (full_sweep() || named.mesh.num_faces() <= 4) look_at_mesh(named.mesh, named.name);
  EXPECT_GT(rays_, 100);
}

INSTANTIATE_TEST_SUITE_P(Schemes, RayLaws, ::testing::ValuesIn(names_of_schemes()), ray_test_name);

}  // namespace
}  // namespace sublimit::testing
