// SPDX-License-Identifier: Apache-2.0
#pragma once
// Dyn, Levin, Gregory 1990, "A butterfly subdivision scheme for surface interpolation with tension control".
// Border: the four-point rule along it, so that the border curve does not depend on the inside; or, as an option, the
// butterfly's own mask with virtual vertices: every border triangle continued to a parallelogram. The two agree at
// regular border vertices. Inside, masks that reach over the border use the virtual vertices.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Returns the common part of the butterfly scheme and its modification: steps, border, claims.
template <class T, class Edge>
Scheme<T> butterfly_with(const char* name, const char* source, const SchemeOptions& options,
                         std::vector<OptionInfo> infos, const Ratio& g, const Edge& edge) {
  const OptionInfo border{
      .name = "boundary-rule",
      .values = {"four-point", "virtual-vertex"},
      .meaning =
          "the border as a curve of its own, or continued to parallelograms, so that it depends on the inside (and sharp edges have no rule)"};
  infos.push_back(border);
  const Step<T> step{.split = Split::ptq,
                     .masks = {.vertex = [](const Ring<T>& v) { return v.center(); },
                               .wide_edge = edge,
                               .wide_borders = option(options, border) == "virtual-vertex"}};
  return {.name = name,
          .source = source,
          .steps = {step},
          .creases = {.vertex = [](const CreaseSite<T>& v) { return v.center(); },
                      .edge =
                          [=](const CreaseEdgeSite<T>& e) {
                            const T w = e.ratio(g.p, 16 * g.q);
                            return (e.ratio(1, 2) + w) * (e.tail() + e.head()) - w * (e.before() + e.after());
                          }},
          .claims = {.regular = g.p > 0 && g.p < 2 * g.q ? 1 : 0,
                     .extraordinary = 0,
                     .generates = g.p == g.q ? 3 : 1,
                     .reproduces = g.p == g.q ? 3 : 1,
                     .convex_hull = g.p == 0,
                     .interpolates = true,
                     .limit = g.p > 0 ? "no closed form" : "the triangles"},
          .options = infos,
          .sharpening = step.masks.wide_borders ? Sharpening::boundary : Sharpening::sharp};
}

template <class T>
Scheme<T> butterfly(const SchemeOptions& options) {
  const OptionInfo tension{.name = "tension",
                           .values = {"1"},
                           .meaning =
                               "16 w of the paper: 0 keeps the triangles, 1 reproduces cubics, at 2 a third eigenvalue "
                               "of regular points is 1/2 and tangents are lost",
                           .range = OptionRange{{0, 1}, {2, 1}}};
  const Ratio g = ratio_option(options, tension);
  return butterfly_with<T>(
      "butterfly",
      "Dyn, Levin, Gregory 1990, A butterfly subdivision scheme for surface interpolation with tension control",
      options, {tension}, g, [=](const WideEdgeSite<T>& e) {
        const Ring<T>&a = e.tail_ring(), &b = e.head_ring();
        const T w = e.ratio(g.p, 16 * g.q);
        return e.ratio(1, 2) * (e.tail() + e.head()) + 2 * w * (a.continued(1) + a.continued(-1)) -
               w * (a.continued(2) + a.continued(-2) + b.continued(2) + b.continued(-2));
      });
}

}  // namespace sublimit
