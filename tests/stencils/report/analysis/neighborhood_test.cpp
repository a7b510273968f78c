// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/neighborhood.h"

#include <gtest/gtest.h>

#include <map>

#include "support/tolerance.h"

namespace sublimit::report {
namespace {

/// Neighbourhoods of one kind in a report of one scheme, by n.
std::map<int, Json> of_kind(const Json& report, const std::string& kind) {
  std::map<int, Json> found;
  for (const Json& n : report["schemes"][0]["neighborhoods"])
    if (n["kind"] == kind) found[n["n"]] = n;
  return found;
}

double sum(const Json& mask) {
  double total = 0;
  for (const Json& entry : mask) total += entry["weight"].get<double>();
  return total;
}

TEST(Neighborhoods, DartsHaveEvenAndOddModesAndMasks) {
  const Json report = schemes_report({reported_scheme("loop")}, {.valences = {4, 5}});
  const std::map<int, Json> darts = of_kind(report, "dart");
  ASSERT_EQ(darts.size(), 2u);
  const Json& four = darts.at(4);
  EXPECT_EQ(four["points"], 5);
  EXPECT_EQ(four["spectrum"][2]["exact"], "3/8");
  EXPECT_EQ(four["spectrum"][2]["block"], 1);
  EXPECT_EQ(four["spectrum"][1]["block"], 0);
  EXPECT_NEAR(sum(four["masks"]["position"]), 1, testing::other_route);
  EXPECT_NEAR(sum(four["masks"]["tangent1"]), 0, testing::other_route);
  // The odd tangent is the difference of the two edges beside the sharp one.
  ASSERT_EQ(four["masks"]["tangent2"].size(), 2u);
  EXPECT_EQ(four["masks"]["tangent2"][0]["label"], Json({1, 1, 0}));
  EXPECT_EQ(four["masks"]["tangent2"][1]["label"], Json({3, 1, 0}));
  const Json& spread = four["normals"]["spread_degrees"];
  EXPECT_LT(spread.back().get<double>(), spread[2].get<double>() / 10) << "they come together";
  EXPECT_EQ(four["verdicts"].back()["property"], "tangent-plane");
  EXPECT_EQ(four["verdicts"].back()["verdict"], "evidence-for");
}

TEST(Neighborhoods, SidesOfCreasesRepeatBordersAndSaySo) {
  const Json report = schemes_report({reported_scheme("catmull-clark")}, {.valences = {3}});
  std::map<int, Json> borders = of_kind(report, "border"), creases = of_kind(report, "crease");
  ASSERT_EQ(creases.size(), 3u);
  for (auto& [faces, crease] : creases) {
    EXPECT_EQ(crease["same_as"], "border");
    crease.erase("same_as");
    crease["kind"] = "border";
    EXPECT_EQ(crease, borders.at(faces));
  }
}

TEST(Neighborhoods, ThoseWithoutRulesAreNotListed) {
  const auto count = [](const char* scheme, NeighborhoodKind::Kind kind) {
    int number = 0;
    for (const NeighborhoodKind& k : neighborhoods(reported_scheme(scheme).scheme, {3, 4, 8})) number += k.kind == kind;
    return number;
  };
  using Kind = NeighborhoodKind::Kind;
  EXPECT_EQ(count("loop-warren", Kind::dart), 3);
  EXPECT_EQ(count("butterfly", Kind::dart), 0);
  EXPECT_EQ(count("butterfly", Kind::crease), 8);
  EXPECT_EQ(count("sqrt3", Kind::crease), 0);
  EXPECT_EQ(count("sqrt3", Kind::border), 8);
  EXPECT_EQ(count("interpolatory-sqrt3", Kind::border), 4) << "more have too many points";
  EXPECT_EQ(count("doo-sabin", Kind::border), 0);
}

}  // namespace
}  // namespace sublimit::report
