// SPDX-License-Identifier: Apache-2.0
#pragma once
// A mesh that no process has whole: each rank has a run of the vertices and a run of the faces, in the order of
// the file. Vertices and faces of the whole mesh have numbers of 64 bits.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/distributed/ranks.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

struct SpreadMesh {
  Runs vertices, faces;
  Points positions;                         ///< of this rank's run of vertices
  std::vector<std::int32_t> face_sizes;     ///< corners of each face of this rank's run
  std::vector<std::int64_t> face_vertices;  ///< vertices of these faces, one after the other

  // Tags, each on the rank that read it.
  struct Crease {
    std::int64_t tail = 0, head = 0;
    float sharpness = 0;
    std::int64_t number = 0;  ///< position in the file: the last crease of an edge wins
  };
  struct Corner {
    std::int64_t vertex = 0;
    float sharpness = 0;
    std::int64_t number = 0;
  };
  std::vector<Crease> creases;
  std::vector<Corner> corners;
  std::vector<std::int64_t> holes;

  /// Rules and warnings of the file; has no vertices and faces.
  Mesh about;

  /// Values per corner, if the file has them.
  struct FaceVarying {
    std::string name;
    Runs runs;
    Points values;                      ///< values of this rank's run
    std::vector<std::int64_t> indices;  ///< value of each corner of this rank's faces
  };
  std::optional<FaceVarying> face_varying;
};

/// Reads a mesh from a binary .ply, an .obj or a .safetensors. Each rank reads its own part of the file; a
/// sidecar with tags (sidecar.h) is read by all. Collective: all ranks call.
/// @throws FormatError, InvalidMesh, IoError, ResourceError  on all ranks: as `read_mesh`
SpreadMesh read_spread_mesh(const Ranks& ranks, const std::filesystem::path& path);

/// Returns a mesh all of whose vertices and faces are in the runs of the first rank. `mesh` is ignored on the
/// other ranks. Collective: all ranks call.
SpreadMesh spread(const Ranks& ranks, const Mesh& mesh);

/// Cuts every face into a fan of triangles from its first corner, as `triangulated` (prepare.h) does.
/// Collective: all ranks call.
void triangulate(const Ranks& ranks, SpreadMesh& mesh);

/// Checks that the mesh has vertices and faces, and that faces and tags refer to existing ones. Collective: all
/// ranks call.
/// @throws InvalidMesh  on all ranks
void check(const Ranks& ranks, const SpreadMesh& mesh, const std::string& name);

}  // namespace sublimit
