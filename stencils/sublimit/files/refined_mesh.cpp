// SPDX-License-Identifier: Apache-2.0
#include "sublimit/files/refined_mesh.h"

#include "sublimit/base/error.h"

namespace sublimit {

RemainingTags remaining_tags(const Level& level, const ControlMesh& control, const SubdivisionOptions& options) {
  const Topology& t = level.topology();
  RemainingTags left;
  left.boundary = options.boundary.value_or(control.boundary.value_or(Boundary::edge_and_corner));
  if (left.boundary == Boundary::none) left.boundary = Boundary::edge_only;
  const Sharpness implied = initial_sharpness(t, {}, left.boundary, level.sharpness.creasing);
  for (Index e = 0; e < t.num_edges(); ++e)
    if (level.sharpness.edge[e] > implied.edge[e]) left.creases.push_back(Edge{e});
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (level.sharpness.vertex[v] > implied.vertex[v]) left.corners.push_back(Vertex{v});
  return left;
}

MeshOutput refined_mesh(const Level& level, const Points& points, const ControlMesh& control,
                        const SubdivisionOptions& options, bool tags) {
  const Topology& t = level.topology();
  MeshOutput out;
  out.positions = points;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const auto corners = t.vertices(Face{f});
    out.face_sizes.push_back(t.size(Face{f}));
    out.face_vertices.insert(out.face_vertices.end(), corners.begin(), corners.end());
  }
  if (!tags) return out;
  const RemainingTags left = remaining_tags(level, control, options);
  out.boundary = left.boundary;
  if (level.sharpness.creasing == Creasing::chaikin) out.creasing = Creasing::chaikin;
  if (level.number == 0) out.triangles = control.triangles;
  for (Index f = 0; f < t.num_faces(); ++f)
    if (level.holes[f]) out.holes.push_back(f);
  for (const Edge e : left.creases)
    out.creases.push_back({index(t.tail(e)), index(t.head(e)), level.sharpness.edge[index(e)]});
  for (Index i = 0; i < t.num_edges() && !level.intervals.empty(); ++i) {
    const Index tail = index(t.tail(Edge{i})), head = index(t.head(Edge{i}));
    const size_t entry = knot_entry(level.intervals.owner, t, t.half_edge(Edge{i}));
    out.knot_intervals.push_back({tail, head, level.intervals.length[entry]});
    if (level.intervals.owner == KnotOwner::point)
      out.knot_intervals.push_back({head, tail, level.intervals.length[other_end(entry)]});
  }
  for (const Vertex v : left.corners) out.corners.push_back({index(v), level.sharpness.vertex[index(v)]});
  return out;
}

MeshOutput limit_mesh(const Level& level, const LimitMatrices& limit, const LimitPoints& points, Normals normals) {
  const Topology& t = level.topology();
  MeshOutput out;
  out.positions = points.position;
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (level.holes[f]) continue;
    out.face_sizes.push_back(t.size(Face{f}));
    for (Index k = 0; k < t.size(Face{f}); ++k) {
      const HalfEdge h = t.corner(Face{f}, k);
      out.face_vertices.push_back(index(t.tail(h)));
      const Index side = limit.corner_side[index(h)];
      if (normals == Normals::per_corner) out.face_normals.push_back(points.normal.row(side).isZero() ? -1 : side);
    }
  }
  if (normals == Normals::per_corner) out.normals = points.normal;
  if (normals == Normals::per_vertex) {
    out.normals = Points::Zero(t.num_vertices(), 3);
    for (size_t s = 0; s < limit.side_vertex.size(); ++s)
      out.normals.row(limit.side_vertex[s]) += points.normal.row(Index(s));
    for (Index v = 0; v < t.num_vertices(); ++v)
      if (out.normals.row(v).norm() > 1e-12) out.normals.row(v).normalize();
  }
  return out;
}

void add_channel(MeshOutput& out, const FaceVaryingLevel& channel, const std::string& name, const Points& values) {
  const Topology& t = channel.level.topology();
  const bool all = std::ssize(out.face_sizes) == t.num_faces();
  ControlMesh::FaceVarying written{.name = name, .values = values, .indices = {}};
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (!all && channel.level.holes[f]) continue;
    const auto corners = t.vertices(Face{f});
    written.indices.insert(written.indices.end(), corners.begin(), corners.end());
  }
  if (written.indices.size() != out.face_vertices.size())
    throw InvalidParameter("channel '" + name +
                           "' is of another level than the mesh: " + std::to_string(written.indices.size()) +
                           " corners, not " + std::to_string(out.face_vertices.size()));
  out.face_varying.push_back(std::move(written));
}

}  // namespace sublimit
