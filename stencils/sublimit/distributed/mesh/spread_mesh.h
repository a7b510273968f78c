// SPDX-License-Identifier: Apache-2.0
#pragma once
// A mesh that no process has whole: each has a run of the vertices and a run of the faces, in the order of the file.
// Numbers of the whole have 64 bits.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/distributed/ranks.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

struct SpreadMesh {
  Runs vertices, faces;
  Points positions;                         ///< of the own run
  std::vector<std::int32_t> face_sizes;     ///< likewise
  std::vector<std::int64_t> face_vertices;  ///< of the own faces, one after the other

  // Tags, on whatever rank that read them.
  struct Crease {
    std::int64_t tail = 0, head = 0;
    float sharpness = 0;
    std::int64_t number = 0;  ///< in the file: the last one for an edge wins
  };
  struct Corner {
    std::int64_t vertex = 0;
    float sharpness = 0;
    std::int64_t number = 0;
  };
  std::vector<Crease> creases;
  std::vector<Corner> corners;
  std::vector<std::int64_t> holes;

  /// Rules and warnings of the file: of no vertices and no faces.
  Mesh about;

  /// Values per corner, if the file has them.
  struct FaceVarying {
    std::string name;
    Runs runs;
    Points values;                      ///< of the own run
    std::vector<std::int64_t> indices;  ///< of each corner of the own faces
  };
  std::optional<FaceVarying> face_varying;
};

/// Every rank reads its own bytes of a file: a binary .ply, an .obj or a .safetensors, and nobody the whole. The tags
/// of a sidecar (sidecar.h) are read by all.
/// @throws FormatError, InvalidMesh, IoError, ResourceError  on all ranks: as `read_mesh`
SpreadMesh read_spread_mesh(const Ranks& ranks, const std::filesystem::path& path);

/// A mesh that one process has, spread; of the others what it says is not looked at.
SpreadMesh spread(const Ranks& ranks, const Mesh& mesh);

/// Every face cut into a fan from its first corner, as `triangulated` (prepare.h) cuts them.
void triangulate(const Ranks& ranks, SpreadMesh& mesh);

/// That all numbers are of vertices and faces that there are, and tags of edges that faces have.
/// @throws InvalidMesh  on all ranks
void check(const Ranks& ranks, const SpreadMesh& mesh, const std::string& name);

}  // namespace sublimit
