// SPDX-License-Identifier: Apache-2.0
#include "sublimit/schemes/hermite_incentre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sublimit/base/format_number.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;
constexpr double most_length = 1000;     // of a biarc in legs
constexpr double whole_circle = 1e-4;    // radians between a half turn and pi: nearer, an arc is no arc any more
constexpr double least_ratio = 1e-6;     // of angles: below it the incentre is that near to an end of the leg
constexpr double unit_tolerance = 1e-6;  // of lengths of given tangents

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
  double length;  // of the biarc, in legs
};
EqualChords equal_chords(const HermitePoint& a, const HermitePoint& b, const Vector3d& u, const Vector3d& n,
                         double psi) {
  const Vector3d leg = b.position - a.position;
  const Vector3d first = std::cos(psi) * u + std::sin(psi) * n, second = std::cos(psi) * u - std::sin(psi) * n;
  double length = 0;
  for (const auto& [chord, tangent] : {std::pair(first, a.tangent), std::pair(second, b.tangent)}) {
    const double half_turn = std::atan2(chord.cross(tangent).norm(), chord.dot(tangent)), sine = std::sin(half_turn);
    length += (sine > 0 ? half_turn / sine : half_turn > 1 ? 1 / eps : 1) / (2 * std::cos(psi));
  }
  return {{a.position + leg / 2 + leg.stableNorm() / 2 * std::tan(psi) * n,
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

LegStep incentre_step(const HermitePoint& a, const HermitePoint& b, double scale) {
  const Vector3d leg = b.position - a.position;
  const double l = leg.stableNorm();
  if (l == 0) return {LegKind::arc, middle_of_arc(a, b)};  // legs of refined curves may shrink to nothing
  const Vector3d u = leg / l;
  const Vector3d &s = a.tangent, &t = b.tangent;
  const double noise = 64 * eps * (1 + scale / l);  // of the direction of the leg

  // Arcs before all else: refined data are arcs up to rounding, and angles of short legs are not to be trusted.
  if ((t - reflected(s, u)).norm() <= noise && (s + u).norm() > whole_circle)
    return {LegKind::arc, middle_of_arc(a, b)};

  const auto fallback = [&](LegKind kind, const Vector3d& n) -> LegStep {
    const EqualChords biarc = shorter_equal_chords(a, b, u, n);
    if (biarc.length > most_length) return {LegKind::back, {a.position + leg / 2, u}};
    return {kind, biarc.joint};
  };

  // The plane of the leg and the tangent that leaves it more.
  const Vector3d rise_s = across(s, u), rise_t = across(t, u);
  const bool by_s = rise_s.squaredNorm() >= rise_t.squaredNorm();
  const Vector3d &more = by_s ? rise_s : rise_t, &less = by_s ? rise_t : rise_s;
  Vector3d n = more.norm() > noise ? direction_across(more, u) : some_direction_across(u);
  if (across(less, n).norm() > noise) return fallback(LegKind::twisted, direction_across(rise_s - rise_t, u));
  double alpha = angle(s, u, n), beta = -angle(t, u, n);
  if (pi - std::abs(alpha) <= noise) alpha = std::copysign(alpha, beta);
  if (pi - std::abs(beta) <= noise) beta = std::copysign(beta, alpha);
  if (alpha < 0 && beta < 0) {
    alpha = -alpha;
    beta = -beta;
    n = -n;
  }
  if (std::min(alpha, beta) <= std::max(noise, least_ratio * std::max(alpha, beta)))
    return fallback(LegKind::inflection, n);
  if (2 * pi - alpha - beta < 2 * pi / most_length) return {LegKind::back, {a.position + leg / 2, u}};

  // The incentre from the nearer end.
  const double sine = std::sin((alpha + beta) / 2);
  const Vector3d point =
      alpha >= beta
          ? Vector3d(a.position + l * std::sin(beta / 2) / sine * (std::cos(alpha / 2) * u + std::sin(alpha / 2) * n))
          : Vector3d(b.position - l * std::sin(alpha / 2) / sine * (std::cos(beta / 2) * u - std::sin(beta / 2) * n));
  return {LegKind::convex, {point, u}};
}

namespace {

HermitePoint hermite_point(const ControlPolygon& polygon, Index i) {
  HermitePoint p{Vector3d::Zero(), Vector3d::Zero()};
  for (int c = 0; c < polygon.dimension(); ++c) {
    p.position[c] = polygon.points(i, c);
    p.tangent[c] = polygon.tangents(i, c);
  }
  return p;
}

void set_row(ControlPolygon& polygon, Index i, const HermitePoint& p) {
  for (int c = 0; c < polygon.dimension(); ++c) {
    polygon.points(i, c) = p.position[c];
    polygon.tangents(i, c) = p.tangent[c];
  }
}

double scale_of(const ControlPolygon& polygon) { return polygon.points.cwiseAbs().maxCoeff(); }

Index num_legs(const ControlPolygon::Curve& curve) {
  return static_cast<Index>(curve.points.size()) - (curve.closed ? 0 : 1);
}

/// Calls `body` with the ends of each leg of a curve.
template <class Body>
void for_each_leg(const ControlPolygon& polygon, const ControlPolygon::Curve& curve, const Body& body) {
  for (Index i = 0; i < num_legs(curve); ++i)
    body(hermite_point(polygon, curve.points[i]), hermite_point(polygon, curve.points[(i + 1) % curve.points.size()]));
}

/// A polygon with `pieces` points for each leg of `parent`, made by at(curve, leg, j), j = 0 the leg's first point.
template <class At>
ControlPolygon with_points_on_legs(const ControlPolygon& parent, Index pieces, const At& at) {
  std::int64_t count = 0;
  for (const ControlPolygon::Curve& curve : parent.curves)
    count += std::int64_t{num_legs(curve)} * pieces + (curve.closed ? 0 : 1);
  if (count > std::numeric_limits<Index>::max())
    throw ResourceError(format_number(count) + " points are more than 32-bit indices count; use fewer levels");
  ControlPolygon child;
  child.columns = parent.columns;
  child.points.resize(count, parent.dimension());
  child.tangents.resize(count, parent.dimension());
  Index row = 0;
  for (size_t c = 0; c < parent.curves.size(); ++c) {
    const ControlPolygon::Curve& curve = parent.curves[c];
    ControlPolygon::Curve& refined = child.curves.emplace_back();
    refined.closed = curve.closed;
    const auto add = [&](const HermitePoint& p) {
      set_row(child, row, p);
      refined.points.push_back(row++);
    };
    for (Index i = 0; i < num_legs(curve); ++i)
      for (Index j = 0; j < pieces; ++j) add(at(c, i, j));
    if (!curve.closed) add(hermite_point(parent, curve.points.back()));
  }
  return child;
}

ControlPolygon refined(const ControlPolygon& polygon) {
  const double scale = scale_of(polygon);
  return with_points_on_legs(polygon, 2, [&](size_t c, Index i, Index j) {
    const std::vector<Index>& points = polygon.curves[c].points;
    const HermitePoint a = hermite_point(polygon, points[i]);
    return j == 0 ? a : incentre_step(a, hermite_point(polygon, points[(i + 1) % points.size()]), scale).point;
  });
}

ControlPolygon limit_points(const ControlPolygon& polygon, int levels) {
  if (levels < 0) throw InvalidParameter("levels is " + format_number(levels) + "; it must be 0 or more");
  if (levels > 30) throw ResourceError(format_number(levels) + " levels are more points than 32-bit indices count");
  const std::vector<std::vector<LegLimit>> limit = incentre_limit(polygon);
  return with_points_on_legs(polygon, Index{1} << levels,
                             [&](size_t c, Index i, Index j) { return limit[c][i].at(std::ldexp(j, -levels)); });
}

std::string place(const ControlPolygon& polygon, Index i) {
  if (polygon.lines.empty()) return (polygon.file.empty() ? "" : polygon.file + ": ");
  return polygon.file + ":" + format_number(polygon.lines[i]) + ": ";
}

constexpr const char* layout = "x,y,tx,ty or x,y,z,tx,ty,tz";

void check_point(const ControlPolygon& polygon, Index i) {
  if (!polygon.points.row(i).allFinite() || !polygon.tangents.row(i).allFinite())
    throw InvalidMesh(place(polygon, i) + "point " + format_number(i) +
                      " or its tangent is not finite; hermite-incentre needs numbers");
  const double length = polygon.tangents.row(i).stableNorm();
  if (std::abs(length - 1) > unit_tolerance)
    throw InvalidMesh(place(polygon, i) + "the tangent of point " + format_number(i) + " has length " +
                      format_number(length) + "; hermite-incentre takes " + layout + " with tangents of length 1");
}

void check_curve(const ControlPolygon& polygon, size_t c) {
  const ControlPolygon::Curve& curve = polygon.curves[c];
  for (const Index i : curve.points)
    if (i < 0 || i >= polygon.num_points())
      throw InvalidMesh("a curve has point " + format_number(i) + "; there are points 0 to " +
                        format_number(polygon.num_points() - 1));
  if (curve.points.size() < 2)
    throw UnsupportedTopology((curve.points.empty() ? std::string() : place(polygon, curve.points[0])) + "curve " +
                              format_number(c) + " has " + (curve.points.empty() ? "no points" : "1 point") +
                              "; hermite-incentre needs at least 2");
  for (Index i = 0; i < num_legs(curve); ++i) {
    const Index a = curve.points[i], b = curve.points[(i + 1) % curve.points.size()];
    const double leg = (polygon.points.row(b) - polygon.points.row(a)).stableNorm();
    if (leg == 0)
      throw InvalidMesh(
          place(polygon, b) + "points " + format_number(a) + " and " + format_number(b) +
          " are next to each other and equal; a leg needs a length: leave one of them out" +
          (curve.closed && i + 1 == num_legs(curve) ? " (a closed curve does not repeat its first)" : ""));
    if (!std::isfinite(leg))
      throw InvalidMesh(place(polygon, b) + "points " + format_number(a) + " and " + format_number(b) +
                        " are too far apart; scale the curve down");
  }
}

ControlPolygon checked(ControlPolygon polygon) {
  if (polygon.curves.empty()) throw InvalidMesh("there are no curves; hermite-incentre needs a polygon");
  if (!polygon.has_tangents())
    throw InvalidMesh((polygon.file.empty() ? "" : polygon.file + ": ") +
                      "points without tangents; hermite-incentre takes " + layout);
  if (polygon.dimension() < 2 || polygon.dimension() > 3 || polygon.tangents.cols() != polygon.points.cols() ||
      polygon.tangents.rows() != polygon.points.rows())
    throw UnsupportedTopology((polygon.file.empty() ? "" : polygon.file + ": ") + "points of " +
                              format_number(polygon.dimension()) + " and tangents of " +
                              format_number(polygon.tangents.cols()) + " coordinates; hermite-incentre takes " +
                              layout);
  for (Index i = 0; i < polygon.num_points(); ++i) {
    check_point(polygon, i);
    // Tangents that are units already keep their bits, so that refining twice by 1 is refining once by 2.
    const double length = polygon.tangents.row(i).norm();
    if (std::abs(length - 1) > 4 * eps) polygon.tangents.row(i) /= length;
  }
  for (size_t c = 0; c < polygon.curves.size(); ++c) check_curve(polygon, c);
  return polygon;
}

std::vector<std::string> notes(const ControlPolygon& polygon) {
  std::array<Index, 5> count{};
  Index legs = 0;
  const double scale = scale_of(polygon);
  for (const ControlPolygon::Curve& curve : polygon.curves)
    for_each_leg(polygon, curve, [&](const HermitePoint& a, const HermitePoint& b) {
      ++count[static_cast<size_t>(incentre_step(a, b, scale).kind)];
      ++legs;
    });
  const auto of = [&](LegKind kind) { return count[static_cast<size_t>(kind)]; };
  const Index fell_back = of(LegKind::inflection) + of(LegKind::twisted) + of(LegKind::back);
  if (fell_back == 0) return {};
  std::string which;
  const auto add = [&](LegKind kind, const char* words) {
    if (of(kind) > 0) which += (which.empty() ? "" : ", ") + format_number(of(kind)) + " " + words;
  };
  add(LegKind::inflection, "with angles on different sides or of zero");
  add(LegKind::twisted, "with tangents out of the plane");
  add(LegKind::back, "halved first, with both tangents pointing back");
  return {format_number(fell_back) + " of " + format_number(legs) +
          " legs have no incentre and become biarcs of equal chords (" + which + ")"};
}

}  // namespace

HermitePoint LegLimit::at(double x) const {
  const double pieces = x * static_cast<double>(arcs.size());
  const size_t arc = std::min(static_cast<size_t>(pieces), arcs.size() - 1);
  return arcs[arc].at(pieces - static_cast<double>(arc));
}

double LegLimit::curvature(double x) const {
  return arcs[std::min(static_cast<size_t>(x * static_cast<double>(arcs.size())), arcs.size() - 1)].curvature();
}

LegPlace LegLimit::place(double x, bool before) const {
  const double pieces = x * static_cast<double>(arcs.size());
  size_t arc = std::min(static_cast<size_t>(pieces), arcs.size() - 1);
  if (before && arc > 0 && static_cast<double>(arc) == pieces) --arc;
  const double share = pieces - static_cast<double>(arc);
  const HermitePoint p = arcs[arc].at(share);
  return {p.position, p.tangent, arcs[arc].curvature_vector(share)};
}

std::vector<std::vector<LegLimit>> incentre_limit(const ControlPolygon& polygon) {
  const double scale = scale_of(polygon);
  std::vector<std::vector<LegLimit>> result(polygon.curves.size());
  for (size_t c = 0; c < polygon.curves.size(); ++c)
    for_each_leg(polygon, polygon.curves[c], [&](const HermitePoint& a, const HermitePoint& b) {
      const LegStep step = incentre_step(a, b, scale);
      std::vector<HermitePoint> joints{a, b};
      if (step.kind != LegKind::arc) joints.insert(joints.begin() + 1, step.point);
      if (step.kind == LegKind::back)
        joints = {a, incentre_step(a, step.point, scale).point, step.point, incentre_step(step.point, b, scale).point,
                  b};
      LegLimit& limit = result[c].emplace_back(LegLimit{step.kind, {}});
      for (size_t i = 0; i + 1 < joints.size(); ++i) limit.arcs.emplace_back(joints[i], joints[i + 1]);
    });
  return result;
}

namespace {

std::vector<std::vector<LegCurve>> legs(const ControlPolygon& polygon) {
  std::vector<std::vector<LegCurve>> result;
  for (const std::vector<LegLimit>& curve : incentre_limit(polygon)) {
    std::vector<LegCurve>& one = result.emplace_back();
    for (const LegLimit& limit : curve)
      one.push_back([limit](double t, bool before) { return limit.place(t, before); });
  }
  return result;
}

}  // namespace

GeometricCurveScheme hermite_incentre(const SchemeOptions&) {
  return {.name = "hermite-incentre",
          .source = "incentre of leg and tangents, new tangent along the leg (unlike Deng, Wang 2010)",
          .checked = checked,
          .refine = refined,
          .limit = limit_points,
          .legs = legs,
          .notes = notes,
          .claims = {.regular = 1,
                     .interpolates = true,
                     .reproduces = "circles",
                     .limit = "biarcs through the incentres",
                     .exponent = "2"}};
}

}  // namespace sublimit
