// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/check_scheme.h"

#include <initializer_list>
#include <utility>

namespace sublimit {

void check_masks(const std::string& scheme, const char* list, size_t i, Split split, const MasksThere& m) {
  const auto needs = [&](bool needed, std::initializer_list<std::pair<bool, const char*>> one_of, const char* what) {
    if (!needed) return;
    std::string names;
    for (const auto& [there, mask] : one_of) {
      if (there) return;
      names += (names.empty() ? "" : " or ") + std::string(mask);
    }
    throw InvalidParameter(scheme + " lacks the mask " + names + ", which its split " + name(split) + " needs for " +
                           what + " (" + list + "[" + std::to_string(i) + "])");
  };
  const bool keeps_vertices = is_primal(split) || split == Split::keep || split == Split::quads;
  needs(keeps_vertices || split == Split::sqrt3, {{m.vertex, "vertex"}}, "points of vertices");
  needs(is_primal(split), {{m.edge, "edge"}, {m.wide_edge, "wide_edge"}}, "points of edges");
  needs(split == Split::mid_edge, {{m.edge, "edge"}}, "points of edges");
  needs(split == Split::pqq || split == Split::sqrt3 || split == Split::quads,
        {{m.face, "face"}, {m.wide_face, "wide_face"}}, "points of faces");
  needs(split == Split::dual, {{m.face, "face"}}, "points of faces");
  needs(split == Split::dqq, {{m.corner, "corner"}}, "points at the corners of faces");
  needs(keeps_vertices || split == Split::mid_edge || split == Split::sqrt3, {{m.crease_vertex, "crease_vertex"}},
        "vertices of borders");
  needs(true, {{m.crease_edge, "crease_edge"}}, "edges of borders");
}

void check_shape(const std::string& scheme, size_t steps, size_t preparation, int period, int corners) {
  const std::string name = scheme.empty() ? "a scheme without a name" : scheme;
  if (steps == 0) throw InvalidParameter(name + " has no steps; one or more is right");
  if (period < 1) throw InvalidParameter(name + ": period is " + std::to_string(period) + "; 1 or more is right");
  if (corners != 0 && corners < 3)
    throw InvalidParameter(name + ": corners is " + std::to_string(corners) +
                           "; 3 or more, or 0 for faces of any size, is right");
  if (corners == 0 && preparation > 0)
    throw InvalidParameter(name +
                           " has steps of preparation, but does not say for faces of how many corners (`corners`)");
}

}  // namespace sublimit
