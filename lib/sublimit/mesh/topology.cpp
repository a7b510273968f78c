// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/topology.h"

#include <algorithm>
#include <limits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/detail/check_mesh.h"
#include "sublimit/mesh/detail/topology_builder.h"

namespace sublimit {
namespace {

std::string number(Index i) { return std::to_string(i); }

}  // namespace

void check_faces(const MeshView& mesh) {
  const auto total = static_cast<std::int64_t>(mesh.face_vertices.size());
  if (total > std::numeric_limits<Index>::max() / 4)
    throw ResourceError("the mesh has " + std::to_string(total) + " face corners; at most " +
                        number(std::numeric_limits<Index>::max() / 4) + " fit 32-bit indices");
  if (mesh.num_vertices < 0) throw InvalidMesh("negative number of vertices");
  const auto check_size = [](Index size, Index face) {
    if (size < 3)
      throw InvalidMesh("face " + number(face) + " has " + number(size) + " corners; a face needs at least 3");
  };
  std::int64_t sum = 0;
  if (mesh.face_sizes.empty()) {
    if (total > 0) check_size(mesh.face_size, 0);
    sum = std::int64_t{mesh.num_faces()} * mesh.face_size;
  }
  for (size_t f = 0; f < mesh.face_sizes.size(); ++f) {
    check_size(mesh.face_sizes[f], static_cast<Index>(f));
    sum += mesh.face_sizes[f];
  }
  if (sum != total)
    throw InvalidMesh("the face sizes add up to " + std::to_string(sum) + " corners, but there are " +
                      std::to_string(total));
  for (std::int64_t i = 0; i < total; ++i)
    if (mesh.face_vertices[i] < 0 || mesh.face_vertices[i] >= mesh.num_vertices)
      throw InvalidMesh("corner " + std::to_string(i) + " names vertex " + number(mesh.face_vertices[i]) +
                        "; the mesh has vertices 0 to " + number(mesh.num_vertices - 1));
}

namespace {

/// Items 0..#keys-1 sorted by key, stable: bucket b holds items[start[b]] .. items[start[b+1]-1].
struct Buckets {
  std::vector<Index> start, items;
  template <class Keys>
  Buckets(const Keys& key, Index num_buckets) : start(num_buckets + 1, 0), items(key.size()) {
    for (const Index k : key) ++start[k + 1];
    for (Index b = 0; b < num_buckets; ++b) start[b + 1] += start[b];
    std::vector<Index> at(start.begin(), start.end() - 1);
    for (size_t i = 0; i < key.size(); ++i) items[at[key[i]]++] = static_cast<Index>(i);
  }
  std::span<const Index> operator[](Index b) const {
    return {items.data() + start[b], size_t(start[b + 1] - start[b])};
  }
};

/// Matches the corners of loose faces: which half-edges are twins, which share a non-manifold edge, which fans meet.
class Matcher {
 public:
  explicit Matcher(const MeshView& mesh) : num_vertices_(mesh.num_vertices) {
    b.tail.assign(mesh.face_vertices.begin(), mesh.face_vertices.end());
    const auto count = static_cast<Index>(b.tail.size());
    b.twin.assign(count, -1);
    next_.resize(count);
    face_.resize(count);
    b.face_offsets.push_back(0);
    for (Index f = 0, h = 0; f < mesh.num_faces(); ++f) {
      const Index size = mesh.face_sizes.empty() ? mesh.face_size : mesh.face_sizes[f];
      for (Index i = 0; i < size; ++i) next_[h + i] = h + (i + 1) % size;
      std::fill_n(face_.begin() + h, size, f);
      b.face_offsets.push_back(h += size);
    }
    match_edges();
    b.find_fans(num_vertices_);
    list_faulty_vertices();
    list_repeated_vertices();
  }

  TopologyBuilder b;

 private:
  Index head(Index h) const { return b.tail[next_[h]]; }
  Index prev(Index h) const {
    const Index f = face_[h];
    return h == b.face_offsets[f] ? b.face_offsets[f + 1] - 1 : h - 1;
  }
  std::string edge_name(Index h) const { return "(" + number(b.tail[h]) + "," + number(head(h)) + ")"; }
  std::string faces_of(std::span<const Index> halves) const {
    std::string names;
    for (const Index h : halves) names += (names.empty() ? "" : ", ") + number(face_[h]);
    return names;
  }
  void fault(Topology::Fault::Kind kind, std::string message) { b.faults.push_back({kind, std::move(message)}); }

  // The rules of which half-edges make one edge are OpenSubdiv's (Vtr level from face-vertices), so that refined meshes
  // agree with it: a loop (v,v) is always an edge of its own; an edge met again in the face that it was last used by
  // gets a second instance, and both are non-manifold; otherwise all half-edges between two vertices share the first
  // instance.
  void match_edges() {
    std::vector<Index> low(b.tail.size());
    for (size_t h = 0; h < low.size(); ++h) low[h] = std::min(b.tail[h], head(static_cast<Index>(h)));
    const Buckets at_vertex(low, num_vertices_);
    nonmanifold_.assign(b.tail.size(), false);
    std::vector<std::pair<Index, Index>> halves;  // by their other vertex
    std::vector<Index> pair;
    for (Index v = 0; v < num_vertices_; ++v) {
      halves.clear();
      for (const Index h : at_vertex[v]) halves.push_back({std::max(b.tail[h], head(h)), h});
      std::sort(halves.begin(), halves.end());
      for (auto first = halves.begin(), at = first; first != halves.end(); first = at) {
        pair.clear();
        for (; at != halves.end() && at->first == first->first; ++at) pair.push_back(at->second);
        match_pair(pair);
      }
    }
    std::sort(b.nonmanifold_edges.begin(), b.nonmanifold_edges.end());
  }

  /// All half-edges between the same two vertices, ascending.
  void match_pair(std::span<const Index> halves) {
    using Kind = Topology::Fault::Kind;
    if (b.tail[halves[0]] == head(halves[0])) {
      for (const Index h : halves) {
        add_nonmanifold({h});
        fault(Kind::degenerate_edge, "face " + number(face_[h]) + " visits vertex " + number(b.tail[h]) +
                                         " twice in a row; remove one corner");
      }
      return;
    }
    shared_.assign(1, halves[0]);
    bool bad = false;
    for (const Index h : halves.subspan(1)) {
      if (face_[shared_.back()] == face_[h]) {
        bad = true;
        add_nonmanifold({h});
        fault(Kind::repeated_edge,
              "face " + number(face_[h]) + " uses edge " + edge_name(h) + " twice; split the face");
        continue;
      }
      if (shared_.size() == 1 && b.tail[shared_[0]] == b.tail[h]) {
        bad = true;
        fault(Kind::inconsistent_winding,
              "faces " + number(face_[shared_[0]]) + " and " + number(face_[h]) + " use edge " + edge_name(h) +
                  " in the same direction, so that it becomes sharp there; turn one of them");
      }
      shared_.push_back(h);
    }
    if (shared_.size() > 2) {
      bad = true;
      fault(Kind::crowded_edge, "edge " + edge_name(shared_[0]) + " is used by " + number(Index(shared_.size())) +
                                    " faces: " + faces_of(shared_) + "; split it, or accept an infinitely sharp edge");
    }
    if (bad) {
      add_nonmanifold(shared_);
    } else if (shared_.size() == 2) {
      b.twin[shared_[0]] = shared_[1];
      b.twin[shared_[1]] = shared_[0];
    }
  }
  void add_nonmanifold(const std::vector<Index>& halves) {
    b.nonmanifold_edges.push_back(halves);
    for (const Index h : halves) nonmanifold_[h] = true;
  }

  void list_faulty_vertices() {
    using Kind = Topology::Fault::Kind;
    for (size_t v = 0; v < b.degree.size(); ++v)
      if (b.degree[v] == 0) fault(Kind::isolated_vertex, "vertex " + std::to_string(v) + " belongs to no face");
    for (const TopologyBuilder::Fans& fans : b.nonmanifold_vertices) {
      const auto bad_edge = [&](Index h) { return nonmanifold_[h] || nonmanifold_[prev(h)]; };
      if (fans.starts.size() > 1 && std::none_of(fans.starts.begin(), fans.starts.end(), bad_edge))
        fault(Kind::several_fans, "the faces around vertex " + number(fans.vertex) + " form " +
                                      number(Index(fans.starts.size())) +
                                      " fans; split the vertex, or accept a corner");
    }
  }

  void list_repeated_vertices() {
    std::vector<Index> seen_in(num_vertices_, -1);
    for (Index h = 0; h < static_cast<Index>(b.tail.size()); ++h) {
      const Index v = b.tail[h];
      if (seen_in[v] == face_[h] && head(prev(h)) == v && b.tail[prev(h)] != v)
        fault(Topology::Fault::Kind::repeated_vertex,
              "face " + number(face_[h]) + " visits vertex " + number(v) + " more than once; split the face there");
      seen_in[v] = face_[h];
    }
  }

  Index num_vertices_;
  std::vector<Index> next_, face_, shared_;
  std::vector<bool> nonmanifold_;  // per half-edge
};

}  // namespace

Topology::Topology(const MeshView& mesh) {
  check_faces(mesh);
  *this = std::move(Matcher(mesh).b).build();
}

Topology TopologyBuilder::corners_only(Topology&& all) {
  Topology t;
  t.num_faces_ = all.num_faces_;
  t.uniform_ = all.uniform_;
  t.offsets_ = std::move(all.offsets_);
  t.face_ = std::move(all.face_);
  t.tail_ = std::move(all.tail_);
  t.twin_ = std::move(all.twin_);
  return t;
}

Topology TopologyBuilder::build() && {
  Topology t;
  t.uniform_ = uniform_face_size;
  if (!face_offsets.empty()) {  // mixed, unless it turns out uniform
    t.num_faces_ = static_cast<Index>(face_offsets.size()) - 1;
    t.uniform_ = t.num_faces_ > 0 ? face_offsets[1] : 0;
    for (Index f = 0; f < t.num_faces_; ++f)
      if (face_offsets[f + 1] - face_offsets[f] != t.uniform_) t.uniform_ = 0;
    if (!t.uniform_) {
      t.face_.resize(tail.size());
      for (Index f = 0; f < t.num_faces_; ++f)
        std::fill(t.face_.begin() + face_offsets[f], t.face_.begin() + face_offsets[f + 1], f);
      t.offsets_ = std::move(face_offsets);
    }
  } else {
    t.num_faces_ = static_cast<Index>(tail.size()) / uniform_face_size;
  }
  t.tail_ = std::move(tail);
  t.twin_ = std::move(twin);
  t.vertex_out_ = std::move(outgoing);
  t.degree_ = std::move(degree);
  t.faults_ = std::move(faults);
  number_edges(t, nonmanifold_edges);

  for (Fans& fans : nonmanifold_vertices) {
    std::vector<Index> edges;
    for (const Index start : fans.starts) {
      HalfEdge h{start};
      do {
        edges.push_back(index(t.edge(h)));
        edges.push_back(index(t.edge(t.prev(h))));
        h = t.ccw(h);
      } while (exists(h) && h != HalfEdge{start});
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (size_t i = 0, count = edges.size(); i < count; ++i)
      if (t.tail(Edge{edges[i]}) == t.head(Edge{edges[i]})) edges.push_back(edges[i]);
    std::sort(edges.begin(), edges.end());
    t.vertex_out_[fans.vertex] = Topology::first_nonmanifold - static_cast<Index>(t.nonmanifold_vertices_.size());
    t.nonmanifold_vertices_.push_back({std::move(fans.starts), std::move(edges)});
  }
  return t;
}

void TopologyBuilder::find_fans(Index num_vertices) {
  const auto count = static_cast<Index>(tail.size());
  UninitializedVector<Index> prev(count);
  parallel_for(std::ssize(face_offsets) - 1, [&](std::int64_t f) {
    prev[face_offsets[f]] = face_offsets[f + 1] - 1;
    for (Index h = face_offsets[f] + 1; h < face_offsets[f + 1]; ++h) prev[h] = h - 1;
  });
  std::vector<bool> on_nonmanifold(count, false);
  for (const auto& group : nonmanifold_edges)
    for (const Index h : group) on_nonmanifold[h] = true;
  const auto at_bad_edge = [&](Index h) { return on_nonmanifold[h] || on_nonmanifold[prev[h]]; };

  outgoing.assign(num_vertices, -1);
  degree.assign(num_vertices, 0);
  for (Index h = 0; h < count; ++h) {
    Index& first = outgoing[tail[h]];
    if (first < 0 || (twin[h] < 0 && twin[first] >= 0)) first = h;
    ++degree[tail[h]];
  }
  const auto is_manifold = [&](Index start, Index corners) {  // one walk comes past all corners, and no bad edge
    for (Index h = start, n = 1; n <= corners && !at_bad_edge(h); ++n) {
      h = twin[prev[h]];
      if (h < 0 || h == start) return n == corners;
    }
    return false;
  };
  std::vector<std::uint8_t> is_simple(num_vertices);
  parallel_for(num_vertices,
               [&](std::int64_t v) { is_simple[v] = degree[v] == 0 || is_manifold(outgoing[v], degree[v]); });
  if (std::count(is_simple.begin(), is_simple.end(), true) == num_vertices) return;

  const Buckets corners(tail, num_vertices);
  std::vector<bool> seen(count, false);
  for (Index v = 0; v < num_vertices; ++v) {
    if (is_simple[v]) continue;
    Fans fans{v, {}};
    const auto walk = [&](Index start) {
      fans.starts.push_back(start);
      for (Index h = start; h >= 0 && !seen[h]; h = twin[prev[h]]) seen[h] = true;
    };
    for (const Index h : corners[v])
      if (twin[h] < 0) walk(h);
    for (const Index h : corners[v])
      if (!seen[h]) walk(h);
    outgoing[v] = -1;
    nonmanifold_vertices.push_back(std::move(fans));
  }
}

void TopologyBuilder::number_edges(Topology& t, const std::vector<std::vector<Index>>& groups) {
  const auto count = static_cast<std::int64_t>(t.tail_.size());
  t.edge_.resize(count);
  // A half-edge opens a new edge unless its twin or, on a non-manifold edge, an earlier half-edge did.
  std::vector<bool> later;
  if (!groups.empty()) {
    later.assign(count, false);
    for (const auto& group : groups)
      for (size_t i = 1; i < group.size(); ++i) later[group[i]] = true;
  }
  const bool all = later.empty();
  const auto opens = [&](std::int64_t h) {  // no twin, -1, is the largest unsigned number: nothing to branch on
    const Index first = static_cast<std::uint32_t>(t.twin_[h]) > static_cast<std::uint32_t>(h);
    return all || !later[h] ? first : 0;
  };
  std::vector<Index> first_edge(num_blocks(count) + 1, 0);
  parallel_for_blocks(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Index n = 0;
    for (std::int64_t h = begin; h < end; ++h) n += opens(h);
    first_edge[block + 1] = n;
  });
  for (size_t i = 1; i < first_edge.size(); ++i) first_edge[i] += first_edge[i - 1];
  t.edge_half_.resize(first_edge.back());
  parallel_for_blocks(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Index openers[block_size + 1], n = 0;  // listed first: which of them open is as good as random
    for (std::int64_t h = begin; h < end; ++h) {
      openers[n] = static_cast<Index>(h);
      n += opens(h);
    }
    for (Index i = 0, e = first_edge[block]; i < n; ++i, ++e) {
      const Index h = openers[i], other = t.twin_[h];
      t.edge_half_[e] = h;
      t.edge_[h] = e;
      if (other >= 0) t.edge_[other] = e;
    }
  });
  for (const auto& group : groups) {
    for (const Index h : group) t.edge_[h] = t.edge_[group[0]];
    t.nonmanifold_edges_.push_back({t.edge_[group[0]], group});
  }
  std::sort(t.nonmanifold_edges_.begin(), t.nonmanifold_edges_.end(),
            [](const auto& a, const auto& b) { return a.edge < b.edge; });
}

const Topology::NonManifoldEdge* Topology::find_nonmanifold(Edge e) const {
  if (nonmanifold_edges_.empty()) return nullptr;
  const auto at = std::lower_bound(nonmanifold_edges_.begin(), nonmanifold_edges_.end(), index(e),
                                   [](const NonManifoldEdge& a, Index b) { return a.edge < b; });
  return at != nonmanifold_edges_.end() && at->edge == index(e) ? &*at : nullptr;
}

bool Topology::is_nonmanifold(Edge e) const { return find_nonmanifold(e) != nullptr; }

bool Topology::is_boundary(Edge e) const {
  if (exists(twin(half_edge(e)))) return false;
  const NonManifoldEdge* shared = find_nonmanifold(e);
  return !shared || shared->halves.size() == 1;
}

std::vector<HalfEdge> Topology::half_edges(Edge e) const {
  std::vector<HalfEdge> halves{half_edge(e)};
  if (exists(twin(halves[0]))) halves.push_back(twin(halves[0]));
  if (const NonManifoldEdge* shared = find_nonmanifold(e)) {
    halves.clear();
    for (const Index h : shared->halves) halves.push_back(HalfEdge{h});
  }
  return halves;
}

bool Topology::is_boundary(Vertex v) const {
  for (const Edge e : edges(v))
    if (is_boundary(e)) return true;
  return false;
}

std::vector<HalfEdge> Topology::fans(Vertex v) const {
  const Index out = vertex_out_[index(v)];
  std::vector<HalfEdge> starts;
  if (out >= 0) starts.push_back(HalfEdge{out});
  if (out <= first_nonmanifold)
    for (const Index h : nonmanifold_vertices_[first_nonmanifold - out].fans) starts.push_back(HalfEdge{h});
  return starts;
}

std::vector<Edge> Topology::edges(Vertex v) const {
  std::vector<Edge> result;
  const Index out = vertex_out_[index(v)];
  if (out >= 0) {
    HalfEdge h{out};
    for (;;) {
      result.push_back(edge(h));
      const HalfEdge after = ccw(h);
      if (!exists(after)) result.push_back(edge(prev(h)));
      if (!exists(after) || after == HalfEdge{out}) break;
      h = after;
    }
  } else if (out <= first_nonmanifold) {
    for (const Index e : nonmanifold_vertices_[first_nonmanifold - out].edges) result.push_back(Edge{e});
  }
  return result;
}

}  // namespace sublimit
