// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/info_job.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/rule_of_word.h"
#include "sublimit/stencils/jobs/detail/mesh_info_json.h"

namespace sublimit {
namespace {

using Int = std::int64_t;
using Pair = std::array<Int, 2>;

std::vector<std::vector<Pair>> batches(const Ranks& ranks) {
  return std::vector<std::vector<Pair>>(size_t(ranks.size()));
}

/// Of all ranks together.
SpreadInfo::Histogram sum(const Ranks& ranks, const SpreadInfo::Histogram& own) {
  const std::vector<Pair> pairs = [&] {
    std::vector<Pair> all;
    for (const auto& [key, count] : own) all.push_back({key, count});
    return all;
  }();
  SpreadInfo::Histogram result;
  for (const auto& from : exchange(ranks, std::vector<std::vector<Pair>>(size_t(ranks.size()), pairs)))
    for (const auto& [key, count] : from) result[key] += count;
  return result;
}

SpreadInfo::Extent extent(const Ranks& ranks, Int own) { return {-ranks.largest(-own), ranks.largest(own)}; }

/// Vertices of owned faces, and whether the first face at each is owned: then this rank counts it.
struct OwnVertices {
  std::vector<char> is_own, counts;
  std::vector<char> is_shared;  ///< with faces that are not owned
};
OwnVertices own_vertices(const MeshPart& part, const Topology& t) {
  const auto count = size_t(t.num_vertices());
  OwnVertices own{std::vector<char>(count, false), std::vector<char>(count, false), std::vector<char>(count, false)};
  std::vector<char> seen(count, false);
  for (Index f = 0; f < t.num_faces(); ++f)
    for (const Index v : t.vertices(Face{f})) {
      const auto i = size_t(v);
      if (part.is_owned[size_t(f)]) own.is_own[i] = true;
      if (!seen[i]) own.counts[i] = part.is_owned[size_t(f)];
      if (!part.is_owned[size_t(f)]) own.is_shared[i] = true;
      seen[i] = true;
    }
  for (size_t i = 0; i < count; ++i) own.is_shared[i] = own.is_shared[i] && own.is_own[i];
  return own;
}

void count_vertices_and_edges(const Ranks& ranks, const MeshPart& part, const Topology& t, const OwnVertices& own,
                              SpreadInfo& info) {
  SpreadInfo::Histogram interior, boundary;
  Int vertices = 0, edges = 0;
  for (Index i = 0; i < t.num_vertices(); ++i) {
    const Vertex v{i};
    if (!own.counts[size_t(i)]) continue;
    vertices += t.is_nonmanifold(v);
    const HalfEdge h = t.outgoing(v);
    if (exists(h)) ++(exists(t.twin(h)) ? interior : boundary)[std::ssize(t.edges(v))];
  }
  for (Index e = 0; e < t.num_edges(); ++e)
    edges += t.is_nonmanifold(Edge{e}) && part.is_owned[size_t(index(t.face(t.half_edge(Edge{e}))))];
  info.interior_valences = sum(ranks, interior), info.boundary_valences = sum(ranks, boundary);
  info.nonmanifold_vertices = ranks.sum(vertices), info.nonmanifold_edges = ranks.sum(edges);
}

/// Groups of vertices that edges of faces join: each rank joins what its own faces do, and groups take the least label
/// that is known of any of their vertices, until none changes.
Int num_components(const Ranks& ranks, const Runs& vertices, const MeshPart& part, const Topology& t,
                   const OwnVertices& own) {
  std::vector<Index> root(part.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index v) {
    while (root[size_t(v)] != v) v = root[size_t(v)] = root[size_t(root[size_t(v)])];
    return v;
  };
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (!part.is_owned[size_t(f)]) continue;
    const std::span<const Index> corners = t.vertices(Face{f});
    for (const Index v : corners) {
      const auto [low, high] = std::minmax({find(v), find(corners[0])});
      root[size_t(high)] = low;
    }
  }
  std::vector<Int> label = part.vertices;  // of the roots, which are the least of their group
  std::vector<Index> shared;
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (own.is_shared[size_t(v)]) shared.push_back(v);
  for (bool changed = true; changed;) {
    auto to = batches(ranks);
    for (const Index v : shared) {
      const Int vertex = part.vertices[size_t(v)];
      to[size_t(vertices.rank_of(vertex))].push_back({vertex, label[size_t(find(v))]});
    }
    std::vector<std::vector<Pair>> at_home = exchange(ranks, std::move(to));
    std::vector<Pair> all;
    for (const auto& from : at_home) all.insert(all.end(), from.begin(), from.end());
    std::ranges::sort(all);  // the least label of each vertex first
    for (auto& from : at_home)
      for (Pair& pair : from) pair[1] = (*std::ranges::lower_bound(all, Pair{pair[0], 0}))[1];
    at_home = exchange(ranks, std::move(at_home));
    bool own_changed = false;
    std::vector<size_t> next(at_home.size(), 0);
    for (const Index v : shared) {
      const auto home = size_t(vertices.rank_of(part.vertices[size_t(v)]));
      Int& known = label[size_t(find(v))];
      const Int least = at_home[home][next[home]++][1];
      own_changed |= least < known;
      known = std::min(known, least);
    }
    changed = !ranks.all(!own_changed);
  }
  auto to = batches(ranks);
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (own.is_own[size_t(v)] && find(v) == v)
      to[size_t(vertices.rank_of(label[size_t(v)]))].push_back({label[size_t(v)], 0});
  std::vector<Int> labels;
  for (const auto& from : exchange(ranks, std::move(to)))
    for (const Pair& pair : from) labels.push_back(pair[0]);
  sort_unique(labels);
  return ranks.sum(std::ssize(labels));
}

/// Closed walks along half-edges without a twin: cycles of a permutation. Each half-edge finds the least number on its
/// cycle, looking twice as far ahead in every round.
Int num_boundary_loops(const Ranks& ranks, const SpreadMesh& mesh, const MeshPart& part, const Topology& t) {
  // Half-edges of the whole have the numbers of their faces' corners.
  const Runs corners(ranks, std::ssize(mesh.face_vertices));
  std::vector<Int> first{corners.begin(ranks.rank())};
  for (const std::int32_t size : mesh.face_sizes) first.push_back(first.back() + size);
  const auto firsts = fetch<Int>(ranks, mesh.faces, part.faces,
                                 [&](Int f) { return first[size_t(f - mesh.faces.begin(ranks.rank()))]; });
  const auto number = [&](HalfEdge h) { return firsts[size_t(index(t.face(h)))] + t.corner_index(h); };
  auto to = batches(ranks);
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    HalfEdge h{i};
    if (exists(t.twin(h)) || !part.is_owned[size_t(index(t.face(h)))]) continue;
    const Int from = number(h);
    h = t.next(h);  // on to the next half-edge without twin around the head
    while (exists(t.twin(h))) h = t.next(t.twin(h));
    to[size_t(corners.rank_of(from))].push_back({from, number(h)});
  }
  struct Walk {
    Int number = 0, ahead = 0, least = 0;
  };
  std::vector<Walk> walks;
  for (const auto& from : exchange(ranks, std::move(to)))
    for (const auto& [begin, end] : from) walks.push_back({begin, end, begin});
  std::ranges::sort(walks, {}, &Walk::number);
  const Int count = ranks.sum(std::ssize(walks));
  for (Int seen = 1; seen < count; seen *= 2) {
    std::vector<Int> ahead;
    for (const Walk& walk : walks) ahead.push_back(walk.ahead);
    const auto found = fetch<Pair>(ranks, corners, ahead, [&](Int n) {
      const Walk& walk = *std::ranges::lower_bound(walks, n, {}, &Walk::number);
      return Pair{walk.ahead, walk.least};
    });
    for (size_t i = 0; i < walks.size(); ++i) {
      walks[i].ahead = found[i][0];
      walks[i].least = std::min(walks[i].least, found[i][1]);
    }
  }
  return ranks.sum(Int{std::ranges::count_if(walks, [](const Walk& walk) { return walk.number == walk.least; })});
}

/// What the mesh and its incidence take of this rank, about.
double run_bytes(const SpreadJob& job) {
  const double corners = double(job.mesh.face_vertices.size()), faces = double(job.mesh.face_sizes.size()),
               vertices = double(job.mesh.positions.rows());
  return 24 * vertices + 8 * corners + 4 * faces +  // as read
         8 * (vertices + double(job.incidence.faces.items.size())) +
         8 * (faces + double(job.incidence.neighbours.items.size())) + 9 * faces;
}

SpreadInfo::Histogram sizes_of(const SpreadMesh& mesh) {
  SpreadInfo::Histogram sizes;
  for (const std::int32_t size : mesh.face_sizes) ++sizes[size];
  return sizes;
}

nlohmann::ordered_json json_of(const SpreadInfo::Extent& extent) {
  return {{"least", extent.least}, {"most", extent.most}};
}

}  // namespace

SpreadInfo spread_info(const Ranks& ranks, const MeshRequest& request, SpreadMesh mesh, const std::string& name,
                       const Told& told) {
  SpreadInfo info;
  info.face_sizes = sum(ranks, sizes_of(mesh));
  std::optional<Scheme<double>> scheme;
  MeshRequest counted = request;  // with a scheme that takes any mesh
  counted.scheme = "catmull-clark", counted.options = {};
  ranks.together([&] {
    if (request.scheme.empty()) return;
    scheme = scheme_job(request).scheme.value();
    info.scheme = scheme->name;
    info.triangles = scheme->face_size() == 3;
    if (info.triangles && (info.face_sizes.size() > 1 || (!info.face_sizes.empty() && !info.face_sizes.count(3))))
      info.why_not =
          "faces have other sizes than three; this scheme takes triangles only: triangulate the mesh or use "
          "a scheme for polygons, catmull-clark for one";
    else
      counted.scheme = request.scheme, counted.options = request.options;
  });
  const SpreadJob job = spread_job(ranks, counted, std::move(mesh), name);
  if (scheme && info.why_not.empty()) scheme = job.scheme;  // with the options that tags ask for
  told("dividing");
  info.parts = ranks.size();
  info.rings = 1;
  ranks.together([&] {
    if (scheme) info.rings = shard_rings(*std::make_unique<Patterns>(*scheme), job.creasing);
  });
  const MeshPart part =
      gather_part(ranks, job.mesh, job.incidence, owned_faces(ranks, job.mesh, divided(ranks, job, {}), info.parts)[0],
                  info.rings, false);
  told("counting");
  Topology t;
  OwnVertices own;
  bool takes = true;
  double bytes = run_bytes(job);
  ranks.together([&] {
    t = Topology(view(part.mesh));
    own = own_vertices(part, t);
    bytes += predicted_bytes(job.scheme, t, 0);
    if (!scheme || !info.why_not.empty()) return;
    try {
      control_level(*scheme, part.mesh, job.rules);  // refuses tags that the scheme has no rule for
    } catch (const UnsupportedTopology&) {
      takes = false;  // the message is about numbers of the part
    }
  });
  if (!ranks.all(takes))
    info.why_not =
        "it has no rule for some of the tags; remove them (--no-creases), make sharpness inside 10, or use a "
        "scheme with semi-sharp creases: catmull-clark or loop";
  const Int owned = std::ranges::count(part.is_owned, true);
  info.part_faces = extent(ranks, owned);
  info.halo_faces = extent(ranks, std::ssize(part.faces) - owned);
  info.part_bytes = extent(ranks, static_cast<Int>(bytes));

  info.vertices = job.mesh.vertices.size(), info.faces = job.mesh.faces.size();
  info.edges = ranks.sum(std::accumulate(job.incidence.own_sides.begin(), job.incidence.own_sides.end(), Int{0}));
  info.euler_characteristic = info.vertices - info.edges + info.faces;
  info.isolated_vertices = ranks.sum(std::ssize(job.incidence.isolated));
  count_vertices_and_edges(ranks, part, t, own, info);
  info.components = num_components(ranks, job.mesh.vertices, part, t, own);
  info.boundary_loops = num_boundary_loops(ranks, job.mesh, part, t);
  for (const auto& [size, count] : info.face_sizes)
    info.addresses += info.triangles || size == 4 ? count : size * count;
  info.creases = ranks.sum(std::ssize(job.mesh.creases));
  info.corners = ranks.sum(std::ssize(job.mesh.corners));
  info.holes = ranks.sum(std::ssize(job.mesh.holes));
  const Mesh& about = job.mesh.about;
  info.boundary = word(job.rules.boundary.value_or(about.boundary.value_or(Boundary::edge_and_corner)));
  info.creasing = word(job.creasing);
  info.smooth_triangles = word(about.triangles.value_or(Triangles::catmark));
  info.warnings = about.warnings;
  return info;
}

nlohmann::ordered_json to_json(const SpreadInfo& info, const std::string& name) {
  nlohmann::ordered_json json = json_of_counts(info, name);
  json["isolated_vertices"] = info.isolated_vertices;
  json["nonmanifold_vertices"] = info.nonmanifold_vertices;
  json["nonmanifold_edges"] = info.nonmanifold_edges;
  json["warnings"] = info.warnings;
  if (!info.scheme.empty())
    json["scheme"] = {{"name", info.scheme}, {"takes_mesh", info.why_not.empty() ? "yes" : "no: " + info.why_not}};
  json["parts"] = {{"count", info.parts},
                   {"rings", info.rings},
                   {"faces", json_of(info.part_faces)},
                   {"halo_faces", json_of(info.halo_faces)},
                   {"bytes", json_of(info.part_bytes)}};
  return json;
}

}  // namespace sublimit
