// SPDX-License-Identifier: Apache-2.0
#pragma once
// Catmull-Clark surfaces with knot intervals: non-uniform bicubic B-splines where the mesh is regular.
// Sederberg, Zheng, Sewell, Sabin 1998, "Non-uniform recursive subdivision surfaces", SIGGRAPH 98, whose rules put new
// knots in the middle; here they may lie anywhere. Option levelling=on puts them where intervals around extraordinary
// vertices become equal, so that from the third level on all rows there are Catmull-Clark's.
#include "sublimit/schemes/levelling.h"

namespace sublimit {

/// The new point of a cubic B-spline on the edge from P to Q, seen from P.
template <class T>
Stencil<T> knot_edge_point(const EdgeKnots<T>& k, const Stencil<T>& P, const Stencil<T>& Q) {
  return ((k.far() + k.after) * P + (k.near() + k.before) * Q) / (k.before + k.length + k.after);
}

/// Crease curves that are cubic B-splines of the same knots.
template <class T>
CreaseMasks<T> knot_interval_creases() {
  return {.vertex =
              [](const CreaseSite<T>& v) {
                const EdgeKnots<T>&b = v.knots_before(), &a = v.knots_after();
                return (a.far() * knot_edge_point(b, v.center(), v.before()) + (b.near() + a.near()) * v.center() +
                        b.far() * knot_edge_point(a, v.center(), v.after())) /
                       (a.length + b.length);
              },
          .edge = [](const CreaseEdgeSite<T>& e) { return knot_edge_point(e.knots(), e.tail(), e.head()); }};
}

template <class T>
Scheme<T> catmull_clark_intervals(const SchemeOptions& options) {
  const NewKnots knots = levelling(options);
  const std::vector<OptionInfo> known_options{levelling_option()};
  const auto face = [](const FaceSite<T>& f) {
    if (f.size() != 4) return f.centroid();  // its edges have one interval
    // Weights of both ends of edge 0 and of edge 1; the edges opposite to them have the same new knots.
    const auto weights = [&](int i) {
      const EdgeKnots<T> near = f.knots(i), far = f.knots((i + 2) % 4).reversed();
      const T before = (near.before + far.before) / T(2), after = (near.after + far.after) / T(2);
      const T whole = before + near.length + after;
      return std::pair<T, T>((near.far() + after) / whole, (near.near() + before) / whole);
    };
    const auto [u0, u1] = weights(0);
    const auto [v0, v1] = weights(1);
    return v0 * (u0 * f.corner(0) + u1 * f.corner(1)) + v1 * (u1 * f.corner(2) + u0 * f.corner(3));
  };
  const auto edge = [](const EdgeSite<T>& e) {
    const FaceSite<T> left = e.left_face(), right = e.right_face();
    // Across the edge: from its head into the left face, from its tail into the right one.
    const EdgeKnots<T> l = left.knots(1), r = right.knots(1);
    return (r.far() * left.point() + (l.near() + r.near()) * knot_edge_point(e.knots(), e.tail(), e.head()) +
            l.far() * right.point()) /
           (l.length + r.length);
  };
  const auto vertex = [](const Ring<T>& v) {
    const int n = v.valence();
    T splits(0), lengths(0), sum(0);
    Stencil<T> points;
    for (int i = 0; i < n; ++i) {
      const EdgeKnots<T> k = v.knots(i), next = v.knots(i + 1), previous = v.knots(i - 1);
      const EdgeKnots<T> second = v.knots(i + 2), second_back = v.knots(i - 2);
      splits += k.near() * next.near();
      lengths += k.length * next.length;
      const T m = (second.far() + second_back.far()) / T(2) * (next.near() + previous.near());
      const T f = previous.far() * second.far();
      points += m * knot_edge_point(k, v.center(), v.neighbor(i)) + f * v.face(i).point();
      sum += m + f;
    }
    const T own = v.ratio(4 * (n - 3), n) * splits / lengths;
    return own * v.center() + (T(1) - own) * (std::move(points) / sum);
  };
  return {.name = "catmull-clark-intervals",
          .source = "Sederberg, Zheng, Sewell, Sabin 1998, Non-uniform recursive subdivision surfaces",
          .steps = {{.split = Split::pqq, .masks = {.vertex = vertex, .edge = edge, .face = face}}},
          .creases = knot_interval_creases<T>(),
          .claims = {.regular = 2,
                     .extraordinary = 1,
                     .generates = 3,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "bicubic B-spline"},
          .options = known_options,
          .knots = knots};
}

}  // namespace sublimit
