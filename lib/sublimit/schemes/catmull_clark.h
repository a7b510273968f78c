// SPDX-License-Identifier: Apache-2.0
#pragma once
// Catmull, Clark 1978, "Recursively generated B-spline surfaces on arbitrary topological meshes".
// Option triangles=smooth: edge points next to triangles of the control mesh lean towards the faces, so that triangles
// ripple less (weight 0.470 of OpenSubdiv's TRI_SUB_SMOOTH).
#include "sublimit/scheme/cubic_bspline_creases.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T>
Scheme<T> catmull_clark(const SchemeOptions& options) {
  const OptionInfo triangles{
      .name = "triangles", .values = {"catmark", "smooth"}, .meaning = "weights of edge points next to triangles"};
  const bool smooth_triangles = option(options, triangles) == "smooth";
  return {.name = "catmull-clark",
          .source = "Catmull, Clark 1978, Recursively generated B-spline surfaces on arbitrary topological meshes",
          .steps = {{.split = Split::pqq,
                     .masks = {.vertex =
                                   [](const Ring<T>& v) {
                                     const int n = v.valence();
                                     return ((n - 2) * v.center() + v.neighbor_mean() + v.face_point_mean()) / n;
                                   },
                               .edge =
                                   [=](const EdgeSite<T>& e) {
                                     const FaceSite<T> left = e.left_face(), right = e.right_face();
                                     const auto weight = [&](const FaceSite<T>& f) {
                                       return smooth_triangles && f.size() == 3 ? e.ratio(47, 100) : e.ratio(1, 4);
                                     };
                                     const T f = (weight(left) + weight(right)) / 2;
                                     return (e.ratio(1, 2) - f) * (e.tail() + e.head()) +
                                            f * (left.point() + right.point());
                                   },
                               .face = [](const FaceSite<T>& f) { return f.centroid(); }}}},
          .creases = cubic_bspline_creases<T>(),
          .claims = {.regular = 2,
                     .extraordinary = 1,
                     .generates = 3,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "bicubic B-spline"},
          .options = {triangles}};
}

}  // namespace sublimit
