// SPDX-License-Identifier: Apache-2.0
#pragma once
// CGAL's Subdivision_method_3, run live on a Surface_mesh of double points. The Surface_mesh is under the GPL: for
// tests and benchmarks only.
#include <functional>
#include <optional>
#include <string>

#include "peers/peer_mesh.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

enum class CgalScheme { bilinear, catmull_clark, loop, doo_sabin, sqrt3 };

/// Returns CGAL's scheme that corresponds to ours of this name; absent if there is none.
std::optional<CgalScheme> cgal_scheme(const std::string& name);

/// Returns the mesh after `levels` steps, made in one call, since CGAL's sqrt(3) counts levels from 0 in each
/// call.
/// @throws std::runtime_error  a face that CGAL does not take
PeerMesh cgal_refine(const Mesh& mesh, CgalScheme scheme, int levels);

/// For benchmarks: builds CGAL's mesh, and returns a function that refines it in place. The function can be
/// called once, returns the number of vertices, and owns the mesh.
std::function<std::size_t()> cgal_run(const Mesh& mesh, CgalScheme scheme, int levels);

}  // namespace sublimit::testing
