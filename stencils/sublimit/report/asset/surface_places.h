// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places relative to corners of control faces instead of addresses, in one way for triangles, quadrilaterals
// and polygons.
#include "sublimit/surface/limit_map.h"

namespace sublimit::asset {

/// Returns the place (a, b) in the square or triangle at a corner: (0, 0) is at the tail of h, a goes along h,
/// b backwards along the half-edge before it. Squares of polygons end in the middle of edges, all others at the
/// next corners.
Place place_at(const Addresses& addresses, const Topology& topology, HalfEdge h, double a, double b);

/// Returns the place at parameter t from the tail of h to its head, in the face of h.
Place place_on(const Addresses& addresses, const Topology& topology, HalfEdge h, double t);

/// Returns true if a face has a square for each corner.
inline bool is_cut(const Addresses& addresses, const Topology& topology, Face f) {
  return !addresses.triangles() && topology.size(f) != 4;
}

/// The second fundamental form as a symmetric tensor in space, the sum of k d d^T over principal curvatures k
/// with directions d. It is equal on both sides of a G^1 seam exactly if the surface is G^2 there. Stored as
/// six numbers; those off the diagonal are multiplied by sqrt 2, so that the norm is that of the tensor.
using Bending = Eigen::Matrix<double, 6, 1>;
std::optional<Bending> bending(const LimitSamples& samples, Index row);

}  // namespace sublimit::asset
