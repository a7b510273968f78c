// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/incentre_segment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sublimit {
namespace {

using Eigen::Vector3d;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;
constexpr double most_length = 1000;   // of a biarc in segments
constexpr double whole_circle = 1e-4;  // radians between a half turn and pi: nearer, an arc is no arc any more
constexpr double least_ratio = 1e-6;   // of angles: below it the incentre is that near to an end of the segment

Vector3d across(const Vector3d& v, const Vector3d& u) { return v - v.dot(u) * u; }

/// The direction of `v` across u, orthogonal to u even where v almost is not.
Vector3d direction_across(const Vector3d& v, const Vector3d& u) { return across(v.normalized(), u).normalized(); }

/// Any direction across u; in the plane if u is.
Vector3d some_direction_across(const Vector3d& u) {
  if (u.z() == 0) return {-u.y(), u.x(), 0};
  return direction_across(across(Vector3d::UnitX(), u) + across(Vector3d::UnitY(), u) / 2, u);
}

double angle(const Vector3d& v, const Vector3d& u, const Vector3d& n) { return std::atan2(v.dot(n), v.dot(u)); }

Vector3d reflected(const Vector3d& v, const Vector3d& u) { return 2 * v.dot(u) * u - v; }

/// The joint of the biarc of equal chords, risen into the direction n by an angle psi.
struct EqualChords {
  HermitePoint joint;
  double length;  // of the biarc, in segments
};
EqualChords equal_chords(const HermitePoint& a, const HermitePoint& b, const Vector3d& u, const Vector3d& n,
                         double psi) {
  const Vector3d segment = b.position - a.position;
  const Vector3d first = std::cos(psi) * u + std::sin(psi) * n, second = std::cos(psi) * u - std::sin(psi) * n;
  double length = 0;
  for (const auto& [chord, tangent] : {std::pair(first, a.tangent), std::pair(second, b.tangent)}) {
    const double half_turn = std::atan2(chord.cross(tangent).norm(), chord.dot(tangent)), sine = std::sin(half_turn);
    length += (sine > 0 ? half_turn / sine : half_turn > 1 ? 1 / eps : 1) / (2 * std::cos(psi));
  }
  return {{a.position + segment / 2 + segment.stableNorm() / 2 * std::tan(psi) * n,
           (reflected(a.tangent, first) + reflected(b.tangent, second)).normalized()},
          length};
}

EqualChords shorter_equal_chords(const HermitePoint& a, const HermitePoint& b, const Vector3d& u, const Vector3d& n) {
  // In the plane of u and n, the angle from b's tangent to a's.
  const double su = a.tangent.dot(u), sn = a.tangent.dot(n), tu = b.tangent.dot(u), tn = b.tangent.dot(n);
  double sine = tu * sn - tn * su;
  const double cosine = su * tu + sn * tn;
  // Opposite tangents: a sense that does not depend on the direction of the curve.
  if (cosine < 0 && std::abs(sine) < 64 * eps) sine = su < 0 ? 0.0 : -0.0;
  const double turn = std::atan2(sine, cosine);
  const EqualChords principal = equal_chords(a, b, u, n, turn / 4);
  if (std::abs(turn) < 1) return principal;  // the other sense would turn by more than 5
  const EqualChords other = equal_chords(a, b, u, n, (turn - std::copysign(2 * pi, turn)) / 4);
  return other.length < principal.length * (1 - 1e-9) ? other : principal;
}

}  // namespace

SegmentStep incentre_step(const HermitePoint& a, const HermitePoint& b, double scale) {
  const Vector3d segment = b.position - a.position;
  const double l = segment.stableNorm();
  if (l == 0) return {SegmentKind::arc, middle_of_arc(a, b)};  // segments of refined curves may shrink to nothing
  const Vector3d u = segment / l;
  const Vector3d &s = a.tangent, &t = b.tangent;
  const double noise = 64 * eps * (1 + scale / l);  // of the direction of the segment

  // Arcs before all else: refined data are arcs up to rounding, and angles of short segments are not to be trusted.
  if ((t - reflected(s, u)).norm() <= noise && (s + u).norm() > whole_circle)
    return {SegmentKind::arc, middle_of_arc(a, b)};

  const auto fallback = [&](SegmentKind kind, const Vector3d& n) -> SegmentStep {
    const EqualChords biarc = shorter_equal_chords(a, b, u, n);
    if (biarc.length > most_length) return {SegmentKind::back, {a.position + segment / 2, u}};
    return {kind, biarc.joint};
  };

  // The plane of the segment and the tangent that leaves it more.
  const Vector3d rise_s = across(s, u), rise_t = across(t, u);
  const bool by_s = rise_s.squaredNorm() >= rise_t.squaredNorm();
  const Vector3d &more = by_s ? rise_s : rise_t, &less = by_s ? rise_t : rise_s;
  Vector3d n = more.norm() > noise ? direction_across(more, u) : some_direction_across(u);
  if (across(less, n).norm() > noise) return fallback(SegmentKind::twisted, direction_across(rise_s - rise_t, u));
  double alpha = angle(s, u, n), beta = -angle(t, u, n);
  if (pi - std::abs(alpha) <= noise) alpha = std::copysign(alpha, beta);
  if (pi - std::abs(beta) <= noise) beta = std::copysign(beta, alpha);
  if (alpha < 0 && beta < 0) {
    alpha = -alpha;
    beta = -beta;
    n = -n;
  }
  if (std::min(alpha, beta) <= std::max(noise, least_ratio * std::max(alpha, beta)))
    return fallback(SegmentKind::inflection, n);
  if (2 * pi - alpha - beta < 2 * pi / most_length) return {SegmentKind::back, {a.position + segment / 2, u}};

  // The incentre from the nearer end.
  const double sine = std::sin((alpha + beta) / 2);
  const Vector3d point =
      alpha >= beta
          ? Vector3d(a.position + l * std::sin(beta / 2) / sine * (std::cos(alpha / 2) * u + std::sin(alpha / 2) * n))
          : Vector3d(b.position - l * std::sin(alpha / 2) / sine * (std::cos(beta / 2) * u - std::sin(beta / 2) * n));
  return {SegmentKind::convex, {point, u}};
}

SegmentLimit incentre_segment(const HermitePoint& a, const HermitePoint& b, double scale) {
  const SegmentStep step = incentre_step(a, b, scale);
  std::vector<HermitePoint> joints{a, b};
  if (step.kind != SegmentKind::arc) joints.insert(joints.begin() + 1, step.point);
  if (step.kind == SegmentKind::back)
    joints = {a, incentre_step(a, step.point, scale).point, step.point, incentre_step(step.point, b, scale).point, b};
  SegmentLimit limit{step.kind, {}};
  for (size_t i = 0; i + 1 < joints.size(); ++i) limit.arcs.emplace_back(joints[i], joints[i + 1]);
  return limit;
}

HermitePoint SegmentLimit::at(double x) const {
  const double pieces = x * static_cast<double>(arcs.size());
  const size_t arc = std::min(static_cast<size_t>(pieces), arcs.size() - 1);
  return arcs[arc].at(pieces - static_cast<double>(arc));
}

double SegmentLimit::curvature(double x) const {
  return arcs[std::min(static_cast<size_t>(x * static_cast<double>(arcs.size())), arcs.size() - 1)].curvature();
}

SegmentPlace SegmentLimit::place(double x, bool before) const {
  const double pieces = x * static_cast<double>(arcs.size());
  size_t arc = std::min(static_cast<size_t>(pieces), arcs.size() - 1);
  if (before && arc > 0 && static_cast<double>(arc) == pieces) --arc;
  const double share = pieces - static_cast<double>(arc);
  const HermitePoint p = arcs[arc].at(share);
  return {p.position, p.tangent, arcs[arc].curvature_vector(share)};
}

}  // namespace sublimit
