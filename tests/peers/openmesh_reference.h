// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenMesh's uniform subdividers, run live, in double throughout.
#include <functional>
#include <optional>
#include <string>

#include "peers/peer_mesh.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

enum class OpenMeshScheme { loop, sqrt3, modified_butterfly, interpolatory_sqrt3, catmull_clark, midpoint };

/// Returns OpenMesh's scheme that corresponds to ours of this name; absent if there is none.
std::optional<OpenMeshScheme> openmesh_scheme(const std::string& name);

/// Precision of the normals of OpenMesh's mesh, the type through which its Loop subdivider passes positions.
/// `single` is that of a mesh whose traits change only the type of points: positions are then rounded to float
/// on the way. The other functions here use `twice`.
enum class OpenMeshNormals { twice, single };

/// Returns the mesh after `levels` steps, made in one call, since the sqrt(3) subdividers count levels from 0
/// in each call.
/// @throws std::runtime_error  a face that OpenMesh does not take
PeerMesh openmesh_refine(const Mesh& mesh, OpenMeshScheme scheme, int levels,
                         OpenMeshNormals normals = OpenMeshNormals::twice);

/// For benchmarks: builds OpenMesh's mesh, and returns a function that refines it in place. The function can be
/// called once, returns the number of vertices, and owns the mesh.
std::function<std::size_t()> openmesh_run(const Mesh& mesh, OpenMeshScheme scheme, int levels);

}  // namespace sublimit::testing
