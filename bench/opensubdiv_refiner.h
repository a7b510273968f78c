// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenSubdiv's connectivity of an unrefined mesh, from which everything else is made.
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

#include "opensubdiv_peer.h"

namespace sublimit::bench {

/// @throws std::runtime_error  if OpenSubdiv refuses the mesh
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> topology_refiner(const PeerMesh& mesh);

}  // namespace sublimit::bench
