// SPDX-License-Identifier: Apache-2.0
#pragma once
// Labsik, Greiner 2000, "Interpolatory sqrt(3)-subdivision". The points of faces at interior vertices of valence other
// than 6 are made from the ring of that vertex (the mean, if there are several). Border: left alone in even levels,
// trisected in odd ones by cubic interpolation of four points (Deslauriers, Dubuc 1989). Faces near it use the virtual
// vertices of butterfly.h.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T>
Scheme<T> interpolatory_sqrt3(const SchemeOptions&) {
  const auto regular = [](const WideFaceSite<T>& f) {
    Stencil<T> corners, across, further;
    for (int i = 0; i < 3; ++i) {
      const Ring<T>& v = f.ring(i);
      corners += f.corner(i);
      across += v.continued(-1);  // beyond the edge to the next corner
      further += v.continued(3) + v.continued(-2);
    }
    return (32 * corners - across - 2 * further) / 81;
  };
  // The face lies between neighbours 0 and 1.
  const auto extraordinary = [](const Ring<T>& v) {
    const int n = v.valence();
    const T a = v.ratio(2, 3) * v.cos_2pi(1, 2 * n);
    if (n == 3) return (24 * v.center() + 4 * (v.neighbor(0) + v.neighbor(1)) - 5 * v.neighbor(2)) / 27;
    Stencil<T> sum = (T(1) - a * a) * v.center();
    for (int i = 0; i < n; ++i)
      sum +=
          ((a * a + 2 * a * v.cos_2pi(2 * i + 1, 2 * n) + 2 * a * a * v.cos_2pi(2 * i + 1, n)) / n) * v.neighbor(i + 1);
    return sum;
  };
  const Step<T> step{.split = Split::sqrt3,
                     .masks = {.vertex = [](const Ring<T>& v) { return v.center(); },
                               .wide_face =
                                   [=](const WideFaceSite<T>& f) {
                                     Stencil<T> sum;
                                     int count = 0;
                                     for (int i = 0; i < 3; ++i) {
                                       const Ring<T>& v = f.ring(i);
                                       if (!v.is_closed() || v.valence() == 6) continue;
                                       sum += extraordinary(v);
                                       ++count;
                                     }
                                     return count == 0 ? regular(f) : sum / T(count);
                                   }}};
  return {.name = "interpolatory-sqrt3",
          .source = "Labsik, Greiner 2000, Interpolatory sqrt(3)-subdivision",
          .steps = {step},
          .creases = {.vertex = [](const CreaseSite<T>& v) { return v.center(); },
                      .edge =
                          [](const CreaseEdgeSite<T>& e) {
                            return (60 * e.tail() + 30 * e.head() - 5 * e.before() - 4 * e.after()) / 81;
                          }},
          .claims = {.regular = 1,
                     .extraordinary = 1,
                     .generates = 3,
                     .reproduces = 3,
                     .interpolates = true,
                     .limit = "no closed form"},
          .period = 2,
          .sharpening = Sharpening::boundary};
}

}  // namespace sublimit
