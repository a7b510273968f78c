// SPDX-License-Identifier: Apache-2.0
#pragma once
// CGAL's Subdivision_method_3, run live on a Surface_mesh of double points. The Surface_mesh is under the GPL: for
// tests and benchmarks only.
#include <functional>
#include <optional>
#include <string>

#include "sublimit/mesh/mesh.h"
#include "support/peer_mesh.h"

namespace sublimit::testing {

enum class CgalScheme { bilinear, catmull_clark, loop, doo_sabin, sqrt3 };

/// The scheme that stands for ours of this name, if there is one.
std::optional<CgalScheme> cgal_scheme(const std::string& name);

/// The mesh after `levels` steps, all in one call: sqrt(3) counts levels from 0 in every call.
/// @throws std::runtime_error  a face that CGAL does not take
PeerMesh cgal_refine(const Mesh& mesh, CgalScheme scheme, int levels);

/// For benchmarks: CGAL's own mesh, built, and the call that refines it in place; to be made once. It returns the
/// number of vertices; the mesh lives as long as the function.
std::function<std::size_t()> cgal_run(const Mesh& mesh, CgalScheme scheme, int levels);

}  // namespace sublimit::testing
