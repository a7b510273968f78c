// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/foot_point.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace sublimit {

struct FootSearch::State {
  Sample place;
  double f = 0;  ///< half the square of the distance
  int order = 0;
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  Eigen::Matrix2d first = Eigen::Matrix2d::Zero();  ///< of first derivatives: their scalar products
  Eigen::Matrix2d exact = Eigen::Matrix2d::Zero();  ///< second derivatives of f, or what stands for them
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();      ///< the same made positive definite
};

namespace {

/// A side of the domain: outward normal, and the direction along it.
struct Side {
  Eigen::Vector2d normal, along;
};
const std::array<Side, 4> square_sides{Side{{-1, 0}, {0, 1}}, Side{{0, -1}, {1, 0}}, Side{{1, 0}, {0, 1}},
                                       Side{{0, 1}, {1, 0}}};
const std::array<Side, 3> triangle_sides{Side{{-1, 0}, {0, 1}}, Side{{0, -1}, {1, 0}}, Side{{1, 1}, {-1, 1}}};

/// How far inside a place is, by side; 0 on it.
double inside(const Sample& s, size_t side, bool triangles) {
  switch (side) {
    case 0:
      return s.u;
    case 1:
      return s.v;
    case 2:
      return triangles ? 1 - (s.u + s.v) : 1 - s.u;
    default:
      return 1 - s.v;
  }
}

bool is_corner(const Sample& s, bool triangles) {
  int sides = 0;
  for (size_t k = 0; k < (triangles ? 3 : 4); ++k) sides += inside(s, k, triangles) <= 0;
  return sides >= 2;
}

/// A part of the way to the centre.
Sample inwards(const Sample& s, double part, bool triangles) {
  const double centre = triangles ? 0.375 : 0.5;
  return {s.face, s.u + part * (centre - s.u), s.v + part * (centre - s.v)};
}

/// Coordinates of iterates are as short as their steps allow: where the surface is no polynomial, a place costs a level
/// a digit.
double shortened(double x, double step) {
  constexpr int digits = 16;
  const double unit = std::ldexp(1.0, std::max(-60, std::ilogb(step)) - digits);
  return unit < 1e-15 ? x : std::round(x / unit) * unit;
}

/// The place t steps on, not beyond the first side in the way, and then on it.
Sample moved(const Sample& s, const Eigen::Vector2d& d, double& t, bool triangles) {
  int hit = -1;
  const size_t count = triangles ? 3 : 4;
  for (size_t k = 0; k < count; ++k) {
    const double speed = (triangles ? triangle_sides[k] : square_sides[k]).normal.dot(d);
    const double room = inside(s, k, triangles);
    if (speed > 0 && t * speed >= room) {
      t = room / speed;
      hit = int(k);
    }
  }
  const double step = t * d.cwiseAbs().maxCoeff();
  if (!(step > 0)) return s;
  const auto to = [&](double x, double dx) { return dx == 0 ? x : std::clamp(shortened(x + t * dx, step), 0.0, 1.0); };
  Sample place{s.face, to(s.u, d.x()), to(s.v, d.y())};
  if (hit == 0) place.u = 0;
  if (hit == 1) place.v = 0;
  if (hit == 2 && !triangles) place.u = 1;
  if (hit == 3) place.v = 1;
  if (triangles && (hit == 2 || place.u + place.v > 1)) place.v = 1 - place.u;
  return place;
}

/// H with its eigenvalues by the metric `first` made positive, and not too small.
Eigen::Matrix2d made_definite(const Eigen::Matrix2d& H, const Eigen::Matrix2d& first) {
  constexpr double least = 0.02;
  const Eigen::Matrix2d L = first.llt().matrixL();
  if (!(L(0, 0) > 0) || !(L(1, 1) > 0) || !L.allFinite()) return first;
  const auto solve = [&](const Eigen::Matrix2d& m) {
    return Eigen::Matrix2d(L.triangularView<Eigen::Lower>().solve(m));
  };
  const Eigen::Matrix2d M = solve(solve(H).transpose());
  const double mean = (M(0, 0) + M(1, 1)) / 2, off = (M(0, 1) + M(1, 0)) / 2, half = (M(0, 0) - M(1, 1)) / 2;
  const double radius = std::hypot(half, off);
  if (mean - radius >= least) return H;
  const double low = std::max(std::abs(mean - radius), least), high = std::max(std::abs(mean + radius), least);
  // M = mean + [half off; off -half], so the projector to its larger eigenvalue is half of 1 + that over the radius.
  Eigen::Matrix2d turn;
  turn << half, off, off, -half;
  const Eigen::Matrix2d P = radius > 0 ? Eigen::Matrix2d((Eigen::Matrix2d::Identity() + turn / radius) / 2)
                                       : Eigen::Matrix2d(Eigen::Matrix2d::Identity());
  return L * (high * P + low * (Eigen::Matrix2d::Identity() - P)) * L.transpose();
}

}  // namespace

FootSearch::State FootSearch::at(const Eigen::Vector3d& point, const Sample& place, int order) {
  surface_.evaluate({&place, 1}, order, false, samples_);
  State s;
  s.place = place;
  const Eigen::Vector3d r = samples_.position.row(0).transpose() - point;
  s.f = r.squaredNorm() / 2;
  s.order = samples_.order[0];
  if (s.order == 0 && order > 0 && !is_corner(place, triangles_)) {
    // A side of a surface that has no derivatives there: those from inside.
    const Sample close = inwards(place, std::ldexp(1.0, -24), triangles_);
    surface_.evaluate({&close, 1}, order, false, samples_);
    s.order = samples_.order[0];
  }
  if (s.order == 0) return s;
  const Eigen::Vector3d du = samples_.du.row(0), dv = samples_.dv.row(0);
  s.g = {r.dot(du), r.dot(dv)};
  s.first << du.dot(du), du.dot(dv), du.dot(dv), dv.dot(dv);
  s.first.diagonal().array() += 1e-13 * s.first.trace();  // where tangents are parallel any way downhill will do
  s.exact = s.H = s.first;
  if (s.order == 2) {
    const double uv = r.dot(samples_.duv.row(0));
    s.exact(0, 0) += r.dot(samples_.duu.row(0));
    s.exact(1, 1) += r.dot(samples_.dvv.row(0));
    s.exact(0, 1) += uv;
    s.exact(1, 0) += uv;
    s.H = made_definite(s.exact, s.first);
  }
  return s;
}

Eigen::Vector2d FootSearch::direction(const State& s) const {
  const size_t count = triangles_ ? 3 : 4;
  const auto side = [&](size_t k) -> const Side& { return triangles_ ? triangle_sides[k] : square_sides[k]; };
  // Newton's step, if no side is in the way of it.
  const double det = s.H.determinant();
  Eigen::Vector2d newton(s.H(0, 1) * s.g.y() - s.H(1, 1) * s.g.x(), s.H(0, 1) * s.g.x() - s.H(0, 0) * s.g.y());
  newton = det > 0 ? Eigen::Vector2d(newton / det) : Eigen::Vector2d(-s.g);
  std::array<bool, 4> on{};
  bool blocked = false;
  for (size_t k = 0; k < count; ++k) {
    on[k] = inside(s.place, k, triangles_) <= 0;
    blocked |= on[k] && side(k).normal.dot(newton) > 0;
  }
  if (!blocked) return newton;
  // Along the sides; straight downhill where that leads inside, and much further down.
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = 0;
  bool inward = true;
  for (size_t k = 0; k < count; ++k) {
    if (!on[k]) continue;
    inward &= side(k).normal.dot(s.g) > 0;
    const Eigen::Vector2d& along = side(k).along;
    const double exact = along.dot(s.exact * along), least = 0.02 * along.dot(s.first * along);
    const double curve = std::max(std::abs(exact), least);
    const Eigen::Vector2d d = -(s.g.dot(along) / curve) * along;
    bool possible = curve > 0;
    for (size_t j = 0; j < count; ++j)
      if (j != k && on[j] && side(j).normal.dot(d) > 0) possible = false;
    if (possible && -s.g.dot(d) > most) most = -s.g.dot(d), best = d;
  }
  const double curve = s.g.dot(s.H * s.g), square = s.g.squaredNorm();
  if (inward && curve > 0 && square * square / curve > 100 * most) return -(square / curve) * s.g;
  return best;
}

void FootSearch::descend(const Eigen::Vector3d& point, State& s, int& order) {
  constexpr int most_steps = 40, most_halvings = 12;
  for (int step = 0; step < most_steps && s.order > 0; ++step) {
    if (s.order < 2 && step == 0) order = std::min(order, s.order);
    const Eigen::Vector2d d = direction(s);
    const double slope = s.g.dot(d);
    if (!(slope < 0)) return;
    const bool last = std::sqrt(d.dot(s.first * d)) <= tiny_;
    double t = 1;
    State next;
    bool down = false;
    for (int halving = 0; halving < most_halvings; ++halving, t /= 2) {
      const Sample to = moved(s.place, d, t, triangles_);
      next = at(point, to, order);
      down = next.f <= s.f + 1e-4 * t * slope;
      if (down || last || -t * slope <= 1e-15 * s.f) break;
    }
    if (!down) {
      if (next.f < s.f) s = next;
      return;
    }
    if (next.order == 1 && s.order > 0) {
      // BFGS: what the change of gradients tells of the second derivatives.
      const Eigen::Vector2d dx(next.place.u - s.place.u, next.place.v - s.place.v), dg = next.g - s.g;
      const Eigen::Vector2d Hdx = s.H * dx;
      if (dx.dot(dg) > 1e-3 * dx.dot(s.first * dx) && dx.dot(Hdx) > 0)
        next.exact = next.H = s.H - Hdx * Hdx.transpose() / dx.dot(Hdx) + dg * dg.transpose() / dx.dot(dg);
    }
    s = next;
    if (last) return;
  }
}

Foot FootSearch::operator()(const Eigen::Vector3d& point, const Sample& start, int& order, double nearest) {
  State s = at(point, start, order);
  descend(point, s, order);
  if (s.order == 0) {
    State again = at(point, inwards(s.place, 1.0 / 1024, triangles_), order);
    descend(point, again, order);
    if (again.f < s.f) s = again;
  }
  if (s.order == 0 && 2 * s.f < nearest) probe(point, s, order);
  return {s.place, 2 * s.f};
}

void FootSearch::probe(const Eigen::Vector3d& point, State& s, int& order) {
  const std::array<Eigen::Vector2d, 8> ways{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  for (double h = 1.0 / 16; h > 1e-13;) {
    State best = s;
    for (const Eigen::Vector2d& way : ways) {
      double t = h;
      const State there = at(point, moved(s.place, way, t, triangles_), 0);
      if (there.f < best.f) best = there;
    }
    if (best.f < s.f) {
      s = best;
      State down = at(point, s.place, order);
      descend(point, down, order);
      if (down.f < s.f) s = down;
      if (s.order > 0) return;
    } else {
      h /= 2;
    }
  }
}

}  // namespace sublimit
