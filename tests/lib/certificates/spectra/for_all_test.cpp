// SPDX-License-Identifier: Apache-2.0
// Statements about all elements of a set: of none nothing is proved.
#include "sublimit/certificates/spectra/for_all.h"

#include <gtest/gtest.h>

#include <vector>

#include "sublimit/certificates/spectra/verdict.h"

namespace sublimit {
namespace {

TEST(ForAll, NothingLookedAtDecidesNothing) {
  const ForAll none;
  EXPECT_EQ(none.holds(), std::nullopt);
  EXPECT_EQ(none.looked_at(), 0);
  EXPECT_EQ(holds_for_all(std::vector<int>{}, [](int) { return true; }), std::nullopt);
  EXPECT_EQ(holds_for_all(std::vector<int>{}, [](int) { return false; }), std::nullopt);
}

TEST(ForAll, OneThatFailsIsEnoughAndIsNamed) {
  ForAll some;
  some.look(true, "a");
  EXPECT_EQ(some.holds(), true);
  some.look(std::nullopt, "b");
  EXPECT_EQ(some.holds(), std::nullopt);
  EXPECT_EQ(some.where(), "b");
  some.look(false, "c");
  EXPECT_EQ(some.holds(), false);
  some.look(false, "d"), some.look(std::nullopt, "e"), some.look(true, "f");
  EXPECT_EQ(some.holds(), false);
  EXPECT_EQ(some.where(), "c");
  EXPECT_EQ(some.looked_at(), 6);
}

TEST(Verdict, WithoutHypothesesIsUnknown) {
  EXPECT_EQ(answer_of({}, true), Verdict::Answer::unknown);
  EXPECT_EQ(answer_of({}, false), Verdict::Answer::unknown);
}

}  // namespace
}  // namespace sublimit
