// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/canonical_neighborhood.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "sublimit/mesh/detail/topology_builder.h"

namespace sublimit {
namespace {

/// Sharpness, one level on, of an edge's half at one of its ends.
float child_at_end(const Topology& t, const Sharpness& sharpness, Edge e, Vertex end) {
  const float s = sharpness.edge[index(e)];
  if (sharpness.creasing == Creasing::uniform || !is_semi_sharp(s)) return decayed(s);
  const std::vector<Edge> around = t.edges(end);
  const auto at = std::find(around.begin(), around.end(), e) - around.begin();
  return VertexSharpness(t, sharpness, end).child_edges[at];
}

/// Means of sharpness are float sums in the order of the edges, and three or more terms can round differently in
/// another: such a ring keeps the mesh's own order.
bool depends_on_order(const Topology& t, const Sharpness& sharpness, Vertex v) {
  int terms = is_semi_sharp(sharpness.vertex[index(v)]);
  for (const Edge e : t.edges(v)) terms += is_semi_sharp(sharpness.edge[index(e)]);
  return terms > 2;
}

NeighborhoodAt walk(const Topology& t, const Sharpness& sharpness, Vertex v, const std::vector<HalfEdge>& starts) {
  NeighborhoodAt result;
  CanonicalNeighborhood& type = result.type;
  type.sharpness = sharpness.vertex[index(v)];
  type.creasing = sharpness.creasing;
  result.vertices = {index(v)};
  std::vector<Edge> edges;        // of the spokes
  std::map<Edge, size_t> shared;  // loops, and those where fans meet: their place among the edges
  size_t fan_begin = 0;
  // `end` is the far end as this corner sees it: that of a loop (v,v) is the vertex again.
  const auto spoke = [&](Edge e, Vertex end) {
    // The last one, or the one that the fan began with; elsewhere only loops and what several fans share.
    auto at = edges.end();
    if (edges.size() > fan_begin && edges.back() == e)
      at = edges.end() - 1;
    else if (edges.size() > fan_begin && edges[fan_begin] == e)
      at = edges.begin() + std::ptrdiff_t(fan_begin);
    else if (end == v || t.is_nonmanifold(v))
      at = edges.begin() + std::ptrdiff_t(shared.try_emplace(e, edges.size()).first->second);
    const auto spoke = static_cast<Index>(at - edges.begin());
    if (at == edges.end()) {
      edges.push_back(e);
      type.spokes.push_back({sharpness.edge[index(e)], child_at_end(t, sharpness, e, end), type.num_slots++});
      result.vertices.push_back(index(end));
    }
    return spoke;
  };
  for (const HalfEdge start : starts) {
    fan_begin = edges.size();
    CanonicalNeighborhood::Fan fan;
    std::vector<HalfEdge> corners;
    HalfEdge h = start;
    do {
      const HalfEdge last = t.prev(h);
      CanonicalNeighborhood::Corner corner;
      corner.face_size = t.size(t.face(h));
      corner.slots.reserve(static_cast<size_t>(corner.face_size));
      corner.spoke = spoke(t.edge(h), t.head(h));
      corner.slots = {0, type.spokes[corner.spoke].slot};
      for (HalfEdge g = t.next(t.next(h)); g != last; g = t.next(g)) {
        corner.slots.push_back(type.num_slots++);
        result.vertices.push_back(index(t.tail(g)));
      }
      corner.next_spoke = spoke(t.edge(last), t.tail(last));
      corner.slots.push_back(type.spokes[corner.next_spoke].slot);
      fan.corners.push_back(std::move(corner));
      corners.push_back(h);
      h = t.twin(last);
    } while (exists(h) && h != start);
    fan.closed = exists(h);
    type.fans.push_back(std::move(fan));
    result.corners.push_back(std::move(corners));
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> CanonicalNeighborhood::signature() const {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(creasing), std::bit_cast<std::uint32_t>(sharpness)};
  for (const Fan& fan : fans) {
    words.push_back(static_cast<std::uint32_t>(2 * fan.corners.size() + fan.closed));
    for (const Corner& corner : fan.corners) {
      for (const Index i : {corner.face_size, corner.spoke, corner.next_spoke})
        words.push_back(static_cast<std::uint32_t>(i));
      for (const Index i : {corner.spoke, corner.next_spoke}) {
        words.push_back(std::bit_cast<std::uint32_t>(spokes[i].sharpness));
        words.push_back(std::bit_cast<std::uint32_t>(spokes[i].far_child));
      }
    }
  }
  return words;
}

Rule CanonicalNeighborhood::rule() const {
  std::vector<float> edges;
  for (const Spoke& spoke : spokes) edges.push_back(spoke.sharpness);
  return VertexSharpness::rule_of(sharpness, edges);
}

NeighborhoodAt neighborhood(const Topology& t, const Sharpness& sharpness, Vertex v, bool aligned) {
  std::vector<HalfEdge> starts = t.fans(v);
  if (!aligned && starts.size() == 1 && exists(t.twin(starts[0])) && !depends_on_order(t, sharpness, v)) {
    // Least rotation of (face size, sharpness, child sharpness) around the vertex, by comparing sequences of words.
    std::vector<std::array<std::uint32_t, 3>> words;
    std::vector<HalfEdge> halves;
    HalfEdge h = starts[0];
    do {
      const Edge e = t.edge(h);
      words.push_back({static_cast<std::uint32_t>(t.size(t.face(h))),
                       std::bit_cast<std::uint32_t>(sharpness.edge[index(e)]),
                       std::bit_cast<std::uint32_t>(child_at_end(t, sharpness, e, t.head(h)))});
      halves.push_back(h);
      h = t.ccw(h);
    } while (h != starts[0]);
    const size_t n = words.size();
    size_t best = 0, candidate = 1, matched = 0;  // the classical two-pointer search for the least rotation
    while (best < n && candidate < n && matched < n) {
      const auto& a = words[(best + matched) % n];
      const auto& b = words[(candidate + matched) % n];
      if (a == b) {
        ++matched;
        continue;
      }
      (b < a ? best : candidate) += matched + 1;
      if (best == candidate) ++candidate;
      matched = 0;
    }
    starts[0] = halves[std::min(best, candidate)];
  }
  return walk(t, sharpness, v, starts);
}

UnfoldedPatch unfold(const CanonicalNeighborhood& type) {
  // Faces of a fan are glued along their spokes, and nothing else is: what was not one sheet must not become one here.
  TopologyBuilder b;
  b.face_offsets = {0};
  std::vector<std::vector<Index>> loose(type.spokes.size());  // half-edges without twin, by spoke
  for (const auto& fan : type.fans) {
    const Index first = static_cast<Index>(b.tail.size());
    for (const auto& corner : fan.corners) {
      b.tail.insert(b.tail.end(), corner.slots.begin(), corner.slots.end());
      b.face_offsets.push_back(static_cast<Index>(b.tail.size()));
    }
    b.twin.resize(b.tail.size(), -1);
    const size_t n = fan.corners.size();
    Index begin = first;
    for (size_t c = 0; c < n; ++c) {
      const Index end = begin + fan.corners[c].face_size;
      if (c + 1 < n || fan.closed) {
        const Index next = c + 1 < n ? end : first;
        b.twin[end - 1] = next;
        b.twin[next] = end - 1;
      }
      if (!fan.closed && c == 0) loose[fan.corners[c].spoke].push_back(begin);
      if (!fan.closed && c + 1 == n) loose[fan.corners[c].next_spoke].push_back(end - 1);
      begin = end;
    }
  }
  for (const auto& halves : loose)
    if (halves.size() > 1) b.nonmanifold_edges.push_back(halves);
  b.find_fans(type.num_slots);
  UnfoldedPatch patch;
  patch.topology = std::move(b).build();
  patch.sharpness.creasing = type.creasing;
  // The rim is where the patch ends, not the mesh: its rows are never used, and sharp ones need no neighbours.
  patch.sharpness.vertex.assign(patch.topology.num_vertices(), infinite_sharpness);
  patch.sharpness.edge.assign(patch.topology.num_edges(), infinite_sharpness);
  patch.sharpness.vertex[0] = type.sharpness;
  const std::vector<Edge> edges = spoke_edges(type, patch.topology);
  for (size_t i = 0; i < edges.size(); ++i) patch.sharpness.edge[index(edges[i])] = type.spokes[i].sharpness;
  return patch;
}

std::vector<Edge> spoke_edges(const CanonicalNeighborhood& type, const Topology& t) {
  std::vector<Edge> to(static_cast<size_t>(type.num_slots), Edge{-1});
  for (const Edge e : t.edges(Vertex{0})) {
    Edge& found = to[static_cast<size_t>(index(t.tail(e) == Vertex{0} ? t.head(e) : t.tail(e)))];
    if (index(found) < 0 || e < found) found = e;
  }
  std::vector<Edge> edges;
  edges.reserve(type.spokes.size());
  for (const auto& spoke : type.spokes) edges.push_back(to[static_cast<size_t>(spoke.slot)]);
  return edges;
}

}  // namespace sublimit
