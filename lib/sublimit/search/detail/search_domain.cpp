// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/search_domain.h"

#include <algorithm>
#include <cmath>

namespace sublimit {
namespace {

double shortened(double x, double step) {
  constexpr int digits = 16;
  const double unit = std::ldexp(1.0, std::max(-60, std::ilogb(step)) - digits);
  return unit < 1e-15 ? x : std::round(x / unit) * unit;
}

}  // namespace

const std::array<Eigen::Vector2d, 5> SearchDomain::normals{{{-1, 0}, {0, -1}, {1, 0}, {0, 1}, {1, 1}}};
const std::array<Eigen::Vector2d, 5> SearchDomain::directions{{{0, 1}, {1, 0}, {0, 1}, {1, 0}, {-1, 1}}};

SearchDomain::SearchDomain(bool triangle, const Place& centre, double radius)
    : triangle_(triangle),
      bounds_{std::max(0.0, centre.u - radius), std::max(0.0, centre.v - radius), std::min(1.0, centre.u + radius),
              std::min(1.0, centre.v + radius)} {}

double SearchDomain::inside(const Place& s, size_t side) const {
  switch (side) {
    case 0:
      return s.u - bounds_[0];
    case 1:
      return s.v - bounds_[1];
    case 2:
      return bounds_[2] - s.u;
    case 3:
      return bounds_[3] - s.v;
    default:
      return 1 - (s.u + s.v);
  }
}

Place SearchDomain::moved(const Place& s, const Eigen::Vector2d& d, double& t) const {
  int hit = -1;
  for (size_t k = 0; k < num_sides(); ++k) {
    const double speed = normals[k].dot(d), room = std::max(0.0, inside(s, k));
    if (speed > 0 && t * speed >= room) {
      t = room / speed;
      hit = int(k);
    }
  }
  const double step = t * d.cwiseAbs().maxCoeff();
  if (!(step > 0)) return s;
  const auto to = [&](double x, double dx, double low, double high) {
    return dx == 0 ? x : std::clamp(shortened(x + t * dx, step), low, high);
  };
  Place place{s.face, to(s.u, d.x(), bounds_[0], bounds_[2]), to(s.v, d.y(), bounds_[1], bounds_[3])};
  if (hit == 0 || hit == 2) place.u = bounds_[size_t(hit)];
  if (hit == 1 || hit == 3) place.v = bounds_[size_t(hit)];
  if (triangle_ && (hit == 4 || place.u + place.v > 1)) place.v = 1 - place.u;
  return place;
}

Place SearchDomain::inwards(const Place& s, double part) const {
  const double centre = triangle_ ? 0.375 : 0.5;
  return {s.face, s.u + part * (centre - s.u), s.v + part * (centre - s.v)};
}

int SearchDomain::border(const Place& s) const {
  const std::array<double, 4> room{s.u, s.v, triangle_ ? 1.0 : 1 - s.u, triangle_ ? 1.0 : 1 - s.v};
  int side = -1, count = 0;
  for (size_t k = 0; k < 4; ++k)
    if (room[k] <= 0) side = int(k), ++count;
  if (triangle_ && s.u + s.v >= 1) side = 4, ++count;
  return count == 1 ? side : -1;
}

}  // namespace sublimit
