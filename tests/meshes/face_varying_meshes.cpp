// SPDX-License-Identifier: Apache-2.0
#include "meshes/face_varying_meshes.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "peers/compare_with_opensubdiv.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/primvar/face_varying.h"

namespace sublimit::testing {
namespace {

std::pair<Index, Index> edge(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

Mesh with_channel(Mesh mesh, const Seams& seams, const std::vector<Index>& joined, unsigned seed) {
  const Topology t(view(mesh));
  std::set<std::pair<Index, Index>> cut;
  for (const auto& [a, b] : seams) cut.insert(edge(a, b));
  std::vector<Index> root(t.num_half_edges());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const auto unite = [&](HalfEdge a, HalfEdge b) {
    const Index p = find(index(a)), q = find(index(b));
    root[std::max(p, q)] = std::min(p, q);
  };
  const auto corner_at = [&](HalfEdge h, Vertex v) { return t.tail(h) == v ? h : t.next(h); };
  for (Index e = 0; e < t.num_edges(); ++e) {
    const Vertex a = t.tail(Edge{e}), b = t.head(Edge{e});
    if (cut.contains(edge(index(a), index(b)))) continue;
    const std::vector<HalfEdge> halves = t.half_edges(Edge{e});
    for (const HalfEdge h : halves)
      for (const Vertex v : {a, b}) unite(corner_at(h, v), corner_at(halves[0], v));
  }
  for (const Index v : joined) {
    const std::vector<HalfEdge> fans = t.fans(Vertex{v});
    for (const HalfEdge start : fans) {
      HalfEdge h = start;
      do {
        unite(h, fans[0]);
        h = t.ccw(h);
      } while (exists(h) && h != start);
    }
  }
  Mesh::FaceVarying channel{.name = "uv", .values = {}, .indices = {}};
  std::vector<Index> number(root.size(), -1);
  Index count = 0;
  for (Index h = 0; h < t.num_half_edges(); ++h) {
    Index& value = number[find(h)];
    if (value < 0) value = count++;
    channel.indices.push_back(value);
  }
  std::mt19937 random(seed);
  channel.values.resize(count, 2);
  for (Eigen::Index i = 0; i < channel.values.size(); ++i)
    channel.values.data()[i] = double(random()) / double(std::mt19937::max());
  mesh.face_varying = {channel};
  return mesh;
}

Mesh with_random_channel(Mesh mesh, double probability, unsigned seed) {
  const Topology t(view(mesh));
  std::mt19937 random(seed);
  const auto happens = [&](double p) { return double(random()) < p * double(std::mt19937::max()); };
  Seams seams;
  std::vector<Index> joined;
  for (Index e = 0; e < t.num_edges(); ++e)
    if (happens(probability)) seams.push_back({index(t.tail(Edge{e})), index(t.head(Edge{e}))});
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (happens(0.1)) joined.push_back(v);
  return with_channel(std::move(mesh), seams, joined, seed);
}

Mesh without_turns(Mesh mesh) {
  const Topology t(view(mesh));
  Mesh::FaceVarying& channel = mesh.face_varying.at(0);
  const auto take_turns = [](const std::vector<Index>& values) {  // is there a subsequence a b a b?
    for (const Index a : values)
      for (const Index b : values) {
        int steps = 0;
        for (const Index v : values) steps += v == (steps % 2 ? b : a) && a != b;
        if (steps >= 4) return true;
      }
    return false;
  };
  std::vector<Index> sources;  // of new values
  for (Index v = 0; v < t.num_vertices(); ++v) {
    std::vector<HalfEdge> corners;
    for (const HalfEdge start : t.fans(Vertex{v})) {
      HalfEdge h = start;
      do {
        corners.push_back(h);
        h = t.ccw(h);
      } while (exists(h) && h != start);
    }
    const bool manifold = !t.is_nonmanifold(Vertex{v});
    if (!manifold) std::sort(corners.begin(), corners.end());  // OpenSubdiv meets them face by face
    std::vector<Index> values;
    for (const HalfEdge h : corners) values.push_back(channel.indices[index(h)]);
    if (!take_turns(values)) continue;
    for (size_t i = 0; i < corners.size(); ++i) {
      const bool goes_on = manifold && i > 0 && values[i] == values[i - 1];
      if (!goes_on) sources.push_back(values[i]);
      channel.indices[index(corners[i])] = static_cast<Index>(channel.values.rows() + std::ssize(sources)) - 1;
    }
    if (manifold && values.front() == values.back() && t.ccw(corners.back()) == corners.front()) {
      const Index first = channel.indices[index(corners.front())], last = channel.indices[index(corners.back())];
      for (const HalfEdge h : corners)
        if (channel.indices[index(h)] == last) channel.indices[index(h)] = first;
    }
  }
  Points values(channel.values.rows() + std::ssize(sources), channel.values.cols());
  values.topRows(channel.values.rows()) = channel.values;
  for (size_t i = 0; i < sources.size(); ++i)
    values.row(channel.values.rows() + Index(i)) = channel.values.row(sources[i]);
  channel.values = std::move(values);
  return mesh;
}

const char* name(FaceVaryingInterpolation interpolation) {
  constexpr const char* names[] = {"none", "corners_only", "corners_plus1", "corners_plus2", "boundaries", "all"};
  return names[static_cast<int>(interpolation)];
}

ChannelComparison compare_channel_with_opensubdiv(const Mesh& mesh, const std::string& scheme_name,
                                                  FaceVaryingInterpolation interpolation, int levels) {
  ReferenceOptions options = reference_options(mesh, scheme_name, levels);
  options.face_varying = interpolation;
  const std::vector<ReferenceLevel> expected = reference_refine(mesh, options);
  const Scheme<double> scheme = scheme_for(mesh, scheme_name);
  const std::vector<Level> refined = refine(scheme, mesh, levels);
  const Mesh::FaceVarying& channel = mesh.face_varying.at(0);
  const std::vector<FaceVaryingLevel> ours = refine_face_varying(scheme, interpolation, channel, refined);
  const double range = (channel.values.colwise().maxCoeff() - channel.values.colwise().minCoeff()).maxCoeff();

  ChannelComparison result;
  Points values = control_values(ours[0], channel.values);
  std::vector<Index> face_map(mesh.num_faces());
  std::iota(face_map.begin(), face_map.end(), 0);
  for (int k = 0; k <= levels; ++k) {
    const ReferenceLevel& theirs = expected[k];
    if (k > 0) values = apply(ours[k].level.S, values);
    const Topology& t = ours[k].level.topology();
    std::vector<Index> first_corner{0}, theirs_of(t.num_vertices(), -1), ours_of(theirs.values.rows(), -1);
    for (const Index size : theirs.face_sizes) first_corner.push_back(first_corner.back() + size);
    for (Index f = 0; f < t.num_faces(); ++f)
      for (Index i = 0; i < t.size(Face{f}); ++i) {
        const Index own = t.vertices(Face{f})[i], other = theirs.corner_value[first_corner[face_map[f]] + i];
        const double error = (values.row(own) - theirs.values.row(other)).cwiseAbs().maxCoeff() / range;
        result.error = std::max(result.error, error);
        if (k == 0) continue;  // values of several vertices are one there
        if (theirs_of[own] < 0) theirs_of[own] = other;
        if (ours_of[other] < 0) ours_of[other] = own;
        if (theirs_of[own] != other || ours_of[other] != own)
          result.mismatch = "level " + std::to_string(k) + ": corner " + std::to_string(i) + " of face " +
                            std::to_string(f) + " shares its value with others";
      }
    if (k == levels) break;
    std::vector<Index> children;
    for (Index f = 0; f < t.num_faces(); ++f)
      for (Index c = theirs.child_face_offsets[face_map[f]]; c < theirs.child_face_offsets[face_map[f] + 1]; ++c)
        children.push_back(theirs.child_faces[c]);
    face_map = std::move(children);
  }
  return result;
}

}  // namespace sublimit::testing
