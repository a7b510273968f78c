// SPDX-License-Identifier: Apache-2.0
#pragma once
// The scene of a glTF file: trees of nodes, each with a transform, some with a mesh.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "sublimit/io/detail/gltf_file.h"

namespace sublimit {

/// A mesh where a node puts it.
struct GltfInstance {
  std::int64_t node = -1;  ///< -1: the file has no nodes
  std::int64_t mesh = 0;
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();  ///< to the scene
};

/// Returns the meshes of a file's scene, in the order of its nodes, parents first. The scene is the one that the file
/// names, or else its first one; a file without scenes has all trees of its nodes, or all of its meshes.
/// @param notes  where nodes outside of the scene are told
/// @throws FormatError  nodes that form no trees, transforms that are none
std::vector<GltfInstance> gltf_instances(const GltfFile& file, std::vector<std::string>& notes);

}  // namespace sublimit
