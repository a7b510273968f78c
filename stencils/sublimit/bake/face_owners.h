// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which face has the points on a side or at a corner. Any one of the faces there may; but kernels work in registers of
// rows, so every quadrilateral should have two sides and a corner, and no face nearly all of them.
#include "sublimit/face_lattices.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// How owners are chosen.
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
