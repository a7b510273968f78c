// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/torus_edge.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sublimit/geometric/torus_carrier.h"

namespace sublimit {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

/// Squares of misfits and of conditions relative to the edge below this are rounding errors.
constexpr double rounding2 = 1e-28;
/// The same of the conditions for g, where rounding errors would choose it.
constexpr double undetermined2 = 1e-22;
/// Normals that cancel up to this leave no side on which the new point could be.
constexpr double cancelled = 1e-7;
/// Misfit from which nothing fits: a slope of ten, which is 84 degrees.
constexpr double largest_misfit = 10;
/// Directions across lean by no more: in flat triangles leaning ones lose more digits than they save.
constexpr double largest_skew = 2;

/// Where the curve of two circular arcs would be half way: above the chord by chord/4 tan(angle/2) for each end's
/// angle.
Vector3d middle_of_arcs(const SurfacePoint& a, const SurfacePoint& b, const Vector3d& mean_normal) {
  const Vector3d chord = b.position - a.position;
  const double length = chord.norm();
  const auto rise = [&](double sine) { return std::tan(std::asin(std::clamp(sine, -1.0, 1.0)) / 2); };
  const double height = -length / 4 * (rise(chord.dot(a.normal) / length) + rise(-chord.dot(b.normal) / length));
  return a.position + chord / 2 + height * mean_normal;
}

/// The geodesic curvature of the path around, at a, for which b's data fit best on the torus. With v = v0 + g v1 the
/// motion's velocity at b and omega = omega0 + g omega1 its rotation, all conditions are linear in g: v is tangent at
/// b; v is at right angles to the one principal direction of b, t; the axis is to the other, p; and p's circle has
/// curvature k there. The edge has length 1.
struct Geodesic {
  double g;
  double trust;  ///< from 0, where any g will do up to rounding, to 1
};
Geodesic best_geodesic(const SurfacePoint& a, const Vector3d& e1, double k2, const SurfacePoint& b, const Vector3d& t,
                       const Vector3d& p, double k_t, double k_p) {
  const Vector3d d = b.position - a.position, e2 = a.normal.cross(e1);
  const Vector3d omega0 = k2 * e1, omega1 = -a.normal, v0 = e2 + omega0.cross(d), v1 = omega1.cross(d);
  const double gap = k_p - k_t;  // directions count for as much as the curvatures differ
  const double c[4] = {v0.dot(b.normal), gap * v0.dot(t), gap * omega0.dot(p),
                       omega0.cross(p).dot(b.normal) - k_p * v0.dot(p)};
  const double m[4] = {v1.dot(b.normal), gap * v1.dot(t), gap * omega1.dot(p),
                       omega1.cross(p).dot(b.normal) - k_p * v1.dot(p)};
  double mc = 0, mm = std::numeric_limits<double>::min();
  for (int i = 0; i < 4; ++i) {
    mc += m[i] * c[i];
    mm += m[i] * m[i];
  }
  return {-mc / mm, mm / (mm + undetermined2)};
}

/// How far the line from one opposite corner to the other (of one triangle, to the edge's middle) leans along the edge.
double skew_across(const Vector3d& chord, const Vector3d& mean_normal, std::span<const SurfacePoint> opposite) {
  if (opposite.empty()) return 0;
  const Vector3d from = opposite.size() > 1 ? opposite[1].position : Vector3d(chord / 2);
  const Vector3d across = opposite[0].position - from;
  const double along = across.dot(chord), left = across.dot(mean_normal.cross(chord));
  return left == 0 ? 0 : std::clamp(along / left, -largest_skew, largest_skew);
}

/// Sums over all carriers, the better ones with more weight. The edge has length 1.
struct Blend {
  std::span<const SurfacePoint> opposite;
  Vector3d guess = Vector3d::Zero();
  double skew = 0;
  double weight = 0;
  Vector3d position = Vector3d::Zero(), normal = Vector3d::Zero();
  Matrix3d shape = Matrix3d::Zero();

  /// From 0, the opposite corners lie on the piece, to 1, they have nothing to do with it.
  double misfit2_aside(const TorusPiece& piece) const {
    double sum = 0;
    for (const SurfacePoint& corner : opposite) {
      const std::optional<TorusCarrier> carrier = TorusCarrier::make(piece, corner);
      sum += carrier ? carrier->misfit2() / (1 + carrier->misfit2()) : 1;
    }
    return opposite.empty() ? 1 : sum / static_cast<double>(opposite.size());
  }

  void add(const TorusPiece& piece, double trust, const SurfacePoint& far) {
    const std::optional<TorusCarrier> carrier = TorusCarrier::make(piece, far, skew);
    if (!carrier || carrier->misfit2() > largest_misfit * largest_misfit) return;
    const std::optional<TorusCarrier::Middle> middle = carrier->middle(guess);
    if (!middle) return;
    // Of pieces that fit alike the tamer ones: near to the guess, with circles that are large beside the edge. The
    // power was chosen by measuring on ellipsoids with edges of a radian: 1, 2, 4 gave normals within 0.7, 0.4, 0.2.
    const double near = carrier->nearness() * carrier->nearness();
    const double away = 4 * middle->distance, turn = piece.geodesic();
    const double w =
        trust * near * near /
        ((carrier->misfit2() + rounding2) * (misfit2_aside(piece) + rounding2) * (1 + away * away) * (1 + turn * turn));
    weight += w;
    position += w * (middle->position - guess);
    normal += w * middle->normal;
    shape += w * middle->shape;
  }

  /// All local surfaces of a: either principal circle as tube; g for which one or the other of b's principal directions
  /// is the path around, and g = 0.
  void add_all(const SurfacePoint& a, const SurfacePoint& b) {
    const Vector3d b1 = b.direction1, b2 = b.direction2();
    const auto tube = [&](const Vector3d& e1, double k1, double k2) {
      const auto piece = [&](Geodesic x) { add(TorusPiece(a.position, e1, a.normal, k1, k2, x.g), x.trust, b); };
      piece(best_geodesic(a, e1, k2, b, b1, b2, b.k1, b.k2));
      piece(best_geodesic(a, e1, k2, b, b2, b1, b.k2, b.k1));
      piece({0, 1});
    };
    tube(a.direction1, a.k1, a.k2);
    tube(a.direction2(), a.k2, a.k1);
  }
};

/// The middle of the chord, flat. Where everything cancels the normal is a's.
EdgePoint fallback(const SurfacePoint& a, const SurfacePoint& b, std::span<const SurfacePoint* const> opposite) {
  Vector3d aside = Vector3d::Zero();
  for (const SurfacePoint* corner : opposite) aside += corner->normal;
  const Vector3d chord = (b.position - a.position).stableNormalized();
  Vector3d normal = a.normal + b.normal;
  if (normal.norm() < cancelled) normal = aside - chord * chord.dot(aside);
  if (!(normal.norm() > cancelled * aside.norm())) normal = a.normal;
  return {surface_point(a.position / 2 + b.position / 2, normal.normalized(), Matrix3d::Zero()), true};
}

/// In units of the edge, from its start: sizes and places far from the origin cost no digits.
SurfacePoint seen_from(const SurfacePoint& origin, double unit, const SurfacePoint& p) {
  return {(p.position - origin.position) / unit, p.normal, p.k1 * unit, p.k2 * unit, p.direction1};
}

}  // namespace

EdgePoint torus_edge(const SurfacePoint& a, const SurfacePoint& b, std::span<const SurfacePoint* const> opposite) {
  const double unit = (b.position - a.position).stableNorm();
  const Vector3d sum = a.normal + b.normal;
  if (!(unit > 0 && std::isfinite(unit)) || sum.norm() < cancelled) return fallback(a, b, opposite);
  const SurfacePoint from = seen_from(a, unit, a), to = seen_from(a, unit, b);
  std::array<SurfacePoint, 2> corners;
  const size_t count = std::min(opposite.size(), corners.size());
  for (size_t i = 0; i < count; ++i) corners[i] = seen_from(a, unit, *opposite[i]);

  Blend blend{.opposite = std::span(corners).first(count)};
  blend.guess = middle_of_arcs(from, to, sum.normalized());
  blend.skew = skew_across(to.position, sum.normalized(), blend.opposite);
  blend.add_all(from, to);
  blend.add_all(to, from);
  if (!(blend.weight > 0) || !(blend.normal.norm() > 0.1 * blend.weight)) return fallback(a, b, opposite);
  const SurfacePoint middle =
      surface_point(blend.guess + blend.position / blend.weight, blend.normal.normalized(), blend.shape / blend.weight);
  return {{a.position + unit * middle.position, middle.normal, middle.k1 / unit, middle.k2 / unit, middle.direction1},
          false};
}

}  // namespace sublimit
