// SPDX-License-Identifier: Apache-2.0
#pragma once
// Dubuc 1986, "Interpolation through an iterative scheme" (tension 1); Dyn, Levin, Gregory 1987, "A 4-point
// interpolatory subdivision scheme for curve design" (any tension; their w is tension/16).
//
// The limit is C^1 for 0 < tension < 3.0837, where 32 w^3 + 4 w = 1 at the end (Hechler, Moessner, Reif 2009); below
// 2 (sqrt 5 - 1) = 2.4721 the norm of two steps of the difference scheme proves it. Tension 0 is the polygon itself,
// tension 1 reproduces cubics.
#include "sublimit/base/error.h"
#include "sublimit/curves/schemes/curve_ends.h"

namespace sublimit {

template <class T>
CurveScheme<T> four_point(const SchemeOptions& options) {
  const OptionInfo tension{
      .name = "tension",
      .values = {"1"},
      .meaning = "0 keeps the polygon, 1 reproduces cubics, the limit is C^1 above 0 and below 3.0837",
      .range = OptionRange{{0, 1}, {77, 25}}};
  const OptionInfo ends{.name = "ends",
                        .values = {"reproduced", "linear", "quadratic", "cubic"},
                        .meaning =
                            "degree of the polynomial that goes on beyond an open end; reproduced: what the inside "
                            "reproduces, cubic for tension 1, else linear"};
  const Ratio g = ratio_option(options, tension);
  const bool cubics = g.p == g.q, smooth = g.p > 0;
  const std::string word = option(options, ends);
  const int degree = word == "cubic" || (word == "reproduced" && cubics) ? 3 : word == "quadratic" ? 2 : 1;
  // The second eigenvalue at the end is 1/2 up to here: tension/4 for quadratic ends, and for cubic ones the larger
  // root of t^2 - 6 w t + w - 8 w^2 with w = tension/16, which passes 1/2 where 8 w^2 + 2 w = 1/4, just above 1.46.
  if (degree > 1 && g.value() >= (degree == 2 ? 2 : 1.46))
    throw InvalidOption("option ends=" + word + ": with tension " +
                        (options.count("tension") ? options.at("tension") : "1") +
                        " the limit has no tangent at the ends; " + word + " ends need tension below " +
                        (degree == 2 ? "2" : "1.46") + ", ends=linear takes any");
  return {.name = "four-point",
          .source = "Dyn, Levin, Gregory 1987, A 4-point interpolatory subdivision scheme for curve design",
          .masks = {.point = [](const CurveSite<T>& p) { return p.point(0); },
                    .edge =
                        [g](const CurveSite<T>& p) {
                          const T w = p.ratio(g.p, g.q) / 16;
                          return (p.ratio(1, 2) + w) * (p.point(0) + p.point(1)) - w * (p.point(-1) + p.point(2));
                        }},
          .ends = extrapolated_ends<T>(degree),
          .claims = {.regular = smooth ? 1 : 0,
                     .generates = cubics ? 3 : 1,
                     .reproduces = cubics ? 3 : 1,
                     .convex_hull = !smooth,
                     .interpolates = true,
                     .limit = smooth ? "no polynomial pieces" : "the polygon",
                     .exponent = cubics   ? "2 (logarithm)"
                                 : smooth ? "below 2"
                                          : "1"},
          .options = {tension, ends}};
}

}  // namespace sublimit
