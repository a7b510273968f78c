// SPDX-License-Identifier: Apache-2.0
#pragma once
// Repeated averaging: Lane, Riesenfeld 1980 on tensor products, Zorin, Schroeder 2001 ("A unified framework for
// primal/dual quadrilateral subdivision schemes") and Stam 2001 on all meshes. Bilinear refinement, then degree - 1
// times every face's centroid: two of these in a row move vertices to the mean of the centroids around them, an odd one
// makes the dual mesh. Border: the same averages of the border polygon, so the limit ends in its B-spline of that
// degree. Corners of odd degrees stay.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T>
Scheme<T> averaging(const SchemeOptions& options) {
  const OptionInfo info{
      .name = "degree",
      .values = {"3"},
      .meaning = "the limit of regular meshes is a B-spline of this bidegree, smooth of one order less",
      .range = OptionRange{{2, 1}, {9, 1}, true}};
  const int degree = whole_option(options, info);
  const auto middle = [](const CreaseEdgeSite<T>& e) { return (e.tail() + e.head()) / 2; };
  const Step<T> bilinear{.split = Split::pqq,
                         .masks = {.vertex = [](const Ring<T>& v) { return v.center(); },
                                   .edge = [](const EdgeSite<T>& e) { return (e.tail() + e.head()) / 2; },
                                   .face = [](const FaceSite<T>& f) { return f.centroid(); }},
                         .creases = {.vertex = [](const CreaseSite<T>& v) { return v.center(); }, .edge = middle}};
  const Step<T> twice{
      .split = Split::keep,
      .masks = {.vertex = [](const Ring<T>& v) { return v.face_centroid_mean(); }},
      .creases = {.vertex = [](const CreaseSite<T>& v) { return (v.before() + 2 * v.center() + v.after()) / 4; },
                  .edge = middle}};
  const Step<T> once{.split = Split::dual, .masks = {.face = [](const FaceSite<T>& f) { return f.centroid(); }}};
  Scheme<T> scheme{
      .name = "averaging",
      .source = "Zorin, Schroeder 2001, A unified framework for primal/dual quadrilateral subdivision schemes",
      .steps = {bilinear},
      .creases = {.edge = middle},
      .claims = {.regular = degree - 1,
                 .extraordinary = 1,
                 .generates = degree,
                 .reproduces = 1,
                 .convex_hull = true,
                 .limit = "B-spline of bidegree " + std::to_string(degree)},
      .options = {info},
      .sharpening = Sharpening::boundary};
  for (int d = 3; d <= degree; d += 2) scheme.steps.push_back(twice);
  if (degree % 2 == 0) scheme.steps.push_back(once);
  return scheme;
}

}  // namespace sublimit
