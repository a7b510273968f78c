// SPDX-License-Identifier: Apache-2.0
// Schemes by name: what there is, and what is said of a name that there is not.
#include <gtest/gtest.h>

#include "sublimit/base/error.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

TEST(SchemeByName, EveryRegisteredOneIsMade) {
  for (const auto& entry : registry<double>) EXPECT_EQ(scheme(entry.name).name, entry.name);
  for (const auto& entry : curve_registry<double>) EXPECT_EQ(curve_scheme(entry.name).name, entry.name);
  for (const auto& entry : geometric_registry<ControlPolygon>) EXPECT_EQ(geometric_scheme(entry.name).name, entry.name);
  for (const auto& entry : geometric_registry<CurvatureMesh>)
    EXPECT_EQ(geometric_scheme<CurvatureMesh>(entry.name).name, entry.name);
  for (const auto& entry : geometric_registry<NormalMesh>)
    EXPECT_EQ(geometric_scheme<NormalMesh>(entry.name).name, entry.name);
}

TEST(SchemeByName, TakesOptionsAsFindSchemeDoes) {
  EXPECT_EQ(scheme("kobbelt", {{"tension", "3/4"}}).chosen, (SchemeOptions{{"tension", "3/4"}}));
  expect_error<InvalidOption>([] { scheme("kobbelt", {{"tensoin", "3/4"}}); }, {"tensoin", "tension"});
  expect_error<InvalidOption>([] { curve_scheme("four-point", {{"tension", "100"}}); }, {"tension"});
}

TEST(SchemeByName, OfAnUnknownOneTheNearestAreNamed) {
  expect_error<InvalidOption>([] { scheme("catmul-clark"); },
                              {"unknown scheme 'catmul-clark' of surfaces", "the nearest are catmull-clark"});
  expect_error<InvalidOption>([] { scheme(""); }, {"unknown scheme ''", "there are bilinear, catmull-clark"});
  expect_error<InvalidOption>([] { curve_scheme("chaikn"); }, {"unknown scheme 'chaikn' of curves", "are chaikin"});
  expect_error<InvalidOption>([] { geometric_scheme("hermite"); }, {"unknown scheme 'hermite'", "hermite-incentre"});
  expect_error<InvalidOption>([] { geometric_scheme<NormalMesh>("pipr"); }, {"unknown scheme 'pipr'", "piper"});
}

TEST(SchemeByName, OneOfAnotherKindSaysWhatMakesIt) {
  expect_error<InvalidOption>([] { scheme("chaikin"); },
                              {"'chaikin' is a scheme of curves", "curve_scheme(\"chaikin\") makes"});
  expect_error<InvalidOption>([] { curve_scheme("loop"); },
                              {"'loop' is a scheme of surfaces", "scheme(\"loop\") makes"});
  expect_error<InvalidOption>([] { scheme("torus-pieces"); }, {"geometric_scheme<CurvatureMesh>(\"torus-pieces\")"});
  expect_error<InvalidOption>([] { curve_scheme("hermite-incentre"); },
                              {"geometric_scheme<ControlPolygon>(\"hermite-incentre\")"});
  expect_error<InvalidOption>([] { geometric_scheme<CurvatureMesh>("piper"); },
                              {"geometric_scheme<NormalMesh>(\"piper\")"});
}

}  // namespace
}  // namespace sublimit::testing
