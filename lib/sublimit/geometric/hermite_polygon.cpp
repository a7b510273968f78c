// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/hermite_polygon.h"

namespace sublimit {

HermitePoint hermite_point(const ControlPolygon& polygon, Index i) {
  HermitePoint p{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (int c = 0; c < polygon.dimension(); ++c) {
    p.position[c] = polygon.points(i, c);
    p.tangent[c] = polygon.tangents(i, c);
  }
  return p;
}

void set_hermite_point(ControlPolygon& polygon, Index i, const HermitePoint& p) {
  for (int c = 0; c < polygon.dimension(); ++c) {
    polygon.points(i, c) = p.position[c];
    polygon.tangents(i, c) = p.tangent[c];
  }
}

Index num_segments(const ControlPolygon::Curve& curve) {
  return static_cast<Index>(curve.points.size()) - (curve.closed ? 0 : 1);
}

}  // namespace sublimit
