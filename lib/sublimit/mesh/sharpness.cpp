// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/sharpness.h"

#include <algorithm>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/detail/check_mesh.h"

namespace sublimit {
namespace {

/// Decay of the edges around a vertex at that vertex. Chaikin: 3/4 of the edge and 1/4 of the mean of the other
/// semi-sharp ones, less 1; the sum runs over all and takes the edge itself off again, so that the float bits are the
/// reference's.
std::vector<float> decayed_around(std::span<const float> edges, Creasing creasing) {
  std::vector<float> result(edges.size());
  float sum = 0;
  int count = 0;
  for (const float s : edges)
    if (is_semi_sharp(s)) {
      sum += s;
      ++count;
    }
  for (size_t i = 0; i < edges.size(); ++i) {
    const float s = edges[i];
    if (creasing == Creasing::uniform || !is_semi_sharp(s) || count < 2) {
      result[i] = decayed(s);
    } else {
      const float others = (sum - s) / static_cast<float>(count - 1);
      result[i] = std::max(0.75f * s + 0.25f * others - 1.0f, 0.0f);
    }
  }
  return result;
}

std::vector<float> sharpness_around(const Topology& topology, const Sharpness& sharpness, Vertex v) {
  std::vector<float> edges;
  for (const Edge e : topology.edges(v)) edges.push_back(sharpness.edge[index(e)]);
  return edges;
}

std::string name(const Mesh::Crease& crease) {
  return "crease (" + std::to_string(crease.tail) + "," + std::to_string(crease.head) + ")";
}
std::string name(const Mesh::Corner& corner) { return "corner " + std::to_string(corner.vertex); }

template <class Tag>
float checked_sharpness(const Tag& tag) {
  if (!(tag.sharpness >= 0))
    throw InvalidMesh(name(tag) + " has sharpness " + format_number(tag.sharpness) +
                      "; it must be >= 0 (>= 10 is infinite)");
  return std::min(tag.sharpness, infinite_sharpness);
}

bool is_one_of(Index i, Index count) { return i >= 0 && i < count; }

/// @param is_edge  whether its vertices are those of an edge
float checked(const Mesh::Crease& crease, bool is_edge) {
  if (!is_edge) throw InvalidMesh(name(crease) + " is not an edge of the mesh");
  return checked_sharpness(crease);
}

float checked(const Mesh::Corner& corner, Index vertices) {
  if (!is_one_of(corner.vertex, vertices))
    throw InvalidMesh(name(corner) + " is not a vertex; the mesh has " + std::to_string(vertices));
  return checked_sharpness(corner);
}

void check_hole(Index face, Index faces) {
  if (!is_one_of(face, faces))
    throw InvalidMesh("hole " + std::to_string(face) + " is not a face; the mesh has " + std::to_string(faces));
}

bool is_corner(const Topology& t, Vertex v, Boundary boundary) {
  if (t.is_isolated(v)) return true;
  const std::vector<Edge> edges = t.edges(v);
  if (boundary == Boundary::edge_and_corner && t.num_faces(v) == 1 && edges.size() == 2) return true;
  if (!t.is_nonmanifold(v)) return false;
  const auto nonmanifold = std::count_if(edges.begin(), edges.end(), [&](Edge e) { return t.is_nonmanifold(e); });
  const bool at_boundary = std::any_of(edges.begin(), edges.end(), [&](Edge e) { return t.half_edges(e).size() < 2; });
  return nonmanifold != 2 || at_boundary || t.num_faces(v) <= static_cast<Index>(edges.size());
}

}  // namespace

float decayed(float sharpness) {
  if (is_infinite(sharpness)) return infinite_sharpness;
  return sharpness > 1 ? sharpness - 1 : 0;
}

VertexSharpness::VertexSharpness(float vertex_, std::vector<float> edges_, Creasing creasing)
    : vertex(vertex_),
      child_vertex(decayed(vertex_)),
      edges(std::move(edges_)),
      child_edges(decayed_around(edges, creasing)) {}

VertexSharpness::VertexSharpness(const Topology& topology, const Sharpness& sharpness, Vertex v)
    : VertexSharpness(sharpness.vertex[index(v)], sharpness_around(topology, sharpness, v), sharpness.creasing) {}

Rule VertexSharpness::rule_of(float vertex, std::span<const float> edges) {
  if (is_sharp(vertex)) return Rule::corner;
  switch (std::count_if(edges.begin(), edges.end(), is_sharp)) {
    case 0:
      return Rule::smooth;
    case 1:
      return Rule::dart;
    case 2:
      return Rule::crease;
    default:
      return Rule::corner;
  }
}

float VertexSharpness::parent_weight() const {
  float sum = 0;
  int count = 0;
  if (is_sharp(vertex) && !is_sharp(child_vertex)) {
    sum += vertex;
    ++count;
  }
  for (size_t i = 0; i < edges.size(); ++i)
    if (is_sharp(edges[i]) && !is_sharp(child_edges[i])) {
      sum += edges[i];
      ++count;
    }
  return count == 0 ? 0 : std::min(sum / static_cast<float>(count), 1.0f);
}

std::pair<Index, Index> crease_ends(std::span<const float> edges) {
  const auto first = std::find_if(edges.begin(), edges.end(), is_sharp);
  const auto last = std::find_if(edges.rbegin(), edges.rend(), is_sharp);
  return {static_cast<Index>(first - edges.begin()), static_cast<Index>(edges.rend() - last) - 1};
}

Edge find_edge(const Topology& t, Vertex a, Vertex b) {
  Edge found{-1};
  for (const Edge e : t.edges(a)) {
    const bool joins = (t.tail(e) == a && t.head(e) == b) || (t.tail(e) == b && t.head(e) == a);
    if (joins && (index(found) < 0 || e < found)) found = e;
  }
  return found;
}

void check_tags(const Mesh& mesh) {
  const Index vertices = mesh.num_vertices();
  for (const Mesh::Crease& c : mesh.creases) checked(c, is_one_of(c.tail, vertices) && is_one_of(c.head, vertices));
  for (const Mesh::Corner& c : mesh.corners) checked(c, vertices);
  for (const Index f : mesh.holes) check_hole(f, mesh.num_faces());
}

Sharpness initial_sharpness(const Topology& t, const Mesh& tags, Boundary boundary, Creasing creasing) {
  Sharpness s;
  s.creasing = creasing;
  s.edge.assign(t.num_edges(), 0);
  s.vertex.assign(t.num_vertices(), 0);
  const auto known = [&](Index v) { return is_one_of(v, t.num_vertices()); };
  for (const Mesh::Crease& c : tags.creases) {
    const Edge e = known(c.tail) && known(c.head) ? find_edge(t, Vertex{c.tail}, Vertex{c.head}) : Edge{-1};
    s.edge[index(e)] = checked(c, index(e) >= 0);
  }
  for (const Mesh::Corner& c : tags.corners) s.vertex[c.vertex] = checked(c, t.num_vertices());
  for (Index e = 0; e < t.num_edges(); ++e)
    if (!exists(t.twin(t.half_edge(Edge{e})))) s.edge[e] = infinite_sharpness;
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const HalfEdge h = t.outgoing(Vertex{v});
    const bool plain = exists(h) && exists(t.twin(h));  // an interior vertex of a manifold
    if (!plain && is_corner(t, Vertex{v}, boundary)) s.vertex[v] = infinite_sharpness;
  }
  return s;
}

std::vector<bool> initial_holes(const Topology& t, const Mesh& tags, Boundary boundary) {
  std::vector<bool> holes(t.num_faces(), false);
  for (const Index f : tags.holes) {
    check_hole(f, t.num_faces());
    holes[f] = true;
  }
  if (boundary != Boundary::none) return holes;
  std::vector<bool> tagged(t.num_edges(), false), at_boundary(t.num_vertices(), false);
  for (const Mesh::Crease& c : tags.creases)
    tagged[index(find_edge(t, Vertex{c.tail}, Vertex{c.head}))] = is_infinite(c.sharpness);
  for (Index i = 0; i < t.num_edges(); ++i) {
    const Edge e{i};
    if (!tagged[i] && !exists(t.twin(t.half_edge(e))) && t.half_edges(e).size() == 1)
      at_boundary[index(t.tail(e))] = at_boundary[index(t.head(e))] = true;
  }
  for (Index h = 0; h < t.num_half_edges(); ++h)
    if (at_boundary[index(t.tail(HalfEdge{h}))]) holes[index(t.face(HalfEdge{h}))] = true;
  return holes;
}

}  // namespace sublimit
