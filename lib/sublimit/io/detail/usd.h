// SPDX-License-Identifier: Apache-2.0
#pragma once
// Universal Scene Description as text, `.usda` and packages `.usdz` of it.
//
// Read: meshes of the scene with all attributes of subdivision, transforms, primvars, subsets of faces and materials.
// Vertex primvars are `vertex_values` (`displayColor` is red, green, blue, `displayOpacity` alpha), uniform ones
// `face_values`, face-varying ones channels; constant colours are colours of faces. Values that are `varying`, and no
// others, make the rule linear. Positions at the first time.
//
// Written: one mesh for each object whose vertices are its own, otherwise one with subsets of faces. Numbers have all
// digits of a double also where the type says float: other readers round them.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads all meshes of a scene as one.
/// @throws FormatError    not text, a binary layer, a statement that cannot be read
/// @throws InvalidMesh    no mesh; faces, tags that do not fit; prims with other rules
/// @throws IoError        missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
Mesh read_usd(const std::filesystem::path& path);
/// Reads the same from bytes; what the scene refers to beside itself is missing.
Mesh parse_usd(std::string_view bytes, std::string_view name);

/// Returns a mesh as the text of a layer. A mesh without objects is the prim `mesh`.
/// @throws InvalidParameter  arrays that do not fit together
/// @throws InvalidMesh       numbers that are not finite
std::string format_usda(const Mesh& mesh);
/// Writes a mesh to a layer, which appears whole or not at all.
void write_usda(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress = {});
/// Writes a mesh to a package with one layer.
void write_usdz(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
