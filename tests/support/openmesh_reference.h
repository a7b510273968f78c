// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenMesh's uniform subdividers, run live, in double throughout.
#include <functional>
#include <optional>
#include <string>

#include "sublimit/mesh/mesh.h"
#include "support/peer_mesh.h"

namespace sublimit::testing {

enum class OpenMeshScheme { loop, sqrt3, modified_butterfly, interpolatory_sqrt3, catmull_clark, midpoint };

/// The scheme that stands for ours of this name, if there is one.
std::optional<OpenMeshScheme> openmesh_scheme(const std::string& name);

/// Of the vectors through which OpenMesh's Loop subdivider passes positions. `single` is what a mesh has whose traits
/// change the type of points and nothing else; positions then are rounded to float on the way. All else here is
/// `twice`.
enum class OpenMeshNormals { twice, single };

/// The mesh after `levels` steps, all in one call: the sqrt(3) subdividers count levels from 0 in every call.
/// @throws std::runtime_error  a face that OpenMesh does not take
PeerMesh openmesh_refine(const Mesh& mesh, OpenMeshScheme scheme, int levels,
                         OpenMeshNormals normals = OpenMeshNormals::twice);

/// For benchmarks: OpenMesh's own mesh, built, and the call that refines it in place; to be made once. It returns the
/// number of vertices; the mesh lives as long as the function.
std::function<std::size_t()> openmesh_run(const Mesh& mesh, OpenMeshScheme scheme, int levels);

}  // namespace sublimit::testing
