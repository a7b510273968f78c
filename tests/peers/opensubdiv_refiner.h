// SPDX-License-Identifier: Apache-2.0
#pragma once
// An unrefined mesh in OpenSubdiv; only for the implementation of the references.
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

#include "peers/opensubdiv_reference.h"

namespace sublimit::testing {

/// Returns the mesh; `options.levels` is ignored.
/// @throws std::runtime_error  as reference_refine
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> reference_refiner(const Mesh& mesh, const ReferenceOptions& options);

}  // namespace sublimit::testing
