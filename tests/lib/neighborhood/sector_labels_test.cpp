// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/sector_labels.h"

#include <gtest/gtest.h>

#include <set>

#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {
namespace {

LocalType around(const Scheme<double>& scheme, Index n) {
  return {.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = n};
}

TEST(SectorLabels, RotateWithTheSectors) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const Index n : {3, 4, 6, 7}) {
      const auto patch = local_patch(scheme, around(scheme, n), 2);
      ASSERT_TRUE(patch) << scheme.name;
      std::set<SectorLabel> seen(patch->labels.begin(), patch->labels.end());
      EXPECT_EQ(seen.size(), patch->slots.size()) << scheme.name << ": each place once";
      for (const std::vector<Index>& orbit : patch->orbits) {
        if (orbit.size() == 1) {
          EXPECT_EQ(patch->labels[orbit[0]], SectorLabel{}) << scheme.name;
        }
        for (size_t s = 1; s < orbit.size(); ++s) {
          SectorLabel turned = patch->labels[orbit[s - 1]];
          turned.sector = (turned.sector + 1) % n;
          EXPECT_EQ(patch->labels[orbit[s]], turned) << scheme.name << " n=" << n;
        }
      }
    }
}

TEST(SectorLabels, OfAWholeRingAreThoseOfTheLattice) {
  // R rings of quadrilaterals: 2 n R (R + 1) points and the vertex; around a face n (R + 1)^2.
  const auto count = [](const char* name, Index n, int rings) {
    const Scheme<double> scheme = find_scheme(name).value();
    return local_patch(scheme, around(scheme, n), rings)->slots.size();
  };
  for (const Index n : {3, 5, 8}) {
    EXPECT_EQ(count("catmull-clark", n, 3), 12 * static_cast<size_t>(n) + 1);
    EXPECT_EQ(count("doo-sabin", n, 2), 9 * static_cast<size_t>(n));
  }
}

TEST(SectorLabels, OfAnOpenFanEndOnItsLastSpoke) {
  const auto patch = local_patch(find_scheme("catmull-clark").value(), {.faces = 3, .open = true}, 2);
  ASSERT_TRUE(patch);
  const std::set<SectorLabel> labels(patch->labels.begin(), patch->labels.end());
  EXPECT_TRUE(labels.count({0, 4, 0}));
  EXPECT_TRUE(labels.count({3, 4, 0}));
  EXPECT_FALSE(labels.count({3, 4, 2}));
}

}  // namespace
}  // namespace sublimit
