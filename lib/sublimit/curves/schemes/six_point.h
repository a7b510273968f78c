// SPDX-License-Identifier: Apache-2.0
#pragma once
// Deslauriers, Dubuc 1989, "Symmetric iterative interpolation processes", with six points: a new point lies on the
// quintic through the three old ones before and after it. The limit is C^2, of exponent -log2(9/64) = 2.830.
#include "sublimit/curves/schemes/curve_ends.h"

namespace sublimit {

template <class T>
CurveScheme<T> six_point(const SchemeOptions& options) {
  const OptionInfo ends{.name = "ends",
                        .values = {"quintic", "cubic", "linear"},
                        .meaning = "the polynomial through the first points that goes on beyond an open end"};
  const std::string word = option(options, ends);
  return {.name = "six-point",
          .source = "Deslauriers, Dubuc 1989, Symmetric iterative interpolation processes",
          .masks = {.point = [](const CurveSite<T>& p) { return p.point(0); },
                    .edge =
                        [](const CurveSite<T>& p) {
                          return (150 * (p.point(0) + p.point(1)) - 25 * (p.point(-1) + p.point(2)) +
                                  3 * (p.point(-2) + p.point(3))) /
                                 256;
                        }},
          .ends = extrapolated_ends<T>(word == "quintic" ? 5
                                       : word == "cubic" ? 3
                                                         : 1),
          .claims = {.regular = 2,
                     .generates = 5,
                     .reproduces = 5,
                     .interpolates = true,
                     .limit = "no polynomial pieces",
                     .exponent = "2.830"},
          .options = {ends}};
}

}  // namespace sublimit
