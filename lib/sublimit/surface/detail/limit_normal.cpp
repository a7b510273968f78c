// SPDX-License-Identifier: Apache-2.0
// Normals of samples: of the two tangents, or, where control points make these degenerate, of what follows them.
#include <Eigen/Geometry>

#include <cmath>

#include "sublimit/limit/detail/degenerate_normal.h"
#include "sublimit/surface/detail/limit_map_parts.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// Natural derivatives that are parallel, on a side of the domain: the normal that the points inside tend to. To first
/// order along the way (a, b) inwards it is a (xuu x xv + xu x xuv) + b (xuv x xv + xu x xvv).
Vector3d one_sided_normal(const Points& rows, const PieceCoordinates& p, bool triangle, double scale) {
  const auto d = [&](int k) { return Vector3d(rows.row(k)); };
  const Vector3d along_u = d(3).cross(d(2)) + d(1).cross(d(4)), along_v = d(4).cross(d(2)) + d(1).cross(d(5));
  const auto inwards = [&](double at_0, double at_1) { return at_0 == 0 ? 1 : at_1 == 0 ? -1 : 0; };
  const int a = inwards(p.u, p.u1), b = triangle ? inwards(p.v, p.u1) : inwards(p.v, p.v1);
  const double least = 1e-10 * scale * scale;
  // Inside along one of the parameters there are two ways, with opposite normals: it must not matter.
  if ((a == 0 && along_u.norm() > least) || (b == 0 && along_v.norm() > least)) return Vector3d::Zero();
  const Vector3d n1 = a * along_u, n2 = b * along_v;
  if (n1.norm() <= least && n2.norm() <= least) return Vector3d::Zero();
  if (n1.norm() <= least || n2.norm() <= least) return (n1 + n2).normalized();
  return n1.normalized().dot(n2.normalized()) > 1 - 1e-9 ? Vector3d((n1 + n2).normalized()) : Vector3d::Zero();
}

}  // namespace

Vector3d LimitMap::Parts::normal_of(const LimitStencil& s, const Points& local, const Place& place,
                                    const Points& points) const {
  if (s.tangents.rows() < 2) return Vector3d::Zero();
  // Squares of huge or tiny tangents would leave the range of numbers; powers of two change no digit.
  const Points centred = local.rowwise() - local.row(0);
  const double largest = centred.size() > 0 ? centred.cwiseAbs().maxCoeff() : 0;
  if (!(largest > 0)) return Vector3d::Zero();
  const double unit = std::ldexp(1.0, -std::ilogb(largest));
  const Points x = centred * unit;
  Points tangents = s.tangents * x;
  // How large the tangents would be if their terms did not cancel.
  const Eigen::VectorXd sizes = s.tangents.cwiseAbs() * x.rowwise().norm();
  const double scale1 = sizes[0], scale2 = sizes[1];
  // A parameter that stands still at the corner says nothing of the surface.
  const bool both = scale1 > 0 && scale2 > 0;
  if (both) {
    const Vector3d a = Vector3d(tangents.row(0)) / scale1, b = Vector3d(tangents.row(1)) / scale2, cross = a.cross(b);
    if (cross.norm() > 1e-13 * a.norm() * b.norm() && cross.norm() > 1e-20) return cross.normalized();
  }
  const Target at = target(place);
  if (both && s.weights.rows() >= 3) {
    const LimitStencil second = s.weights.rows() == 6 ? s : stencil(find(at, 2));
    if (second.weights.rows() == 6) {
      Points rows = Points::Zero(6, 3);
      for (size_t j = 0; j < second.vertices.size(); ++j)
        rows += second.weights.col(Eigen::Index(j)) * ((points.row(second.vertices[j]) - local.row(0)) * unit);
      const Vector3d normal =
          one_sided_normal(rows, at.map ? at.outer : at.place, addresses.triangles(), std::max(scale1, scale2));
      if (!normal.isZero(0)) return normal;
    }
  }
  const std::optional<Centre> centre = this->centre(at);
  if (!centre) return Vector3d::Zero();
  const Points fine = prepared ? Points(prepared->S * points) : Points();
  const Points& around = prepared ? fine : points;
  if (s.tangents.rows() == 2) {
    // Natural derivatives that are degenerate by the mesh: one triangle between two parts of a crease. Limit masks know
    // more.
    const LimitRows* limit = corners.at(*centre);
    if (!limit || limit->status == LimitStatus::undefined_normal) return Vector3d::Zero();
    const auto along = [&](LimitRows::Row row) {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
      for (const auto& [v, weight] : row) sum += weight * ((around.row(v) - local.row(0)) * unit);
      return Vector3d(sum);
    };
    const Vector3d t1 = along(limit->tangent1()), t2 = along(limit->tangent2()), n = t1.cross(t2);
    return n.norm() > 1e-10 * t1.norm() * t2.norm() ? Vector3d(n.normalized()) : Vector3d::Zero();
  }
  std::vector<Vector3d> higher;
  for (Eigen::Index k = 2; k < tangents.rows(); ++k) higher.push_back(tangents.row(k));
  // How the faces of this side turn around the place.
  const Topology& t = base().topology();
  Vector3d turn = Vector3d::Zero();
  const auto add = [&](Index middle, Index from, Index to) {
    const Vector3d p = around.row(middle), q = (Vector3d(around.row(from)) - p) * unit,
                   r = (Vector3d(around.row(to)) - p) * unit;
    turn += q.cross(r);
  };
  HalfEdge h = centre->start;
  if (centre->kind != Centre::Kind::vertex) {
    const std::span<const Index> polygon = t.vertices(t.face(h));
    for (size_t i = 2; i < polygon.size(); ++i) add(polygon[0], polygon[i - 1], polygon[i]);
  } else {
    while (!cuts(h) && t.next(t.twin(h)) != centre->start) h = t.next(t.twin(h));  // clockwise to where the side begins
    const HalfEdge first = h;
    for (;;) {
      add(index(t.tail(h)), index(t.head(h)), index(t.tail(t.prev(h))));
      const HalfEdge into = t.prev(h);
      if (cuts(into)) break;
      h = t.twin(into);
      if (h == first) break;
    }
  }
  return degenerate_normal(tangents.row(0), tangents.row(1), higher, scale1 + scale2, turn);
}

}  // namespace sublimit
