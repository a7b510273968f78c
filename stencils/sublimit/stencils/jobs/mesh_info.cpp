// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/jobs/mesh_info.h"

#include <numeric>

#include "sublimit/base/error.h"
#include "sublimit/source/address.h"
#include "sublimit/stencils/formats/rule_of_word.h"
#include "sublimit/stencils/jobs/detail/mesh_info_json.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit {
namespace {

using Json = nlohmann::ordered_json;

/// Groups of vertices that edges join (isolated ones left out).
Index num_components(const Topology& t) {
  std::vector<Index> root(t.num_vertices());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (Index e = 0; e < t.num_edges(); ++e) root[find(index(t.tail(Edge{e})))] = find(index(t.head(Edge{e})));
  Index count = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) count += root[v] == v && !t.is_isolated(Vertex{v});
  return count;
}

/// Closed walks along boundary half-edges.
Index num_boundary_loops(const Topology& t) {
  std::vector<bool> seen(t.num_half_edges(), false);
  Index loops = 0;
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    if (seen[i] || exists(t.twin(HalfEdge{i}))) continue;
    ++loops;
    HalfEdge h{i};
    while (!seen[index(h)]) {
      seen[index(h)] = true;
      h = t.next(h);  // on to the next half-edge without twin around the head
      while (exists(t.twin(h))) h = t.next(t.twin(h));
    }
  }
  return loops;
}

/// The rule in force: as asked for, else the file's tag, else the default.
template <class Rule>
std::string in_force(std::optional<Rule> asked, std::optional<Rule> tag, Rule otherwise) {
  return word(asked.value_or(tag.value_or(otherwise)));
}

/// Rows of a 3 x 3 matrix, or the numbers of a vector.
template <class Matrix>
Json numbers(const Matrix& m) {
  if constexpr (Matrix::ColsAtCompileTime == 1) {
    return {m[0], m[1], m[2]};
  } else {
    Json rows = Json::array();
    for (int i = 0; i < 3; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2)});
    return rows;
  }
}

}  // namespace

Json to_json(const LimitIntegrals& limit) {
  Json json{{"area", limit.area},
            {"area_error", limit.area_error},
            {"centroid", limit.centroid ? numbers(*limit.centroid) : Json()},
            {"centroid_error", limit.centroid_error},
            {"has_solid", limit.why_no_solid.empty() ? "yes" : "no: " + limit.why_no_solid},
            {"solid", Json()}};
  if (limit.solid)
    json["solid"] = {{"volume", limit.solid->volume},
                     {"volume_error", limit.solid->volume_error},
                     {"centroid", numbers(limit.solid->centroid)},
                     {"centroid_error", limit.solid->centroid_error},
                     {"inertia", numbers(limit.solid->inertia)},
                     {"inertia_error", limit.solid->inertia_error}};
  return json;
}

LimitIntegrals limit_integrals(const MeshJob& job) {
  if (!job.scheme) throw InvalidOption("integrals are of the limit of a scheme; name one");
  return limit_integrals(LimitMap(*job.scheme, job.mesh, job.rules), job.mesh.positions);
}

MeshInfo mesh_info(const MeshJob& job, bool triangles) {
  const Mesh& mesh = job.mesh;
  const Topology t(view(mesh));
  MeshInfo info;
  info.vertices = t.num_vertices();
  info.edges = t.num_edges();
  info.faces = t.num_faces();
  info.euler_characteristic = info.vertices - info.edges + info.faces;
  info.components = num_components(t);
  info.boundary_loops = num_boundary_loops(t);
  for (Index f = 0; f < t.num_faces(); ++f) ++info.face_sizes[t.size(Face{f})];
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const HalfEdge h = t.outgoing(Vertex{v});
    if (!exists(h)) continue;
    ++(exists(t.twin(h)) ? info.interior_valences : info.boundary_valences)[Index(t.edges(Vertex{v}).size())];
  }
  info.triangles = triangles || (job.scheme && job.scheme->face_size() == 3);
  info.addresses = Addresses(t, info.triangles).size();
  info.creases = static_cast<Index>(mesh.creases.size());
  info.corners = static_cast<Index>(mesh.corners.size());
  info.holes = static_cast<Index>(mesh.holes.size());
  info.boundary = in_force(job.rules.boundary, mesh.boundary, Boundary::edge_and_corner);
  info.creasing = in_force(job.rules.creasing, mesh.creasing, Creasing::uniform);
  info.smooth_triangles = in_force({}, mesh.triangles, Triangles::catmark);
  info.face_varying = word(job.face_varying);
  for (const Mesh::FaceVarying& channel : mesh.face_varying)
    info.channels.push_back({channel.name, Index(channel.values.rows()), Index(channel.values.cols())});
  info.warnings = mesh.warnings;
  for (const Topology::Fault& fault : t.faults()) info.faults.push_back(fault.message);
  if (!job.scheme) return info;
  info.scheme = job.scheme->name;
  try {
    control_level(*job.scheme, mesh, job.rules);  // refuses tags that the scheme has no rule for
    if (job.scheme->face_size() == 3) check_triangles(t);
    for (int level = 1; level <= 6; ++level) info.predicted_bytes.push_back(predicted_bytes(*job.scheme, t, level));
  } catch (const UnsupportedTopology& error) {
    info.why_not = error.what();
  }
  return info;
}

Json to_json(const MeshInfo& info, const std::string& name) {
  Json json = json_of_counts(info, name);
  json["face_varying_channels"] = info.channels.size();
  json["face_varying"] = info.face_varying;
  json["warnings"] = info.warnings;
  json["faults"] = info.faults;
  if (!info.scheme.empty())
    json["scheme"] = {{"name", info.scheme},
                      {"takes_mesh", info.why_not.empty() ? "yes" : "no: " + info.why_not},
                      {"predicted_bytes_by_level", info.predicted_bytes}};
  if (info.limit) json["limit"] = to_json(*info.limit);
  return json;
}

}  // namespace sublimit
