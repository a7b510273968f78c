// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/tessellation_mesh.h"

#include <Eigen/Dense>

#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/primvar/vertex_values.h"
#include "sublimit/tessellation/detail/corner_values.h"

namespace sublimit {
namespace {

/// Of a triangle with an area; else any.
Eigen::RowVector3d flat_normal(const Tessellation& made, const Tessellation::Triangle& t) {
  const auto at = [&](size_t k) { return Eigen::Vector3d(made.points.row(t.vertices[k])); };
  const Eigen::Vector3d cross = (at(1) - at(0)).cross(at(2) - at(0));
  return cross.norm() > 0 ? Eigen::RowVector3d(cross.normalized()) : Eigen::RowVector3d(0, 0, 1);
}

/// In the face of its triangle.
Place place_of_corner(const Tessellation& made, Index corner) {
  const Tessellation::Triangle& t = made.triangles[size_t(corner / 3)];
  const auto& [u, v] = t.uv[size_t(corner % 3)];
  return {t.face, u, v};
}

}  // namespace

Mesh tessellation_mesh(const Tessellation& made) {
  Mesh out;
  out.positions = made.points;
  out.face_sizes.assign(made.triangles.size(), 3);
  for (const Tessellation::Triangle& t : made.triangles)
    out.face_vertices.insert(out.face_vertices.end(), t.vertices.begin(), t.vertices.end());
  return out;
}

Mesh tessellation_mesh(const Tessellation& made, const Addresses& addresses) {
  Mesh out = tessellation_mesh(made);
  for (const Tessellation::Triangle& t : made.triangles) out.face_ids.push_back(index(addresses.place(t.face).face));
  return out;
}

void carry_attributes(const Scheme<double>& scheme, const Mesh& control, const LimitMap& surface,
                      const Tessellation& made, Mesh& out) {
  if (has_face_attributes(control)) {
    std::vector<Index> faces;
    for (const Tessellation::Triangle& t : made.triangles)
      faces.push_back(index(surface.addresses().place(t.face).face));
    carry_faces(control, faces, out);
  }
  set_vertex_values(out, control, limit_vertex_values(scheme, control, surface, made.places));
}

std::vector<Place> corner_places(const Tessellation& made) {
  std::vector<Place> at;
  at.reserve(3 * made.triangles.size());
  for (Index c = 0; c < std::ssize(made.triangles) * 3; ++c) at.push_back(place_of_corner(made, c));
  return at;
}

void add_normals(Mesh& out, const Tessellation& made, Points normals, bool complete) {
  out.normals = std::move(normals);
  for (Index i = 0; i < out.normals.rows(); ++i) {
    const bool none = out.normals.row(i).isZero(0);
    if (none && complete) out.normals.row(i) = flat_normal(made, made.triangles[size_t(i) / 3]);
    out.face_normals.push_back(none && !complete ? -1 : i);
  }
}

std::vector<Place> places_of(const SplitMesh& split, const Tessellation& made) {
  std::vector<Place> places;
  places.reserve(split.sources.size());
  for (size_t k = 0; k < split.sources.size(); ++k)
    places.push_back(split.sides[k] < 0 ? made.places[size_t(split.sources[k])]
                                        : place_of_corner(made, split.sides[k]));
  return places;
}

void add_channel(Mesh& out, const Tessellation& made, const Scheme<double>& scheme,
                 FaceVaryingInterpolation interpolation, const Mesh::FaceVarying& given, const Level& control) {
  FaceVaryingLevel channel = control_face_varying(scheme, interpolation, given, control);
  const Points values = control_values(channel, given.values);
  if (values.cols() > 3) throw InvalidOption("a channel of more than 3 columns has no room as texture coordinates");
  Points three = Points::Zero(values.rows(), 3);  // as points of a surface
  three.leftCols(values.cols()) = values;
  const LimitMap surface(face_varying_scheme(scheme, interpolation), std::move(channel.level));
  CornerValues corners = corner_values(made, surface);
  const Points limit = surface.evaluate(three, corners.places).position;
  out.face_varying.push_back({given.name, limit.leftCols(values.cols()), std::move(corners.indices)});
}

}  // namespace sublimit
