// SPDX-License-Identifier: Apache-2.0
#include "sublimit/primvar/vertex_values.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/primvar/linear_scheme.h"
#include "sublimit/scheme/refined_mesh.h"

namespace sublimit {
namespace {

bool are_linear(const Mesh& mesh) { return mesh.attributes == Attributes::linear; }

Scheme<double> linear(const Scheme<double>& scheme) {
  if (!keeps_elements(scheme.steps) || !keeps_elements(scheme.preparation))
    throw InvalidOption("linear attributes are interpolated along edges, which " + scheme.name +
                        " does not keep; use smooth or drop, or a scheme that does: catmull-clark, loop");
  return linear_scheme(scheme);
}

/// Points and faces of a mesh, whose tags mean nothing to linear values.
Mesh without_tags(const Mesh& mesh) {
  Mesh bare;
  bare.positions = mesh.positions;
  bare.face_sizes = mesh.face_sizes;
  bare.face_vertices = mesh.face_vertices;
  return bare;
}

/// Values of up to three columns at places, as points of a surface.
Points evaluated(const LimitMap& surface, const Points& values, std::span<const Place> places) {
  Points result(std::ssize(places), values.cols());
  for (Eigen::Index k = 0; k < values.cols(); k += 3) {
    const Eigen::Index count = std::min<Eigen::Index>(3, values.cols() - k);
    Points three = Points::Zero(values.rows(), 3);
    three.leftCols(count) = values.middleCols(k, count);
    result.middleCols(k, count) = surface.evaluate(three, places).position.leftCols(count);
  }
  return result;
}

}  // namespace

Points refined_vertex_values(const Scheme<double>& scheme, const Mesh& mesh, const std::vector<Level>& levels) {
  Points values = vertex_values(mesh);
  if (values.cols() == 0) return Points(levels.back().topology().num_vertices(), 0);
  if (are_linear(mesh)) return refined_vertex_values(scheme, mesh, static_cast<int>(levels.size()) - 1);
  for (size_t k = 1; k < levels.size(); ++k) values = apply(levels[k].S, values);
  return values;
}

Points refined_vertex_values(const Scheme<double>& scheme, const Mesh& mesh, int levels) {
  const Points values = vertex_values(mesh);
  if (values.cols() == 0) return values;
  return are_linear(mesh) ? Refiner(linear(scheme), without_tags(mesh), levels).points(values)
                          : Refiner(scheme, mesh, levels).points(values);
}

Points limit_vertex_values(const Scheme<double>& scheme, const Mesh& mesh, const LimitMap& surface,
                           std::span<const Place> places) {
  const Points values = vertex_values(mesh);
  if (values.cols() == 0) return Points(std::ssize(places), 0);
  return are_linear(mesh) ? evaluated(LimitMap(linear(scheme), without_tags(mesh)), values, places)
                          : evaluated(surface, values, places);
}

void carry_attributes(const Mesh& control, const std::vector<Level>& levels, const Points& values, Mesh& out) {
  std::vector<Index> faces = control_faces(levels);
  if (std::ssize(faces) != out.num_faces()) {
    const std::vector<bool>& holes = levels.back().holes;
    size_t kept = 0;
    for (size_t f = 0; f < faces.size(); ++f)
      if (!holes[f]) faces[kept++] = faces[f];
    faces.resize(kept);
  }
  carry_faces(control, faces, out);
  set_vertex_values(out, control, values);
}

}  // namespace sublimit
