// SPDX-License-Identifier: Apache-2.0
#pragma once
// Doo-Sabin surfaces with knot intervals, which belong to points here: non-uniform biquadratic B-splines where the mesh
// is regular. Sederberg, Zheng, Sewell, Sabin 1998, "Non-uniform recursive subdivision surfaces", SIGGRAPH 98, with new
// knots in the middle; Huang, Wang 2011 ("NURDS"). Here new knots may lie anywhere, and option levelling=on puts them
// where intervals around extraordinary faces become equal, so that from the third level on all rows there are those of
// `doo-sabin-averaging`. Border: the points of the border polygon's quadratic B-spline.
#include "sublimit/schemes/levelling.h"

namespace sublimit {

/// Two neighbours P and Q, whose intervals meet on their edge: the point of their quadratic B-spline on that knot.
template <class T>
Stencil<T> point_on_knot(const T& of_p, const T& of_q, const Stencil<T>& P, const Stencil<T>& Q) {
  return (of_q * P + of_p * Q) / (of_p + of_q);
}

template <class T>
Scheme<T> doo_sabin_intervals(const SchemeOptions& options) {
  const auto corner = [](const FaceSite<T>& f) {
    const int n = f.size();
    Stencil<T> sum;
    T total(0);
    for (int i = 0; i < n; ++i) {
      const T weight = f.knots_to_previous((i + 1) % n).length * f.knots_to_next((i + n - 1) % n).length;
      sum += weight * f.corner(i);
      total += weight;
    }
    const PointKnots<T> next = f.knots_to_next(0), previous = f.knots_to_previous(0);
    const T x = next.part(), y = previous.part();
    const Stencil<T> on_next = point_on_knot(next.length, f.knots_to_previous(1).length, f.corner(0), f.corner(1)),
                     on_previous =
                         point_on_knot(previous.length, f.knots_to_next(n - 1).length, f.corner(0), f.corner(n - 1));
    return x * y * f.corner(0) + (T(1) - x) * y * on_next + x * (T(1) - y) * on_previous +
           (T(1) - x) * (T(1) - y) * (std::move(sum) / total);
  };
  const auto on_border = [](const CreaseEdgeSite<T>& e) {
    const EdgeKnots<T>& k = e.knots();
    const T x = k.split / k.length;
    return x * e.tail() + (T(1) - x) * point_on_knot(k.length, k.after, e.tail(), e.head());
  };
  const NewKnots knots = levelling(options);
  const std::vector<OptionInfo> known_options{levelling_option()};
  return {.name = "doo-sabin-intervals",
          .source = "Sederberg, Zheng, Sewell, Sabin 1998, Non-uniform recursive subdivision surfaces",
          .steps = {{.split = Split::dqq, .masks = {.corner = corner}}},
          .creases = {.edge = on_border},
          .claims = {.regular = 1,
                     .extraordinary = 1,
                     .generates = 2,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "biquadratic B-spline"},
          .options = known_options,
          .sharpening = Sharpening::boundary,
          .knots = knots};
}

}  // namespace sublimit
