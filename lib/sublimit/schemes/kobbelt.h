// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kobbelt 1996, "Interpolatory subdivision on open quadrilateral nets with arbitrary topology": the four-point rule
// (Dyn, Levin, Gregory 1987) in both directions. At an extraordinary vertex the missing point of an edge's rule is a
// virtual one, such that both ways of making a face point commute; where they differ after all (several extraordinary
// vertices) the mean is taken. Border: the four-point rule along it; across it, points are continued linearly. Faces
// with other than four corners are cut into quadrilaterals first: option quads=catmull-clark (centroid, midpoints of
// edges) or quads=edges (one quadrilateral for each edge, from its ends and the two centroids).
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T>
Scheme<T> kobbelt(const SchemeOptions& options) {
  const OptionInfo tension{
      .name = "tension",
      .values = {"1"},
      .meaning =
          "0 is piecewise linear, 1 reproduces cubics; curves are C^1 below 3.08 (Hechler et al. 2009), points of "
          "valence 3 up to 3/2",
      .range = OptionRange{{0, 1}, {3, 1}}};
  const OptionInfo quads{
      .name = "quads",
      .values = {"catmull-clark", "edges"},
      .meaning =
          "how faces of other than four corners are cut first: n quads each, or a quad for each edge (a border "
          "edge's has the edge's middle, which gets no normal)"};
  const Ratio g = ratio_option(options, tension);
  const bool by_edges = option(options, quads) == "edges";
  const auto inner = [=](const auto& site) { return site.ratio(8 * g.q + g.p, 16 * g.q); };
  const auto outer = [=](const auto& site) { return site.ratio(g.p, 16 * g.q); };
  // The point beyond v on the line of the ring's own edge.
  const auto beyond = [=](const Ring<T>& v) {
    const int n = v.valence();
    if (!v.is_closed()) return 2 * v.center() - v.neighbor(0);
    if (n == 4) return v.neighbor(2);
    const T r = v.ratio(g.p, 8 * g.q + g.p);
    Stencil<T> edges, diagonals;
    for (int j = 0; j < n; ++j) edges += v.neighbor(j), diagonals += v.diagonal(j);
    return (T(4) / n) * (edges - r * diagonals) - (v.neighbor(-1) + v.neighbor(0) + v.neighbor(1)) +
           r * (v.diagonal(-2) + v.diagonal(-1) + v.diagonal(0) + v.diagonal(1));
  };
  const auto tensor = [=](const WideFaceSite<T>& f) {
    const T a = inner(f), b = outer(f);
    Stencil<T> sum;
    for (int i = 0; i < 4; ++i) {
      const Ring<T>& v = f.ring(i);  // neighbours 0 and 1 are corners of the face
      sum += a * a * f.corner(i) - a * b * (v.neighbor(2) + v.neighbor(3)) + b * b * v.diagonal(2);
    }
    return sum;
  };
  const auto across = [=](const WideFaceSite<T>& f, int i) {  // from the points of edges i and i + 2
    const auto next = [&](int k) {
      return f.has_across(k) ? f.edge_point_beyond(k) : 2 * f.edge_point(k) - f.edge_point((k + 2) % 4);
    };
    return inner(f) * (f.edge_point(i) + f.edge_point(i + 2)) - outer(f) * (next(i) + next(i + 2));
  };
  const auto keep = [](const auto& v) { return v.center(); };
  const auto middle = [](const auto& e) { return (e.tail() + e.head()) / 2; };
  const Step<T> step{.split = Split::pqq,
                     .masks = {.vertex = keep,
                               .wide_edge =
                                   [=](const WideEdgeSite<T>& e) {
                                     return inner(e) * (e.tail() + e.head()) -
                                            outer(e) * (beyond(e.tail_ring()) + beyond(e.head_ring()));
                                   },
                               .wide_face =
                                   [=](const WideFaceSite<T>& f) {
                                     bool regular = true;
                                     for (int i = 0; i < 4; ++i)
                                       regular &= f.ring(i).is_closed() && f.ring(i).valence() == 4;
                                     return regular ? tensor(f) : (across(f, 0) + across(f, 1)) / 2;
                                   }}};
  const Step<T> cut{
      .split = by_edges ? Split::quads : Split::pqq,
      .masks = {.vertex = keep, .edge = middle, .face = [](const FaceSite<T>& f) { return f.centroid(); }},
      .creases = {.vertex = keep, .edge = middle}};
  return {.name = "kobbelt",
          .source = "Kobbelt 1996, Interpolatory subdivision on open quadrilateral nets with arbitrary topology",
          .steps = {step},
          .creases = {.vertex = keep,
                      .edge =
                          [=](const CreaseEdgeSite<T>& e) {
                            return inner(e) * (e.tail() + e.head()) - outer(e) * (e.before() + e.after());
                          }},
          .claims = {.regular = g.p > 0 ? 1 : 0,
                     .extraordinary = g.p > 0 && 2 * g.p <= 3 * g.q ? 1 : 0,
                     .generates = g.p == g.q ? 3 : 1,
                     .reproduces = g.p == g.q ? 3 : 1,
                     .convex_hull = g.p == 0,
                     .interpolates = true,
                     .limit = g.p > 0 ? "no closed form" : "bilinear patches"},
          .options = {tension, quads},
          .sharpening = Sharpening::sharp,
          .corners = 4,
          .preparation = {cut}};
}

}  // namespace sublimit
