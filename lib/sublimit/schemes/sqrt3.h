// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kobbelt 2000, "sqrt(3)-subdivision". Old vertices are relaxed; without that each of them is a spike.
// Border: left alone in even levels, trisected in odd ones by the ternary cubic B-spline.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T>
Scheme<T> sqrt3(const SchemeOptions&) {
  const Step<T> step{.split = Split::sqrt3,
                     .masks = {.vertex =
                                   [](const Ring<T>& v) {
                                     const T a = (T(4) - 2 * v.cos_2pi(1, v.valence())) / 9;
                                     return (T(1) - a) * v.center() + a * v.neighbor_mean();
                                   },
                               .face = [](const FaceSite<T>& f) { return f.centroid(); }}};
  return {.name = "sqrt3",
          .source = "Kobbelt 2000, sqrt(3)-subdivision",
          .steps = {step},
          .creases = {
              .vertex =
                  [](const CreaseSite<T>& v) {
                    return v.level() % 2 == 0 ? v.center() : (4 * v.before() + 19 * v.center() + 4 * v.after()) / 27;
                  },
              .edge = [](const CreaseEdgeSite<T>& e) { return (e.before() + 16 * e.tail() + 10 * e.head()) / 27; }},
          .claims = {.regular = 2,
                     .extraordinary = 1,
                     .generates = 2,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "no closed form"},
          .period = 2,
          .sharpening = Sharpening::boundary};
}

}  // namespace sublimit
