// SPDX-License-Identifier: Apache-2.0
// What all schemes have in common on regular meshes: polynomials of exactly the degree that they claim, and the spline
// that their limit is said to be.
#include <gtest/gtest.h>

#include "laws/laws.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/regular_limit.h"

namespace sublimit::testing {
namespace {

constexpr double spline = 1e-13;

Generator tensor(int degree) {
  return [=](double x, double y) { return cardinal_bspline(degree, x) * cardinal_bspline(degree, y); };
}
const BoxSpline quartic({{1, 0}, {0, 1}, {1, 1}}, {2, 2, 2});
const BoxSpline zwart_powell({{1, 0}, {0, 1}, {1, 1}, {1, -1}}, {1, 1, 1, 1});

// Values from the literature, so that what the schemes are compared with is known to be right.
TEST(RegularLimit, SplinesHaveTheirTextbookValues) {
  EXPECT_NEAR(cardinal_bspline(3, 0), 2.0 / 3, eigen());
  EXPECT_NEAR(cardinal_bspline(4, 0), 115.0 / 192, eigen());
  EXPECT_NEAR(cardinal_bspline(5, 0), 66.0 / 120, eigen());
  EXPECT_NEAR(cardinal_bspline(5, 2), 1.0 / 120, eigen());
  EXPECT_NEAR(quartic(0, 0), 1.0 / 2, eigen());
  EXPECT_NEAR(quartic(1, 1), 1.0 / 12, eigen());
  EXPECT_NEAR(quartic(1, -1), 0, eigen());
  EXPECT_NEAR(zwart_powell(0, 0), 1.0 / 2, eigen());
  EXPECT_NEAR(zwart_powell(1, 0), 1.0 / 8, eigen());
  EXPECT_NEAR(zwart_powell(0.5, 0.5), 1.0 / 4, eigen());
}

TEST(RegularLimit, IsTheSplineOfTheScheme) {
  const std::pair<const char*, Generator> expected[] = {{"bilinear", tensor(1)},
                                                        {"doo-sabin", tensor(2)},
                                                        {"doo-sabin-averaging", tensor(2)},
                                                        {"doo-sabin-intervals", tensor(2)},
                                                        {"catmull-clark", tensor(3)},
                                                        {"catmull-clark-intervals", tensor(3)},
                                                        {"loop", quartic},
                                                        {"loop-warren", quartic},
                                                        {"mid-edge", zwart_powell},
                                                        {"mid-edge-habib-warren", zwart_powell}};
  for (const auto& [name, generator] : expected)
    EXPECT_LE(regular_limit_error(find_scheme(name).value(), generator), spline) << name;
}

TEST(RegularLimit, OfRepeatedAveragingIsTheBSplineOfItsDegree) {
  for (int degree = 2; degree <= 9; ++degree)
    EXPECT_LE(
        regular_limit_error(find_scheme("averaging", {{"degree", std::to_string(degree)}}).value(), tensor(degree)),
        spline)
        << degree;
}

// Of another degree it is not: the comparison can fail.
TEST(RegularLimit, IsNoOtherSpline) {
  EXPECT_GT(regular_limit_error(find_scheme("catmull-clark").value(), tensor(2)), 1e-2);
  EXPECT_GT(regular_limit_error(find_scheme("mid-edge").value(), tensor(2)), 1e-2);
}

TEST(RegularMesh, PolynomialsOfTheClaimedDegreesAreReproducedAndGeneratedAndNoMore) {
  std::vector<std::pair<std::string, SchemeOptions>> variants = scheme_names_and_options();
  for (const char* degree : {"7", "8"}) variants.push_back({"averaging", {{"degree", degree}}});
  for (const auto& [name, options] : variants) {
    const Scheme<double> scheme = find_scheme(name, options).value();
    SCOPED_TRACE(name + (options.empty() ? "" : " " + options.begin()->second));
    EXPECT_EQ(reproduced_degree(scheme), scheme.claims.reproduces);
    EXPECT_EQ(generated_degree(scheme), scheme.claims.generates);
  }
}

}  // namespace
}  // namespace sublimit::testing
