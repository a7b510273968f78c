// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/normal_mesh.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/geometric/edge_cubic.h"

namespace sublimit {
namespace {

/// Sine of the angle between an edge and a normal at its end; length of the sum of the normals of its ends.
constexpr double least_sine = 1e-12, least_sum = 1e-9;

/// Triangles of vertices that are there and have a place.
void check_triangles(const NormalMesh& mesh) {
  if (mesh.triangles.empty()) throw InvalidMesh("there are no faces; triangles are needed");
  if (mesh.triangles.size() % 3 != 0)
    throw InvalidMesh(format_number(mesh.triangles.size()) + " corners are no whole number of triangles");
  for (const Index v : mesh.triangles) {
    if (v < 0 || v >= mesh.num_vertices())
      throw InvalidMesh("a triangle has vertex " + format_number(v) + "; there are vertices 0 to " +
                        format_number(mesh.num_vertices() - 1));
    if (!mesh.positions.row(v).allFinite())
      throw InvalidMesh("vertex " + format_number(v) + ": its position is not finite; numbers are needed");
  }
}

void make_unit(Points& normals, Index v) {
  const Eigen::RowVector3d normal = normals.row(v);
  const std::string vertex = "vertex " + format_number(v) + ": its normal ";
  if (!normal.allFinite()) throw InvalidMesh(vertex + "is not finite; numbers are needed");
  const double largest = normal.cwiseAbs().maxCoeff();
  if (largest == 0) throw InvalidMesh(vertex + "has length 0; any other length will do");
  if (std::abs(normal.norm() - 1) > 4 * std::numeric_limits<double>::epsilon())
    normals.row(v) = (normal / largest).normalized();
}

void check_edge(const NormalMesh& mesh, Index face, Index a, Index b) {
  const auto edge = [&] {
    return "face " + format_number(face) + ", edge (" + format_number(a) + "," + format_number(b) + "): ";
  };
  const Eigen::Vector3d chord = mesh.positions.row(b) - mesh.positions.row(a);
  const double largest = chord.cwiseAbs().maxCoeff();
  if (!std::isfinite(largest)) throw InvalidMesh(edge() + "its ends are too far apart; scale the mesh down");
  if (largest == 0) throw InvalidMesh(edge() + "its ends are at the same place; an edge needs a length: weld them");
  const Eigen::Vector3d direction = (chord / largest).normalized(), from = mesh.normals.row(a),
                        to = mesh.normals.row(b);
  for (const Index v : {a, b}) {
    const Eigen::Vector3d normal = mesh.normals.row(v);
    if (direction.cross(normal).norm() <= least_sine)
      throw InvalidMesh(edge() + "the normal of vertex " + format_number(v) +
                        " runs along the edge, which then has no direction in the plane there; change the normal");
  }
  if ((from + to).norm() <= least_sum)
    throw InvalidMesh(edge() + "the normals of its ends are opposite; turn one around, or cut the edge");
}

}  // namespace

NormalMesh normal_mesh(const Mesh& mesh, const Points& normals) {
  for (Index f = 0; f < mesh.num_faces(); ++f)
    if (mesh.face_sizes[size_t(f)] != 3)
      throw UnsupportedTopology("face " + format_number(f) + " has " + format_number(mesh.face_sizes[size_t(f)]) +
                                " corners; patches through points and normals are of triangles: triangulate the mesh");
  if (!mesh.holes.empty())
    throw InvalidMesh("face " + format_number(mesh.holes.front()) +
                      " is a hole, for which patches through points and normals have no rule; leave the face or its "
                      "tag out");
  if (normals.rows() != 0 && (normals.rows() != mesh.num_vertices() || normals.cols() != 3))
    throw InvalidMesh(format_number(normals.rows()) + " normals for " + format_number(mesh.num_vertices()) +
                      " vertices; each has one, of 3 coordinates");
  return {mesh.face_vertices, mesh.positions, normals};
}

NormalMesh checked(NormalMesh mesh) {
  check_triangles(mesh);
  if (mesh.normals.rows() == 0)
    throw InvalidMesh(
        "there are no normals; an .obj has them as vn, named by the corners of its faces (f a//c ...); the option "
        "normals=estimated takes means of the faces'");
  if (mesh.normals.rows() != mesh.positions.rows())
    throw InvalidMesh(format_number(mesh.normals.rows()) + " normals for " + format_number(mesh.num_vertices()) +
                      " vertices; each has one");
  std::vector<bool> seen(size_t(mesh.num_vertices()));
  for (const Index v : mesh.triangles) {
    if (!seen[size_t(v)]) make_unit(mesh.normals, v);
    seen[size_t(v)] = true;
  }
  for (Index f = 0; f < mesh.num_faces(); ++f)
    for (int i = 0; i < 3; ++i)
      check_edge(mesh, f, mesh.triangles[size_t(3 * f + i)], mesh.triangles[size_t(3 * f + (i + 1) % 3)]);
  return mesh;
}

Points estimated_normals(const NormalMesh& mesh) {
  check_triangles(mesh);
  Points sums = Points::Zero(mesh.num_vertices(), 3);
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const std::array<Eigen::Vector3d, 3> x = mesh.corners(mesh.positions, f);
    std::array<Eigen::Vector3d, 3> side;
    for (int i = 0; i < 3; ++i) side[i] = (x[(i + 1) % 3] - x[i]).stableNormalized();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d cross = side[i].cross(-side[(i + 2) % 3]);
      const double sine = cross.norm();
      if (!(sine > 0)) continue;
      const double angle = std::atan2(sine, -side[i].dot(side[(i + 2) % 3]));
      sums.row(mesh.triangles[size_t(3 * f + i)]) += (angle / sine) * cross;
    }
  }
  for (Index v = 0; v < mesh.num_vertices(); ++v)
    if (sums.row(v).norm() > least_sum)
      sums.row(v).normalize();
    else
      sums.row(v).setZero();
  return sums;
}

std::vector<bool> wound_against_normals(const NormalMesh& mesh) {
  std::vector<bool> against(size_t(mesh.num_faces()));
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const std::array<Eigen::Vector3d, 3> x = mesh.corners(mesh.positions, f), n = mesh.corners(mesh.normals, f);
    int balance = 0;
    for (int i = 0; i < 3; ++i) {
      // The angle between the edges in the plane of the normal: positive if the triangle is wound with it.
      const Eigen::Vector3d next = (x[(i + 1) % 3] - x[i]).stableNormalized(),
                            before = (x[(i + 2) % 3] - x[i]).stableNormalized();
      const double turn = next.cross(before).dot(n[i]);
      balance += turn > 0 ? 1 : turn < 0 ? -1 : 0;
    }
    against[size_t(f)] = balance < 0;
  }
  return against;
}

}  // namespace sublimit
