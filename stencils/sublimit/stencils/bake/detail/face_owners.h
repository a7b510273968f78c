// SPDX-License-Identifier: Apache-2.0
#pragma once
// The owners of points on sides and at corners of faces. Any face with such a point may own it. Balanced owners
// are faster: kernels work in registers of rows, so every quadrilateral should own about two sides and a
// corner.
#include "sublimit/eval/table/face_lattices.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Rule for choosing owners.
enum class OwnerRule {
  balanced,  ///< faces own equally many points, as far as possible
  first,     ///< the face of the lowest number, which depends on the faces at the point only
};

/// Chooses the owners of the points of all faces, which must have as many sides as the lattice.
/// @param turn  for each face: the corner where its lattice starts
/// @return      lattices without points and addresses
FaceLattices::Arrays face_owners(const Topology& topology, const Lattice& lattice, std::span<const std::int8_t> turn,
                                 OwnerRule rule = OwnerRule::balanced);

}  // namespace sublimit
