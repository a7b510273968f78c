// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_masks.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

#include <gtest/gtest.h>

#include "sublimit/limit/detail/limit_masks.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

const Algebraic quarter = Algebraic::ratio(1, 4);

TEST(ExactMasks, CatmullClarkMatchesHalstead1993) {
  const Scheme<Algebraic> scheme = *find_scheme<Algebraic>("catmull-clark");
  for (const int n : {3, 5, 7}) {
    const auto patch = local_patch(scheme, {.faces = n});
    const ExactMasks masks = exact_masks(*patch);
    for (size_t i = 0; i < patch->labels.size(); ++i) {
      const SectorLabel& l = patch->labels[i];
      const int weight = l == SectorLabel{} ? n * n : l.y2 == 0 ? 4 : 1;  // centre, ends of edges, opposite corners
      EXPECT_EQ(masks.position[i], Algebraic::ratio(weight, n * (n + 5)));
    }
  }
}

TEST(ExactMasks, LoopsTangentsAreCosinesAndSines) {
  const int n = 5;
  const Algebraic c = Number<Algebraic>::cos_2pi(1, n);
  const auto patch = local_patch(*find_scheme<Algebraic>("loop"), {.faces = n});
  const ExactMasks masks = exact_masks(*patch, Algebraic::ratio(3, 8) + quarter * c);
  ASSERT_TRUE(masks.tangent1 && masks.tangent2);
  for (size_t i = 1; i < patch->labels.size(); ++i) {
    const int s = patch->labels[i].sector;
    EXPECT_EQ((*masks.tangent1)[i], Algebraic::ratio(2, n) * Number<Algebraic>::cos_2pi(s, n));
    EXPECT_EQ((*masks.tangent2)[i], Algebraic::ratio(2, n) * Number<Algebraic>::cos_2pi(4 * s - n, 4 * n));
  }
  EXPECT_FALSE(exact_masks(*patch, quarter).tangent1) << "1/4 is no eigenvalue of block 1";
}

TEST(ExactMasks, AreThoseThatSurfacesAreEvaluatedWith) {
  const std::vector<Scheme<double>> doubles = all_schemes();
  const std::vector<Scheme<Algebraic>> exacts = all_schemes<Algebraic>();
  for (size_t k = 0; k < doubles.size(); ++k)
    for (const LocalType type : {LocalType{.faces = 5}, LocalType{.faces = 2, .open = true}}) {
      if (type.open && doubles[k].is_dual()) continue;
      LocalType own = type;
      if (doubles[k].is_dual()) own.kind = Centre::Kind::face;
      const auto limit = isolated_limit(doubles[k], own);
      const auto patch = local_patch(exacts[k], own);
      ASSERT_TRUE(limit && patch) << doubles[k].name;
      ASSERT_EQ(limit->slots, patch->slots) << doubles[k].name;
      const ExactMasks masks = exact_masks(*patch);
      Algebraic sum;
      for (size_t i = 0; i < masks.position.size(); ++i) {
        sum += masks.position[i];
        EXPECT_NEAR(static_cast<double>(masks.position[i]), limit->masks.position[static_cast<Eigen::Index>(i)],
                    testing::eigen(10))
            << doubles[k].name;
      }
      EXPECT_TRUE(sum.is_one()) << doubles[k].name;
    }
}

}  // namespace
}  // namespace sublimit
