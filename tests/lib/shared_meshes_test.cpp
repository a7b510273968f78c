// SPDX-License-Identifier: Apache-2.0
// OpenSubdiv's own regression shapes, every tag honoured: our refined meshes are its refined meshes.
#include <gtest/gtest.h>

#include "meshes/shared_meshes.h"
#include "peers/compare_with_opensubdiv.h"
#include "sublimit/io/read_mesh.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(SharedMeshes, AreAll122Present) {
  if (shared_meshes().empty())
    GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES << ": 122 comparisons with OpenSubdiv are not run";
  EXPECT_EQ(shared_meshes().size(), 122u);
}

class SharedMeshRefinement : public ::testing::TestWithParam<SharedMesh> {};

TEST_P(SharedMeshRefinement, EqualsOpenSubdiv) {
  const Mesh mesh = read_mesh(GetParam().path);
  const int levels = full_sweep() || mesh.num_faces() < 400 ? 3 : 1;
  const Comparison c = compare_with_opensubdiv(mesh, GetParam().scheme, levels);
  EXPECT_EQ(c.mismatch, "");
  EXPECT_LE(c.error, reference);
  RecordProperty("error_over_bounding_box", std::to_string(c.error));
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SharedMeshRefinement);
INSTANTIATE_TEST_SUITE_P(Full, SharedMeshRefinement, ::testing::ValuesIn(shared_meshes()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sublimit::testing
