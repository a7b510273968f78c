// SPDX-License-Identifier: Apache-2.0
#pragma once
// For the files of the reference alone: a mesh as OpenSubdiv has it, not refined yet.
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

#include "support/opensubdiv_reference.h"

namespace sublimit::testing {

/// `options.levels` plays no part.
/// @throws std::runtime_error  as reference_refine
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> reference_refiner(const Mesh& mesh, const ReferenceOptions& options);

}  // namespace sublimit::testing
