// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lane, Riesenfeld 1980, "A theoretical development for the computer generation and display of piecewise polynomial
// surfaces": every point doubled, then `degree` times the midpoints of all edges. The mask has the binomial
// coefficients of degree + 1, the limit is the uniform B-spline of that degree.
#include "sublimit/core/detail/binomial.h"
#include "sublimit/curves/schemes/curve_ends.h"

namespace sublimit {

template <class T>
CurveScheme<T> lane_riesenfeld(const SchemeOptions& options) {
  const OptionInfo info{.name = "degree",
                        .values = {"3"},
                        .meaning = "of the B-spline; even degrees are dual, 2 is chaikin",
                        .range = OptionRange{{1, 1}, {15, 1}, true}};
  const OptionInfo ends{.name = "ends",
                        .values = {"free", "interpolate"},
                        .meaning = "free starts (degree - 1)/2 edges after the first point, interpolate in that point"};
  const int degree = whole_option(options, info);
  const std::vector<int> choose = binomials<int>(degree + 1);
  // A child with coefficient `middle` for its own point has those two further away for each step along the curve.
  const auto mask = [=](int middle) {
    return [=](const CurveSite<T>& p) {
      Stencil<T> sum;
      for (int i = middle % 2; i <= degree + 1; i += 2)
        sum += p.ratio(choose[i], 1 << degree) * p.point((middle - i) / 2);
      return sum;
    };
  };
  const int middle = (degree + 1) / 2;
  CurveMasks<T> masks;
  if (degree % 2 == 1) {
    masks.point = mask(middle);
    masks.edge = mask(middle + 1);
  } else {
    masks.before = mask(middle);
    masks.after = mask(middle + 1);
  }
  return {.name = "lane-riesenfeld",
          .source =
              "Lane, Riesenfeld 1980, A theoretical development for the computer generation and display of "
              "piecewise polynomial surfaces",
          .masks = masks,
          .ends = spline_ends<T>(options, ends),
          .claims = {.regular = degree - 1,
                     .generates = degree,
                     .reproduces = 1,
                     .convex_hull = true,
                     .interpolates = degree == 1,
                     .limit = "B-spline of degree " + std::to_string(degree),
                     .exponent = std::to_string(degree)},
          .options = {info, ends}};
}

}  // namespace sublimit
