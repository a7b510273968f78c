// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/surface_places.h"
#include "sublimit/source/curvature.h"

#include <cmath>

namespace sublimit::asset {

Place place_at(const Addresses& addresses, const Topology& t, HalfEdge h, double a, double b) {
  const Face f = t.face(h);
  const Index corner = t.corner_index(h);
  if (is_cut(addresses, t, f)) return {addresses.first(f) + corner, a, b};
  const Index address = addresses.first(f);
  if (addresses.triangles()) {
    const double c = 1 - a - b;
    return corner == 0 ? Place{address, a, b} : corner == 1 ? Place{address, c, a} : Place{address, b, c};
  }
  switch (corner) {
    case 0:
      return {address, a, b};
    case 1:
      return {address, 1 - b, a};
    case 2:
      return {address, 1 - a, 1 - b};
    default:
      return {address, b, 1 - a};
  }
}

Place place_on(const Addresses& addresses, const Topology& t, HalfEdge h, double along) {
  if (!is_cut(addresses, t, t.face(h))) return place_at(addresses, t, h, along, 0);
  if (along <= 0.5) return place_at(addresses, t, h, 2 * along, 0);
  return place_at(addresses, t, t.next(h), 0, 2 * (1 - along));
}

std::optional<Bending> bending(const LimitSamples& samples, Index row) {
  const std::optional<Curvature> c = curvature(samples, row);
  if (!c) return std::nullopt;
  const Eigen::Matrix3d B =
      c->k1 * c->direction1 * c->direction1.transpose() + c->k2 * c->direction2 * c->direction2.transpose();
  const double r = std::sqrt(2.0);
  Bending b;
  b << B(0, 0), B(1, 1), B(2, 2), r * B(0, 1), r * B(0, 2), r * B(1, 2);
  return b;
}

}  // namespace sublimit::asset
