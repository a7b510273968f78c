// SPDX-License-Identifier: Apache-2.0
#pragma once
// A point as OpenSubdiv's refiners and stencils sum it; an array of them is an array of coordinates.

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
