// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which face has the points on a side or at a corner: of an edge the face of its first half-edge, of a vertex that of
// the first half-edge that leaves it.
#include "sublimit/face_lattices.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Owners of the points of a mesh's faces, all of which have as many sides as the lattice.
/// @param turn  of each face: its corner that is the lattice's first one
/// @return      without points and addresses
FaceLattices::Arrays face_owners(const Topology& topology, const Lattice& lattice, std::span<const std::int8_t> turn);

}  // namespace sublimit
