// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/level_files.h"

#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/primvar/vertex_values.h"

namespace sublimit {

Mesh without_tags(Mesh mesh) {
  Mesh bare;
  carry_faces(mesh, bare);
  bare.positions.swap(mesh.positions);
  bare.face_sizes = std::move(mesh.face_sizes);
  bare.face_vertices = std::move(mesh.face_vertices);
  bare.face_varying = std::move(mesh.face_varying);
  bare.vertex_values = std::move(mesh.vertex_values);
  bare.warnings = std::move(mesh.warnings);
  return bare;
}

Mesh level_output(const Level& level, const Points& points, const Mesh& control, const SubdivisionOptions& options,
                  bool tags) {
  Mesh mesh = level_mesh(level, points, control, options);
  return tags ? mesh : without_tags(std::move(mesh));
}

Mesh limit_mesh(const Level& level, const LimitMatrices& limit, const LimitPoints& points, Normals normals) {
  const Topology& t = level.topology();
  Mesh out;
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

void add_channel(Mesh& out, const FaceVaryingLevel& channel, const std::string& name, const Points& values) {
  const Topology& t = channel.level.topology();
  const bool all = std::ssize(out.face_sizes) == t.num_faces();
  Mesh::FaceVarying written{.name = name, .values = values, .indices = {}};
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
