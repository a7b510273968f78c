// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/interval_mesh.h"

#include <algorithm>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/detail/finer_knots.h"

namespace sublimit {
namespace {

/// One direction: knots without multiple ends, and how its control points lie on a mesh.
struct MeshDirection {
  Knots<double> knots;
  std::vector<double> intervals;  ///< from each row of points to the next
  Index points, first_face;       ///< rows of points of the mesh; of faces before those of the surface

  Index face_rows() const { return static_cast<Index>(intervals.size()); }
  /// The control point of the spline in a row.
  Index number(Index row) const { return knots.is_closed() ? (row + 1) % points : row; }
};

MeshDirection mesh_direction(const Knots<double>& knots, const char* name) {
  constexpr int cubic = 3;
  if (knots.degree() != cubic)
    throw InvalidParameter(
        "a surface of degree " + std::to_string(knots.degree()) + " in " + name +
        " is no mesh with knot intervals; these are of degree 3 (raise the degree of single pieces)");
  const std::span<const double> all = knots.in_domain();
  std::vector<double> breaks{knots.begin()};
  for (const double t : all) {
    if (t < knots.end() && std::count(all.begin(), all.end(), t) > 1)
      throw InvalidParameter("knot " + format_number(t) + " of " + name +
                             " is there more than once: the interval between would be 0; split the surface there, or "
                             "take the knot away");
    if (t > breaks.back()) breaks.push_back(t);
  }
  std::vector<double> lengths;
  for (size_t i = 1; i < breaks.size(); ++i) lengths.push_back(breaks[i] - breaks[i - 1]);
  const auto count = static_cast<Index>(lengths.size());
  if (knots.is_closed()) {
    if (count < 3)
      throw InvalidParameter("a mesh needs three or more faces around; the closed direction " + std::string(name) +
                             " has " + std::to_string(count) + ": insert knots before");
    return {knots, lengths, count, 0};
  }
  const double first = lengths.front(), last = lengths.back(), begin = knots.begin(), end = knots.end();
  Knots<double> unclamped = with_end_knots(knots, {begin - 3 * first, begin - 2 * first, begin - first},
                                           {end + last, end + 2 * last, end + 3 * last});
  lengths.insert(lengths.begin(), first);
  lengths.push_back(last);
  return {std::move(unclamped), lengths, count + 3, 1};
}

}  // namespace

IntervalMesh interval_mesh(const SplineSurface& surface) {
  const MeshDirection u = mesh_direction(surface.u(), "u"), v = mesh_direction(surface.v(), "v");
  const SplineSurface unclamped(u.knots, v.knots);
  const SparseMatrix rows = refinement_matrix(surface, unclamped);
  IntervalMesh result;
  // Rows of the mesh are those of the splines; of a closed one they begin at its second control point.
  SparseMatrix order(u.points * v.points, rows.rows());
  for (Index j = 0; j < v.points; ++j)
    for (Index i = 0; i < u.points; ++i) {
      order.startVec(j * u.points + i);
      order.insertBack(j * u.points + i, v.number(j) * u.points + u.number(i)) = 1;
    }
  order.finalize();
  result.from_points = order * rows;
  Mesh& mesh = result.mesh;
  mesh.positions = Points::Zero(u.points * v.points, 3);
  mesh.boundary = Boundary::none;
  const auto vertex = [&](Index i, Index j) { return j % v.points * u.points + i % u.points; };
  for (Index j = 0; j < v.face_rows(); ++j)
    for (Index i = 0; i < u.face_rows(); ++i) {
      mesh.face_sizes.push_back(4);
      mesh.face_vertices.insert(mesh.face_vertices.end(),
                                {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  for (Index i = 0; i < u.face_rows(); ++i)
    mesh.knot_intervals.push_back({vertex(i, 0), vertex(i + 1, 0), u.intervals[i]});
  for (Index j = 0; j < v.face_rows(); ++j)
    mesh.knot_intervals.push_back({vertex(0, j), vertex(0, j + 1), v.intervals[j]});
  for (Index j = 0; j < surface.v().num_faces(); ++j)
    for (Index i = 0; i < surface.u().num_faces(); ++i)
      result.faces.push_back((j + v.first_face) * u.face_rows() + i + u.first_face);
  return result;
}

}  // namespace sublimit
