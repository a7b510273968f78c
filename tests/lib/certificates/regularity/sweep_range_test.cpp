// SPDX-License-Identifier: Apache-2.0
// Masks and ranges as people type them, and smoothness over a parameter.
#include <gtest/gtest.h>

#include "sublimit/base/error.h"
#include "sublimit/certificates/regularity/curve_regularity.h"
#include "sublimit/certificates/regularity/sweep.h"
#include "sublimit/certificates/regularity/typed_mask.h"

namespace sublimit {
namespace {

std::string complaint(const std::string& mask) {
  try {
    (void)typed_mask(mask);
  } catch (const InvalidOption& error) {
    return error.what();
  }
  return "";
}

TEST(TypedMask, NumbersComeInAllForms) {
  const Symbol cubic = typed_mask("1 4 6 4 1 /8");
  EXPECT_EQ(cubic.first, -2);
  EXPECT_EQ(cubic.at(0), Rational(3) / 4);
  EXPECT_TRUE(cubic.shift.is_zero());
  EXPECT_EQ(typed_mask("0.125, 0.5 , 3/4,0.5,+.125").coefficients, cubic.coefficients);
  EXPECT_EQ(typed_mask("1 4 6 4 1 / 8").coefficients, cubic.coefficients);
  const CurveRegularity chaikin = curve_regularity(typed_mask("1 3 3 1 /4"));
  EXPECT_EQ(chaikin.smoothness.continuity, 1);
  EXPECT_EQ(chaikin.support[1], Rational(3) / 2);
  EXPECT_EQ(curve_regularity(typed_mask("-1 0 9 16 9 0 -1 /16")).degrees.reproduces, 3);
}

TEST(TypedMask, MalformedOnesSayWhereAndWhat) {
  EXPECT_NE(complaint("1 4 x 4 1").find("weight 3, 'x'"), std::string::npos);
  EXPECT_NE(complaint("1 4 1/0 4 1").find("weight 3"), std::string::npos);
  EXPECT_NE(complaint("1 2 1 /0").find("'/0'"), std::string::npos);
  EXPECT_NE(complaint("1 2 1 /").find("'/'"), std::string::npos);
  EXPECT_NE(complaint("").find("none"), std::string::npos);
  EXPECT_NE(complaint("1").find("at least 2"), std::string::npos);
  EXPECT_NE(complaint("0 0 0").find("zero"), std::string::npos);
  EXPECT_NE(complaint("1e3 2").find("weight 1"), std::string::npos);
  EXPECT_NE(complaint("nan 1").find("weight 1"), std::string::npos);
  std::string many;
  for (int i = 0; i < 60; ++i) many += "1 ";
  EXPECT_NE(complaint(many).find("60"), std::string::npos);
}

TEST(SweepRange, StepsAreExact) {
  const SweepRange range = sweep_range("tension=0:4:0.05");
  ASSERT_EQ(range.values.size(), 81u);
  EXPECT_EQ(range.values[80], Rational(4));
  for (const char* bad : {"tension", "=0:1:1", "tension=0:1", "tension=0:1:0", "tension=0:1:-1", "tension=1:0:1",
                          "tension=0:x:1", "t=0:1:0.0001"})
    EXPECT_THROW(sweep_range(bad), InvalidOption) << bad;
}

TEST(Sweep, FourPointRunsBeyondItsOption) {
  const Sweep s = sweep("four-point", sweep_range("tension=-1:4:0.25"));
  for (const SweepPoint& p : s.points) {
    EXPECT_TRUE(p.in_range);
    const double g = p.value.value();
    EXPECT_EQ(p.smoothness.continuity, g > 0 && g < 3.0837 ? 1 : 0) << g;
  }
  EXPECT_EQ(s.findings.size(), 3u);
  const Sweep degrees = sweep("lane-riesenfeld", sweep_range("degree=0:4:1"));
  EXPECT_FALSE(degrees.points[0].in_range);
  EXPECT_EQ(degrees.points[4].smoothness.continuity, 3);
  EXPECT_THROW(sweep("four-point", sweep_range("width=0:1:1")), InvalidOption);
  EXPECT_THROW(sweep("four-point", sweep_range("ends=0:1:1")), InvalidOption);
  EXPECT_THROW(sweep("loop-de-loop", sweep_range("tension=0:1:1")), InvalidOption);
}

TEST(Sweep, SurfacesOnRegularMeshes) {
  const Sweep kobbelt = sweep("kobbelt", sweep_range("tension=0:4:1"));
  const int continuity[] = {0, 1, 1, 1, 0};
  for (size_t i = 0; i < kobbelt.points.size(); ++i) EXPECT_EQ(kobbelt.points[i].smoothness.continuity, continuity[i]);
  const Sweep butterfly = sweep("butterfly", sweep_range("tension=0:2:1"));
  EXPECT_EQ(butterfly.points[0].smoothness.continuity, 0);
  EXPECT_EQ(butterfly.points[1].smoothness.continuity, 1);
  EXPECT_EQ(butterfly.points[2].smoothness.continuity, 0);
}

}  // namespace
}  // namespace sublimit
