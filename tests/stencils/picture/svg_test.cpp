// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/svg.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "stencils/cli_program.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/plane.h"

namespace sublimit::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();

TEST(Svg, LengthsOfAnyNumberAreNumbers) {
  EXPECT_EQ(svg::pixels(12.34), "12.3");
  EXPECT_EQ(svg::pixels(-0.26), "-0.3");
  EXPECT_EQ(svg::pixels(0.04), "0");
  EXPECT_EQ(svg::pixels(none), "0");
  for (const double huge : {infinity, 1e300, 9.3e17}) {
    EXPECT_EQ(svg::pixels(huge), "10000000");
    EXPECT_EQ(svg::pixels(-huge), "-10000000");
  }
}

TEST(Svg, StepsBetweenAnySpotsAreInts) {
  EXPECT_EQ(svg::spot(none, 1.26), (svg::Spot{0, 13}));
  svg::Path path;
  path.move(svg::spot(-infinity, infinity));
  path.line(svg::spot(infinity, -infinity));
  EXPECT_EQ(path.data(), "m-100000000 100000000 200000000-200000000");
}

TEST(Svg, OnePointIsDrawnInTheMiddle) {
  const page::Point isolated(.25, -3);
  const page::Fit fit = page::fit_points({isolated}, 380, 330, 36);
  EXPECT_EQ(fit.x(isolated), 190);
  EXPECT_EQ(fit.y(isolated), 36);
  EXPECT_EQ(fit.height, 72);
  const auto mask = page::Json::parse(R"([{"label": [0, 0, 0], "weight": 1, "exact": "1"}])");
  page::Json figures;
  page::add_mask_figures({{"n", 4}, {"masks", {{"position", mask}}}}, "interpolatory", figures);
  const std::string drawn = figures["position"]["svg"];
  EXPECT_NE(drawn.find("<circle cx=\"190\" cy=\"36\" r=\"22\""), std::string::npos) << drawn;
}

/// The discs of a drawing: x and y, as they are written.
std::vector<std::string> discs(const std::string& drawn) {
  std::vector<std::string> found;
  for (size_t at = drawn.find("<circle cx"); at != std::string::npos; at = drawn.find("<circle cx", at + 1))
    found.push_back(drawn.substr(at, drawn.find(" r=", at) - at));
  return found;
}

// The two border edges of one face were drawn upon each other: they differ by rounding, and what is between them filled
// the picture.
TEST(Svg, SpokesOfOpenNeighborhoodsLieApart) {
  for (const int n : {1, 2, 3, 6}) {
    const page::Json along = {{{"label", {0, 1, 0}}, {"weight", .5}}, {{"label", {n, 1, 0}}, {"weight", -.5}}};
    const page::Json border = {{"kind", "border"}, {"n", n}, {"masks", {{"tangent1", along}}}};
    page::Json figures;
    page::add_mask_figures(border, "loop", figures);
    const std::vector<std::string> found = discs(figures["tangent1"]["svg"]);
    EXPECT_EQ(found, (std::vector<std::string>{"<circle cx=\"344\" cy=\"36\"", "<circle cx=\"36\" cy=\"36\""})) << n;
  }
}

// These died in the program that ships, when tests had other flags.
TEST(Svg, PagesOfOneValenceAreWritten) {
  const TemporaryDirectory directory;
  for (const char* scheme : {"loop", "catmull-clark", "sqrt3", "butterfly", "kobbelt"}) {
    const std::string page = (directory / (std::string(scheme) + ".html")).string();
    const Outcome outcome = sublimit({"analyze", "-s", scheme, "--valence", "4", "-o", page});
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 1) << scheme << ": " << outcome.err;
    EXPECT_GT(read_file(page).size(), 10000u) << scheme;
  }
}

}  // namespace
}  // namespace sublimit::testing
