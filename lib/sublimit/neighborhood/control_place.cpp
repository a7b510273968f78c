// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/control_place.h"

#include <utility>

namespace sublimit {
namespace {

using Origin = Refinement::Origin;

/// Each refinement with the topology that it began with, the last one first.
std::vector<std::pair<const Topology*, const Refinement*>> backwards(const std::vector<Level>& levels) {
  std::vector<std::pair<const Topology*, const Refinement*>> steps;
  for (size_t k = levels.size(); k-- > 1;)
    for (size_t s = levels[k].steps.size(); s-- > 0;)
      steps.push_back({s > 0 ? &levels[k].steps[s - 1].topology : &levels[k - 1].topology(), &levels[k].steps[s]});
  return steps;
}

}  // namespace

std::string control_place(const std::vector<Level>& levels, Vertex v) {
  Face face{-1};  // once it comes from a face or an edge
  for (const auto& [parent, step] : backwards(levels)) {
    if (index(face) >= 0) {
      face = Face{step->face_parent[index(face)]};
      continue;
    }
    const Index from = step->parent(v);
    switch (step->origin(v)) {
      case Origin::vertex:
        v = Vertex{from};
        break;
      case Origin::face:
        face = Face{from};
        break;
      case Origin::edge:
        face = parent->face(parent->half_edge(Edge{from}));
        break;
      default:
        v = parent->tail(HalfEdge{from});
    }
  }
  return index(face) >= 0 ? "a point in face " + std::to_string(index(face)) : "vertex " + std::to_string(index(v));
}

}  // namespace sublimit
