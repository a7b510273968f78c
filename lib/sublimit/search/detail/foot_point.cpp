// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/foot_point.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace sublimit {

struct FootSearch::State {
  Place place;
  double f = 0;  ///< half the square of the distance
  int order = 0;
  bool by_differences = false;  ///< derivatives are, at a side
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  Eigen::Matrix2d first = Eigen::Matrix2d::Zero();  ///< of first derivatives: their scalar products
  Eigen::Matrix2d exact = Eigen::Matrix2d::Zero();  ///< second derivatives of f, or what stands for them
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();      ///< the same made positive definite
};

namespace {

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

FootSearch::State FootSearch::at(const Eigen::Vector3d& point, const Place& place, int order) {
  const SearchDomain whole(triangles_);
  surface_.evaluate({&place, 1}, order, false, samples_);
  State s;
  s.place = place;
  const Eigen::Vector3d r = samples_.position.row(0).transpose() - point;
  s.f = r.squaredNorm() / 2;
  s.order = samples_.order[0];
  if (s.order == 0) {
    const int side = order > 0 ? whole.border(place) : -1;
    if (side < 0) return s;
    // A border without derivatives: those along it by differences, those across by one from inside.
    constexpr double h = 1.0 / 8192;
    const Eigen::Vector2d along = SearchDomain::along(size_t(side));
    const Eigen::Vector2d in = Eigen::Vector2d::Constant(triangles_ ? 0.375 : 0.5) - Eigen::Vector2d(place.u, place.v);
    double forth = h, back = h, inside = h;
    const Place around[] = {whole.moved(place, along, forth), whole.moved(place, -along, back),
                            whole.moved(place, in, inside)};
    const Eigen::RowVector3d x = samples_.position.row(0);
    surface_.evaluate(around, 0, false, samples_);
    const Eigen::RowVector3d a = (samples_.position.row(0) - samples_.position.row(1)) / (forth + back);
    const Eigen::RowVector3d b = (samples_.position.row(2) - x) / inside;
    Eigen::Matrix2d directions;
    directions << along.transpose(), in.transpose();
    Eigen::Matrix<double, 2, 3> slopes;
    slopes << a, b;
    const Eigen::Matrix<double, 2, 3> J = directions.inverse() * slopes;
    samples_.du.resize(3, 3);
    samples_.dv.resize(3, 3);
    samples_.du.row(0) = J.row(0);
    samples_.dv.row(0) = J.row(1);
    s.order = 1;
    s.by_differences = true;
  }
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

Eigen::Vector2d FootSearch::direction(const State& s, const SearchDomain& domain, bool along_side) {
  const size_t count = domain.num_sides();
  // Newton's step, if no side is in the way of it.
  const double det = s.H.determinant();
  Eigen::Vector2d newton(s.H(0, 1) * s.g.y() - s.H(1, 1) * s.g.x(), s.H(0, 1) * s.g.x() - s.H(0, 0) * s.g.y());
  newton = det > 0 ? Eigen::Vector2d(newton / det) : Eigen::Vector2d(-s.g);
  std::array<bool, 5> on{};
  bool blocked = false;
  for (size_t k = 0; k < count; ++k) {
    on[k] = domain.inside(s.place, k) <= 0;
    blocked |= on[k] && SearchDomain::normal(k).dot(newton) > 0;
  }
  if (!blocked && !along_side) return newton;
  // Along the sides; straight downhill where that leads inside, and much further down.
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = 0;
  bool inward = true;
  for (size_t k = 0; k < count; ++k) {
    if (!on[k]) continue;
    inward &= SearchDomain::normal(k).dot(s.g) > 0;
    const Eigen::Vector2d& along = SearchDomain::along(k);
    const double exact = along.dot(s.exact * along), least = 0.02 * along.dot(s.first * along);
    const double curve = std::max(std::abs(exact), least);
    const Eigen::Vector2d d = -(s.g.dot(along) / curve) * along;
    bool possible = curve > 0;
    for (size_t j = 0; j < count; ++j)
      if (j != k && on[j] && SearchDomain::normal(j).dot(d) > 0) possible = false;
    if (possible && -s.g.dot(d) > most) most = -s.g.dot(d), best = d;
  }
  const double curve = s.g.dot(s.H * s.g), square = s.g.squaredNorm();
  if (!along_side && inward && curve > 0 && square * square / curve > 100 * most) return -(square / curve) * s.g;
  return best;
}

void FootSearch::descend(const Eigen::Vector3d& point, const SearchDomain& domain, State& s, int& order,
                         bool along_side) {
  constexpr int most_steps = 40, most_halvings = 12;
  for (int step = 0; step < most_steps && s.order > 0; ++step) {
    if (s.order < 2 && step == 0 && !s.by_differences) order = std::min(order, s.order);
    const Eigen::Vector2d d = direction(s, domain, along_side);
    const double slope = s.g.dot(d);
    if (!(slope < 0)) return;
    const bool last = std::sqrt(d.dot(s.first * d)) <= tiny_;
    double t = 1;
    State next;
    bool down = false;
    for (int halving = 0; halving < most_halvings; ++halving, t /= 2) {
      const Place to = domain.moved(s.place, d, t);
      next = at(point, to, order);
      down = next.f <= s.f + 1e-4 * t * slope;
      if (down || last || -t * slope <= 1e-15 * s.f) break;
    }
    if (!down) {
      // Where rounding hides which place is nearer, the step that is left there tells.
      const bool flat = next.order == s.order && next.f <= s.f + std::sqrt(s.f) * tiny_;
      if (!flat || -next.g.dot(direction(next, domain, along_side)) > -slope / 4) {
        if (next.f < s.f) s = next;
        return;
      }
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

Foot FootSearch::operator()(const Eigen::Vector3d& point, const Place& start, const SearchDomain& domain, int& order,
                            double nearest) {
  State s = at(point, start, order);
  descend(point, domain, s, order, false);
  if (s.order == 0) {
    State again = at(point, domain.inwards(s.place, 1.0 / 1024), order);
    descend(point, domain, again, order, false);
    if (again.f < s.f) s = again;
  }
  if (s.by_differences) descend(point, SearchDomain(triangles_), s, order, true);  // what is across means little
  if (s.order == 0 && 2 * s.f < nearest) probe(point, s, order);
  return {s.place, 2 * s.f};
}

void FootSearch::probe(const Eigen::Vector3d& point, State& s, int& order) {
  const SearchDomain whole(triangles_);
  const std::array<Eigen::Vector2d, 8> ways{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  for (double h = 1.0 / 16; h > 1e-13;) {
    State best = s;
    for (const Eigen::Vector2d& way : ways) {
      double t = h;
      const State there = at(point, whole.moved(s.place, way, t), 0);
      if (there.f < best.f) best = there;
    }
    if (best.f < s.f) {
      s = best;
      State down = at(point, s.place, order);
      descend(point, whole, down, order, false);
      if (down.f < s.f) s = down;
      if (s.order > 0) return;
    } else {
      h /= 2;
    }
  }
}

}  // namespace sublimit
