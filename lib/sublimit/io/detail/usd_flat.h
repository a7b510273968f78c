// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scenes of USD in which meshes become others: their properties are replaced in the text, all else stays byte for byte.
// Meshes that come from other layers are overridden in the first one.
//
//   std::vector<UsdFlat> flats = ...;  // triangles of each mesh of usd_meshes(stage, warnings)
//   write(flattened_layer(stage, flats, warnings));
#include <string>
#include <vector>

#include "sublimit/io/detail/usd_mesh.h"

namespace sublimit {

/// What a mesh of a scene becomes.
struct UsdFlat {
  const UsdMesh* from = nullptr;
  /// Triangles with the values and channels of `mesh_of`, of the first time, in the space of the prim. Normals are per
  /// corner: row `face_normals[c]` for corner c.
  Mesh mesh = {};
  std::vector<Index> faces = {};     ///< face of `from->mesh` for each triangle
  std::vector<Points> points = {};   ///< at each of `from->times`; empty if points do not move
  std::vector<Points> normals = {};  ///< at each of these times, a row for each corner
};

/// Returns the text of the scene's first layer with these meshes, `subdivisionScheme = "none"`.
/// @param warnings  gets what could not be kept, with its place
std::string flattened_layer(const UsdStage& stage, const std::vector<UsdFlat>& flats,
                            std::vector<std::string>& warnings);

/// Returns a layer as a file alone.
/// @param name      of the file, for messages
/// @param warnings  gets what is missing there: other files of a package
std::string flattened_text(const UsdStage& stage, const std::string& layer, const std::string& name,
                           std::vector<std::string>& warnings);
/// Returns a package with a layer and the other files of the scene's package.
/// @param warnings  gets what is missing there: files beside a scene that is no package
/// @throws ResourceError  as `format_usdz`
std::string flattened_package(const UsdStage& stage, const std::string& layer, const std::string& name,
                              std::vector<std::string>& warnings);

}  // namespace sublimit
