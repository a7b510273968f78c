// SPDX-License-Identifier: Apache-2.0
#pragma once
// MESH.json next to MESH.obj: subdivision tags with the names of USD, for formats that have no tags, or to
// override the tags of the file.
//
// clang-format off
//     {"creaseIndices": [0, 1, 2, 4, 5],        chains of vertices, one after the other
//      "creaseLengths": [3, 2],                 vertices in each chain, 2 or more
//      "creaseSharpnesses": [2.5, 10],          one for each chain, or one for each edge
//      "cornerIndices": [7], "cornerSharpnesses": [10],
//      "holeIndices": [3],
//      "interpolateBoundary": "none" | "edgeOnly" | "edgeAndCorner",
//      "creaseMethod": "uniform" | "chaikin",
//      "triangleSubdivisionRule": "catmullClark" | "smooth",
//      "faceVaryingLinearInterpolation": "none" | "cornersOnly" | "cornersPlus1" | "cornersPlus2" | "boundaries" | "all"}
// clang-format on
//
// Every key may be left out. A key that is present replaces all tags of its kind.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns the sidecar of a mesh file: the same path with the extension .json, if one of a sidecar's keys is in it and
/// it is no report of this program (its first entry is `"format": "sublimit-..."`). Absent if there is none.
std::optional<std::filesystem::path> find_sidecar(const std::filesystem::path& mesh);

/// Replaces tags of `mesh` by those in a file. Unknown keys, and creases where no face has an edge, become
/// warnings of the mesh.
/// @throws FormatError  not JSON, wrong types or lengths, ids out of range; with the file, the key and the
///                      position. The mesh is then as it was.
/// @throws IoError      missing, unreadable
void apply_sidecar(Mesh& mesh, const std::filesystem::path& path);

/// Returns the text of a sidecar.
/// @throws IoError  missing, unreadable;  ResourceError  longer than a job may take
std::string sidecar_text(const std::filesystem::path& path);

/// Numbers of elements of a mesh that is stored elsewhere.
struct MeshCounts {
  Index vertices = 0, faces = 0;
};

/// Applies the text of a sidecar; messages start with `name`.
/// @param elsewhere  if given, `mesh` gets only the tags of a mesh of this size; creases are not checked to be edges
void apply_sidecar_text(Mesh& mesh, std::string_view text, std::string_view name,
                        const std::optional<MeshCounts>& elsewhere = {});

}  // namespace sublimit
