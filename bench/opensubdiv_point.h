// SPDX-License-Identifier: Apache-2.0
#pragma once
// The point type for sums of OpenSubdiv's refiners and stencils. An array of points is an array of coordinates.

namespace sublimit::bench {

template <class Real>
struct OpenSubdivPoint {
  Real x, y, z;
  void Clear() { x = y = z = 0; }
  void AddWithWeight(const OpenSubdivPoint& p, Real weight) {
    x += weight * p.x;
    y += weight * p.y;
    z += weight * p.z;
  }
};
static_assert(sizeof(OpenSubdivPoint<float>) == 3 * sizeof(float));
static_assert(sizeof(OpenSubdivPoint<double>) == 3 * sizeof(double));

}  // namespace sublimit::bench
