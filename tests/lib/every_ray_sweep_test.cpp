// SPDX-License-Identifier: Apache-2.0
// Rays through marked points of OpenSubdiv's regression shapes, under every scheme.
#include "laws/full_sweep.h"
#include "laws/ray_laws.h"
#include "meshes/shared_meshes.h"
#include "sublimit/io/read_mesh.h"

namespace sublimit::testing {
namespace {

using EveryRay = RayLaws;

TEST_P(EveryRay, HitsTheSharedMeshes) {
  if (shared_meshes().empty())
    GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES << ": no rays at 122 meshes";
  for (const SharedMesh& shared : shared_meshes()) {
    const Mesh mesh = read_mesh(shared.path);
    if (mesh.num_faces() <= (full_sweep() ? 400 : 3)) look_at_mesh(mesh, shared.name);
  }
  EXPECT_GT(rays_, 100);
}

INSTANTIATE_TEST_SUITE_P(Sweep, EveryRay, ::testing::ValuesIn(names_of_schemes()), ray_test_name);

}  // namespace
}  // namespace sublimit::testing
