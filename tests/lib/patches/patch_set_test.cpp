// SPDX-License-Identifier: Apache-2.0
// Surfaces of a file as one source: a sphere and a torus that are what they are called, face after face.
#include "sublimit/patches/patch_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "meshes/free_form_shapes.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(PatchSet, SphereAndTorusOfAFile) {
  const FreeFormPatches found = free_form_patches(
      parse_free_form(format_free_form(free_form_of({unit_sphere(), torus()})), "round.obj"), "round.obj");
  const PatchSet& set = found.patches;
  ASSERT_EQ(found.columns.cols(), 4);
  ASSERT_EQ(set.faces().size, 4 * 2 + 4 * 4);
  ASSERT_EQ(set.num_points(), 9 * 5 + 9 * 9);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> parameter(0, 1);
  std::vector<Place> samples;
  for (Index f = 0; f < set.faces().size; ++f)
    for (int i = 0; i < 20; ++i) samples.push_back({f, parameter(random), parameter(random)});
  const LimitSamples at = set.evaluate(found.columns, samples, 2);
  for (size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d x = at.position.row(Index(i)), n = at.normal.row(Index(i));
    const bool on_sphere = samples[i].face < 8;
    const Eigen::Vector3d centre =
        on_sphere ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(3 * Eigen::Vector3d(x[0], x[1], 0).normalized());
    EXPECT_NEAR((x - centre).norm(), 1, rounding(8)) << i;
    EXPECT_LE(std::min((n - (x - centre)).norm(), (n + (x - centre)).norm()), rounding(100)) << i;
    EXPECT_EQ(at.status[i], LimitStatus::regular);
    // The stencil, over the columns of all patches.
    const LimitStencil stencil = set.stencil(samples[i], 0);
    Eigen::RowVector4d column = Eigen::RowVector4d::Zero();
    for (size_t j = 0; j < stencil.vertices.size(); ++j)
      column += stencil.weights(0, Index(j)) * found.columns.row(stencil.vertices[j]);
    EXPECT_LE((Eigen::Vector3d(column.head(3) / column[3]) - x).norm(), rounding(16));
  }
}

TEST(PatchSet, RefusesWhatIsNoFace) {
  const FreeFormPatches found = free_form_patches(free_form_of({unit_sphere()}), "s.obj");
  expect_error<InvalidParameter>([&] { found.patches.stencil({8, 0, 0}); }, {"face 8 does not exist", "there are 8"});
  EXPECT_EQ(found.patches.evaluate(found.columns, std::vector<Place>{{8, 0, 0}}).status[0], LimitStatus::outside);
}

}  // namespace
}  // namespace sublimit::testing
