// SPDX-License-Identifier: Apache-2.0
// The regular part, sweeps and curves in report.json.
#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/report/analysis/regular_json.h"

#include <gtest/gtest.h>

#include "laws/stationary.h"
#include "sublimit/base/error.h"
#include "sublimit/curves/schemes/curve_schemes.h"

namespace sublimit {
namespace {

using report::Json;

TEST(RegularJson, CurveSchemesKeepTheirClaims) {
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    const Json json = report::curve_scheme_json(scheme.name);
    EXPECT_EQ(json["kind"], "curve");
    if (scheme.masks.unknowns() > 1) {
      EXPECT_TRUE(json["regular"].is_null());
      continue;
    }
    for (const Json& claim : json["claims"]) {
      const std::string verdict = claim["verdict"];
      EXPECT_TRUE(verdict == "proved" || (verdict == "evidence-for" && !testing::is_stationary(scheme)))
          << scheme.name << " " << claim.dump();
    }
  }
}

TEST(RegularJson, HasWhatTheFormatSays) {
  for (const char* name : {"chaikin", "six-point", "doo-sabin", "butterfly", "sqrt3"}) {
    const Json json = report::regular_json(name);
    for (const char* key : {"dilation", "mask", "unit", "grid", "support", "smoothness", "norms",
                            "joint_spectral_radius", "degrees", "operations", "basis", "criteria", "verdicts"})
      EXPECT_TRUE(json.contains(key)) << name << " " << key;
    const Json& basis = json["basis"];
    ASSERT_EQ(basis["values"].size(), basis["y"].size()) << name;
    EXPECT_EQ(basis["values"][0].size(), basis["x"].size()) << name;
    EXPECT_EQ(json.dump(), report::regular_json(name).dump()) << name;
  }
  const Json chaikin = report::regular_json("chaikin");
  EXPECT_EQ(chaikin["mask"][1], Json::parse(R"({"at": [-1], "weight": 0.75, "exact": "3/4"})"));
  EXPECT_EQ(chaikin["unit"], 0.5);
  EXPECT_EQ(chaikin["smoothness"]["exponent"], Json::parse("[2.0, 2.0]"));
  EXPECT_EQ(chaikin["operations"]["per_new_point"], 2.0);
  const Json catmull_clark = report::regular_json("catmull-clark");
  EXPECT_EQ(catmull_clark["degrees"],
            Json::parse(R"({"generates": 3, "reproduces": 1, "approximation_order": 2, "at_least": false})"));
  EXPECT_EQ(catmull_clark["operations"]["per_new_point"], 6.25);  // 9, 6, 6 and 4 weights
  EXPECT_THROW(report::regular_json("no-such-scheme"), InvalidOption);
  EXPECT_TRUE(report::regular_json("hermite-merrien").is_null());
}

TEST(RegularJson, SchemesOutsideTheRegistryAreTaken) {
  for (const char* name : {"loop", "mid-edge-habib-warren"})
    EXPECT_EQ(report::regular_json(*find_scheme<Algebraic>(name)).dump(), report::regular_json(name).dump()) << name;
}

TEST(RegularJson, LongNumbersStayExact) {
  Scheme<Algebraic> scheme = find_scheme<Algebraic>("bilinear").value();
  const Algebraic w = Algebraic::parse("1234567890123456789013/9876543210987654321098");
  scheme.steps[0].masks.vertex = [w](const Ring<Algebraic>& v) {
    return (Algebraic(1) - w) * v.center() + w * v.neighbor_mean();
  };
  const Json json = report::regular_json(scheme);
  ASSERT_TRUE(json.is_object());
  size_t found = 0;
  for (const Json& weight : json["mask"]) found += weight["exact"] == "8641975320864197532085/9876543210987654321098";
  EXPECT_EQ(found, 1u);
  EXPECT_TRUE(json["smoothness"]["exponent"].is_array());
}

TEST(RegularJson, SweepsCurvesAndMasks) {
  const Json swept = report::to_json(sweep("lane-riesenfeld", sweep_range("degree=0:3:1")));
  EXPECT_EQ(swept["values"], Json::parse("[0.0, 1.0, 2.0, 3.0]"));
  EXPECT_EQ(swept["series"][0]["values"], Json::parse("[null, 0, 1, 2]"));
  EXPECT_EQ(swept["series"][2]["values"], Json::parse("[null, 1.0, 2.0, 3.0]"));
  EXPECT_EQ(report::mask_scheme_json("1 4 6 4 1 /8")["regular"]["smoothness"]["continuity"], 2);
  EXPECT_TRUE(report::mask_scheme_json("1 4 6 4 1")["regular"]["smoothness"]["continuity"].is_null());
  const Json curve = report::curve_json(read_bezier_curve("piece,x,y\n0,0,0\n0,1,0\n1,1,0\n1,1,1\n"));
  EXPECT_EQ(curve["knots"][0]["c"], 0);
  EXPECT_EQ(curve["knots"][0]["g"], 0);
}

}  // namespace
}  // namespace sublimit
