// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/foot_point.h"

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
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();      ///< of f, positive definite
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
  Sample to{s.face, std::clamp(s.u + t * d.x(), 0.0, 1.0), std::clamp(s.v + t * d.y(), 0.0, 1.0)};
  if (hit == 0) to.u = 0;
  if (hit == 1) to.v = 0;
  if (hit == 2 && !triangles) to.u = 1;
  if (hit == 3) to.v = 1;
  if (triangles && (hit == 2 || to.u + to.v > 1)) to.v = 1 - to.u;
  return to;
}

bool is_definite(const Eigen::Matrix2d& H, const Eigen::Matrix2d& first) {
  const double det = H.determinant(), least = 1e-6 * first.determinant();
  return H(0, 0) > 0 && det > least && det > 0;
}

}  // namespace

FootSearch::State FootSearch::at(const Eigen::Vector3d& point, const Sample& place, int order) {
  surface_.evaluate({&place, 1}, order, false, samples_);
  State s;
  s.place = place;
  const Eigen::Vector3d r = samples_.position.row(0).transpose() - point;
  s.f = r.squaredNorm() / 2;
  s.order = samples_.order[0];
  if (s.order == 0) return s;
  const Eigen::Vector3d du = samples_.du.row(0), dv = samples_.dv.row(0);
  s.g = {r.dot(du), r.dot(dv)};
  s.first << du.dot(du), du.dot(dv), du.dot(dv), dv.dot(dv);
  s.H = s.first;
  if (s.order == 2) {
    const double uv = r.dot(samples_.duv.row(0));
    Eigen::Matrix2d H = s.first;
    H(0, 0) += r.dot(samples_.duu.row(0));
    H(1, 1) += r.dot(samples_.dvv.row(0));
    H(0, 1) += uv;
    H(1, 0) += uv;
    if (is_definite(H, s.first)) s.H = H;
  }
  // Where tangents are parallel any direction downhill will do.
  s.H.diagonal().array() += 1e-13 * s.first.trace();
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
  // Along the sides.
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = 0;
  bool inward = true;
  for (size_t k = 0; k < count; ++k) {
    if (!on[k]) continue;
    inward &= side(k).normal.dot(s.g) > 0;
    const Eigen::Vector2d& along = side(k).along;
    const double curve = along.dot(s.H * along);
    const Eigen::Vector2d d = -(s.g.dot(along) / curve) * along;
    bool possible = curve > 0;
    for (size_t j = 0; j < count; ++j)
      if (j != k && on[j] && side(j).normal.dot(d) > 0) possible = false;
    if (possible && -s.g.dot(d) > most) most = -s.g.dot(d), best = d;
  }
  // Straight downhill where that leads inside, and further down.
  const double curve = s.g.dot(s.H * s.g);
  if (inward && curve > 0 && s.g.squaredNorm() * s.g.squaredNorm() / curve > most)
    return -(s.g.squaredNorm() / curve) * s.g;
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
        next.H = s.H - Hdx * Hdx.transpose() / dx.dot(Hdx) + dg * dg.transpose() / dx.dot(dg);
    }
    s = next;
    if (last) return;
  }
}

Foot FootSearch::operator()(const Eigen::Vector3d& point, const Sample& start, int& order) {
  State s = at(point, start, order);
  const auto nudged = [&](const Sample& p) {
    constexpr double in = 1.0 / 1024;
    const double centre = triangles_ ? 1. / 3 : 0.5;
    return Sample{p.face, p.u + in * (centre - p.u), p.v + in * (centre - p.v)};
  };
  descend(point, s, order);
  if (s.order == 0) {
    State again = at(point, nudged(s.place), order);
    descend(point, again, order);
    if (again.f < s.f) s = again;
  }
  return {s.place, 2 * s.f};
}

}  // namespace sublimit
