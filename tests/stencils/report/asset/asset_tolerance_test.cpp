// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "sublimit/report/asset/asset_report.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

SeamTolerance read(std::initializer_list<const char*> texts) {
  SeamTolerance tolerance;
  for (const char* text : texts) read_tolerance(text, tolerance);
  return tolerance;
}

TEST(AssetTolerance, IsReadWithUnits) {
  const SeamTolerance t = read({"g0=1e-9", "g1=0.1deg", "g2=5%"});
  EXPECT_EQ(t.g0, 1e-9);
  EXPECT_FALSE(t.g0_of_box);
  EXPECT_EQ(t.g1_degrees, 0.1);
  EXPECT_EQ(t.g2, 0.05);
  EXPECT_EQ(read({"g0=2%"}).g0, 0.02);
  EXPECT_TRUE(read({"g0=2%"}).g0_of_box);
  EXPECT_FALSE(read({"g0=2%", "g0=1"}).g0_of_box) << "the last one counts";
  EXPECT_DOUBLE_EQ(read({"g1=1rad"}).g1_degrees.value(), 180 / std::numbers::pi);
  EXPECT_EQ(read({"g1=3"}).g1_degrees, 3);
  EXPECT_EQ(read({"g2=0"}).g2, 0);
  EXPECT_FALSE(read({"g2=0"}).g0);
}

TEST(AssetTolerance, RefusesWhatItDoesNotKnow) {
  for (const char* text : {"", "g1", "g3=1", "=1", "g1=", "g1=deg", "g1=abc", "g1=1 deg", "g1=0.1grad", "g1=-1deg",
                           "g1=inf", "g1=nan", "g1=5%", "g0=1deg", "g2=1rad", "G1=1", "g1=1degdeg", "g2=1e999", "%"}) {
    SCOPED_TRACE(text);
    SeamTolerance tolerance;
    expect_error<InvalidOption>([&] { read_tolerance(text, tolerance); }, {text, "g1=0.1deg"});
  }
}

}  // namespace
}  // namespace sublimit::testing
