// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bilinear subdivision: vertices stay, midpoints and centroids are added. Folklore; the limit of a quad is its bilinear
// interpolant. Creases change nothing.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T>
Scheme<T> bilinear(const SchemeOptions&) {
  const Step<T> step{.split = Split::pqq,
                     .masks = {.vertex = [](const Ring<T>& v) { return v.center(); },
                               .edge = [](const EdgeSite<T>& e) { return (e.tail() + e.head()) / 2; },
                               .face = [](const FaceSite<T>& f) { return f.centroid(); }}};
  return {.name = "bilinear",
          .source = "folklore",
          .steps = {step},
          .creases = {.vertex = [](const CreaseSite<T>& v) { return v.center(); },
                      .edge = [](const CreaseEdgeSite<T>& e) { return (e.tail() + e.head()) / 2; }},
          .claims = {.regular = 0,
                     .extraordinary = 0,
                     .reproduces = 1,
                     .convex_hull = true,
                     .interpolates = true,
                     .limit = "bilinear patches"}};
}

}  // namespace sublimit
