// SPDX-License-Identifier: Apache-2.0
#include "sublimit/splits/child_sharpness.h"

#include <algorithm>
#include <vector>

#include "sublimit/base/parallel_for.h"

namespace sublimit {

Sharpness refine(const Sharpness& sharpness, const Topology& parent, const Refinement& r) {
  Sharpness child;
  child.creasing = sharpness.creasing;
  child.vertex.resize(r.topology.num_vertices());
  child.edge.resize(r.topology.num_edges());
  const bool is_primal = r.split == Split::pqq || r.split == Split::ptq;
  parallel_for(r.topology.num_vertices(), [&](std::int64_t v) {
    child.vertex[v] = v < r.from_vertices ? decayed(sharpness.vertex[r.parent(Vertex{Index(v)})]) : 0;
  });
  parallel_for(r.topology.num_edges(), [&](std::int64_t e) {
    const bool is_border = !is_primal && !exists(r.topology.twin(r.topology.half_edge(Edge{Index(e)})));
    child.edge[e] = is_border ? infinite_sharpness : 0;
  });
  if (!is_primal) return child;  // nothing but borders is sharp there
  parallel_for(parent.num_edges(), [&](std::int64_t i) {
    const Edge e{static_cast<Index>(i)};
    const float s = sharpness.edge[i];
    if (!is_sharp(s)) return;
    const auto at = [&](Vertex end) {  // how the edge decays at one of its ends
      if (!is_semi_sharp(s) || sharpness.creasing == Creasing::uniform) return decayed(s);
      const std::vector<Edge> around = parent.edges(end);
      const auto position = std::find(around.begin(), around.end(), e) - around.begin();
      return VertexSharpness(parent, sharpness, end).child_edges[position];
    };
    const auto [at_tail, at_head] = r.halves(parent, parent.half_edge(e));
    child.edge[index(r.topology.edge(at_tail))] = at(parent.tail(e));
    child.edge[index(r.topology.edge(at_head))] = at(parent.head(e));
  });
  return child;
}

}  // namespace sublimit
