// SPDX-License-Identifier: Apache-2.0
// Refined meshes against OpenSubdiv, live: every rule of its Sdc on meshes made here, and on its own regression shapes
// where a checkout has them beside it.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "peers/compare_with_opensubdiv.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Under Chaikin creasing an edge of sharpness s > 1 can be smooth one level on. Sdc clamps the weight of its crease
/// mask to 1 (a full crease, as here); Far hands Sdc the rules it has found and thereby skips the clamp: its edge point
/// is s * midpoint + (1 - s) * smooth, with negative weights, outside the convex hull. Here we differ, on purpose.
bool far_extrapolates(const std::string& name) { return name.starts_with("chain_uneven_chaikin"); }

class TaggedMesh : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(TaggedMesh, RefinesAsOpenSubdiv) {
  for (const std::string& scheme : GetParam().schemes) {
    SCOPED_TRACE(scheme);
    const Comparison c = compare_with_opensubdiv(GetParam().mesh, scheme, 3);
    EXPECT_EQ(c.mismatch, "");
    if (scheme != "bilinear" && far_extrapolates(GetParam().name)) {
      EXPECT_GT(c.error, 1e4 * reference);
    } else {
      EXPECT_LE(c.error, reference);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OpenSubdiv, TaggedMesh, ::testing::ValuesIn(tagged_meshes()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sublimit::testing
