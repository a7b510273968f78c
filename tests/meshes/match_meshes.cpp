// SPDX-License-Identifier: Apache-2.0
#include "meshes/match_meshes.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Their vertex of each of ours if half-edge `h` is their `g`; nothing if that cannot be.
std::optional<std::vector<Index>> lay(const Topology& a, const Topology& b, HalfEdge h, HalfEdge g) {
  std::vector<Index> half(a.num_half_edges(), -1), vertex(a.num_vertices(), -1), back(b.num_vertices(), -1);
  std::vector<HalfEdge> open{h};
  half[index(h)] = index(g);
  const auto agree = [&](HalfEdge i, HalfEdge j) {
    if (exists(i) != exists(j)) return false;
    if (!exists(i)) return true;
    if (half[index(i)] >= 0) return half[index(i)] == index(j);
    half[index(i)] = index(j);
    open.push_back(i);
    return true;
  };
  while (!open.empty()) {
    const HalfEdge i = open.back(), j{half[index(i)]};
    open.pop_back();
    const Index v = index(a.tail(i)), w = index(b.tail(j));
    if (vertex[v] < 0 && back[w] < 0) vertex[v] = w, back[w] = v;
    if (vertex[v] != w || a.size(a.face(i)) != b.size(b.face(j))) return {};
    if (!agree(a.next(i), b.next(j)) || !agree(a.twin(i), b.twin(j))) return {};
  }
  if (std::count(vertex.begin(), vertex.end(), -1) > 0) return {};
  return vertex;
}

}  // namespace

OurMesh our_mesh(const std::string& scheme, const Mesh& mesh, int levels, Boundary boundary) {
  SubdivisionOptions options;
  options.boundary = boundary;
  OurMesh result{refine(find_scheme(scheme).value(), mesh, levels, options), mesh.positions};
  for (int k = 1; k <= levels; ++k) result.positions = apply(result.levels[k].S, result.positions);
  return result;
}

Matching match(const OurMesh& our_refined, const PeerMesh& theirs) {
  Matching result;
  const Topology& ours = our_refined.topology();
  const Points& x = our_refined.positions;
  const Topology other({.num_vertices = Index(theirs.positions.rows()),
                        .face_vertices = theirs.face_vertices,
                        .face_sizes = theirs.face_sizes});
  const auto counts = [](Index v, Index e, Index f) {
    return std::to_string(v) + " vertices, " + std::to_string(e) + " edges, " + std::to_string(f) + " faces";
  };
  const std::string a = counts(ours.num_vertices(), ours.num_edges(), ours.num_faces());
  const std::string b = counts(other.num_vertices(), theirs.num_edges, other.num_faces());
  if (a != b) {
    result.mismatch = a + ", not " + b;
    return result;
  }
  const HalfEdge first{0};
  const auto distance_to_first = [&](Index g) {
    return (x.row(index(ours.tail(first))) - theirs.positions.row(index(other.tail(HalfEdge{g})))).norm() +
           (x.row(index(ours.head(first))) - theirs.positions.row(index(other.head(HalfEdge{g})))).norm();
  };
  std::vector<Index> candidates(other.num_half_edges());
  std::iota(candidates.begin(), candidates.end(), 0);
  const auto tried = candidates.begin() + std::min<size_t>(candidates.size(), 24);
  std::partial_sort(candidates.begin(), tried, candidates.end(),
                    [&](Index g, Index h) { return distance_to_first(g) < distance_to_first(h); });
  result.error = std::numeric_limits<double>::infinity();
  const double size = diagonal(x);
  for (auto g = candidates.begin(); g != tried; ++g) {
    const auto vertex_map = lay(ours, other, first, HalfEdge{*g});
    if (!vertex_map) continue;
    std::vector<double> distance(vertex_map->size());
    for (size_t v = 0; v < distance.size(); ++v)
      distance[v] = (x.row(Index(v)) - theirs.positions.row((*vertex_map)[v])).norm() / size;
    const auto worst = std::max_element(distance.begin(), distance.end());
    if (!(*worst < result.error)) continue;
    result.error = *worst;
    result.worst = Index(worst - distance.begin());
    result.vertex_map = *vertex_map;
    result.distance = distance;
  }
  if (result.vertex_map.empty()) result.mismatch = "no half-edge nearby can stand for our first one";
  return result;
}

}  // namespace sublimit::testing
