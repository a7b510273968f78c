// SPDX-License-Identifier: Apache-2.0
#pragma once
// Peters, Reif 1997, "The simplest subdivision scheme for smoothing polyhedra": the midpoints of edges.
// Habib, Warren 1999, "Edge and vertex insertion for a class of C1 subdivision surfaces": weights over the two faces of
// an edge, such that two steps have the eigenvalues 1, 1/2, 1/2, 1/4, 1/4, 1/8 ... on an n-gon. Between two faces that
// are no quadrilaterals (in the first two steps only) it is the mean of what either asks for; that completion is ours.
// Border: two steps make Chaikin's points (see the split), so the limit ends in the quadratic B-spline of the
// border polygon.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T, class Edge>
Scheme<T> mid_edge_with(const char* name, const char* source, const Edge& edge) {
  const Step<T> step{.split = Split::mid_edge, .masks = {.edge = edge}};
  return {.name = name,
          .source = source,
          .steps = {step},
          .creases = {.vertex = [](const CreaseSite<T>& v) { return v.center(); },
                      .edge = [](const CreaseEdgeSite<T>& e) { return (e.tail() + e.head()) / 2; }},
          .claims = {.regular = 1,
                     .extraordinary = 1,
                     .generates = 2,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "Zwart-Powell box spline"},
          .period = 2,
          .sharpening = Sharpening::boundary};
}

template <class T>
Scheme<T> mid_edge(const SchemeOptions&) {
  return mid_edge_with<T>("mid-edge", "Peters, Reif 1997, The simplest subdivision scheme for smoothing polyhedra",
                          [](const EdgeSite<T>& e) { return (e.tail() + e.head()) / 2; });
}

template <class T>
Scheme<T> mid_edge_habib_warren(const SchemeOptions&) {
  // Point on the edge between corners 0 and 1 of an n-gon.
  const auto on_face = [](const FaceSite<T>& f) {
    const int n = f.size();
    Stencil<T> point;
    for (int i = 0; i < n; ++i) {
      T weight(1), power(1);  // 2^-floor(j/2)
      for (int j = 1; 2 * j < n; ++j) {
        if (j % 2 == 0) power = power / 2;
        const int k = j * (2 * i - 1) % (2 * n);
        // 2 * 2^(-j/2) cos(2 pi k/(2n)); the root of two as twice the cosine of an eighth of a turn, so that the
        // weights of quadrilaterals are exactly 1/2, 1/2, 0, 0.
        weight +=
            power * (j % 2 == 0 ? 2 * f.cos_2pi(k, 2 * n) : f.cos_2pi(4 * k + n, 8 * n) + f.cos_2pi(4 * k - n, 8 * n));
      }
      point += (weight / n) * f.corner(i);
    }
    return point;
  };
  Scheme<T> scheme = mid_edge_with<T>(
      "mid-edge-habib-warren", "Habib, Warren 1999, Edge and vertex insertion for a class of C1 subdivision surfaces",
      [=](const EdgeSite<T>& e) {
        const FaceSite<T>&a = e.left_face(), &b = e.right_face();
        if (a.size() != 4 && b.size() != 4) return (on_face(a) + on_face(b)) / 2;
        return on_face(a.size() == 4 ? b : a);  // of a quadrilateral it is the midpoint
      });
  scheme.claims.convex_hull = false;
  return scheme;
}

}  // namespace sublimit
