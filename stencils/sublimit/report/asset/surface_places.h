// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places by corners of control faces instead of by addresses: the same way to say where, on triangles, quadrilaterals
// and polygons.
#include "sublimit/surface/limit_map.h"

namespace sublimit::asset {

/// (a, b) in the square (triangle) of a corner: (0, 0) at the tail of h, a along h, b along the half-edge before it,
/// backwards. Squares of polygons end in the middle of edges, all others at the next corners.
Place place_at(const Addresses& addresses, const Topology& topology, HalfEdge h, double a, double b);

/// The place t on the way from the tail of h to its head, in the face of h.
Place place_on(const Addresses& addresses, const Topology& topology, HalfEdge h, double t);

/// Returns true if a face has a square for each corner.
inline bool is_cut(const Addresses& addresses, const Topology& topology, Face f) {
  return !addresses.triangles() && topology.size(f) != 4;
}

/// Second fundamental form as a tensor in space, symmetric, sum of k d d^T: equal on both sides of a seam exactly if
/// the surface is G^2 there. Six numbers, those beside the diagonal times sqrt 2, so that the norm is that of the
/// tensor.
using Bending = Eigen::Matrix<double, 6, 1>;
std::optional<Bending> bending(const LimitSamples& samples, Index row);

}  // namespace sublimit::asset
