// SPDX-License-Identifier: Apache-2.0
#pragma once
// The owners of points on sides and at corners. Any of the faces there may be the owner; but kernels work in registers
// of rows, so every quadrilateral should own two sides and a corner, and no face nearly all of them.
#include "sublimit/eval/face_lattices.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Rule for choosing owners.
enum class OwnerRule {
  balanced,  ///< every face as many points as the others, as far as that is possible
  first,     ///< the face of the lowest number: known from a look at the place alone
};

/// Owners of the points of a mesh's faces, all of which have as many sides as the lattice.
/// @param turn  of each face: its corner that is the lattice's first one
/// @return      without points and addresses
FaceLattices::Arrays face_owners(const Topology& topology, const Lattice& lattice, std::span<const std::int8_t> turn,
                                 OwnerRule rule = OwnerRule::balanced);

}  // namespace sublimit
