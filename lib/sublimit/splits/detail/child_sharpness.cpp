// SPDX-License-Identifier: Apache-2.0
#include "sublimit/splits/detail/child_sharpness.h"

#include <algorithm>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {

std::pair<float, float> sharpness_of_halves(const Sharpness& sharpness, const Topology& parent, Edge e) {
  const float s = sharpness.edge[index(e)];
  const auto at = [&](Vertex end) {  // how the edge decays at one of its ends
    if (!is_semi_sharp(s) || sharpness.creasing == Creasing::uniform) return decayed(s);
    const std::vector<Edge> around = parent.edges(end);
    const auto position = std::find(around.begin(), around.end(), e) - around.begin();
    return VertexSharpness(parent, sharpness, end).child_edges[position];
  };
  return {at(parent.tail(e)), at(parent.head(e))};
}

Sharpness refine(const Sharpness& sharpness, const Topology& parent, const Refinement& r) {
  Sharpness child;
  child.creasing = sharpness.creasing;
  child.vertex.resize(r.topology.num_vertices());
  child.edge.resize(r.topology.num_edges());
  const bool primal = is_primal(r.split);
  parallel_for(r.topology.num_vertices(), [&](std::int64_t v) {
    child.vertex[v] = v < r.from_vertices ? decayed(sharpness.vertex[r.parent(Vertex{Index(v)})]) : 0;
  });
  parallel_for(r.topology.num_edges(), [&](std::int64_t e) {
    const bool is_border = !primal && !exists(r.topology.twin(r.topology.half_edge(Edge{Index(e)})));
    child.edge[e] = is_border ? infinite_sharpness : 0;
  });
  if (!primal) return child;  // nothing but borders is sharp there
  parallel_for(parent.num_edges(), [&](std::int64_t i) {
    const Edge e{static_cast<Index>(i)};
    if (!is_sharp(sharpness.edge[i])) return;
    const auto [at_tail, at_head] = r.halves(parent, parent.half_edge(e));
    const auto [tail, head] = sharpness_of_halves(sharpness, parent, e);
    child.edge[index(r.topology.edge(at_tail))] = tail;
    child.edge[index(r.topology.edge(at_head))] = head;
  });
  return child;
}

}  // namespace sublimit
