// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes as files: what is written, and the writer.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

/// A named number for each vertex.
struct VertexValues {
  std::string name;
  std::vector<double> values = {};  ///< #V
  bool whole = false;               ///< written as integers of 32 bits
};

struct MeshOutput {
  Points positions;                  ///< #V x 3
  Points normals;                    ///< #N x 3; no rows: none
  std::vector<Index> face_sizes;     ///< corners of each face, >= 3
  std::vector<Index> face_vertices;  ///< vertices of all faces, one after the other
  /// Normal of each corner, -1 for none. Empty: normals are per vertex, #N = #V.
  /// OBJ has no way to leave out one normal of a face, so it leaves out all normals of a face that lacks one.
  std::vector<Index> face_normals;
  /// Values per corner; OBJ writes the first channel as `vt` and has room for one, of 1 to 3 columns; PLY for none.
  std::vector<ControlMesh::FaceVarying> face_varying;
  Points texture;               ///< #V x 2 texture coordinates per vertex, for PLY (`s`, `t`); no rows: none
  std::vector<Index> face_ids;  ///< of each face: PLY's `face_id`, OBJ's groups `g face_ID`; empty: none
  std::vector<VertexValues> vertex_values;  ///< further properties of a PLY's vertices; OBJ has no place for them

  // Tags, as in ControlMesh; PLY has no place for them.
  std::vector<ControlMesh::Crease> creases;
  std::vector<ControlMesh::Corner> corners;
  std::vector<Index> holes;
  std::vector<ControlMesh::KnotInterval> knot_intervals;
  std::optional<Boundary> boundary;
  std::optional<Creasing> creasing;
  std::optional<Triangles> triangles;
  std::optional<FaceVaryingInterpolation> face_varying_interpolation;

  std::vector<std::string> comments;  ///< at the top of the file
};

/// Returns a control mesh as it is written, tags included.
MeshOutput output(ControlMesh mesh);

/// Writes .obj or .ply, by the extension of `path` in either case. The file appears whole or not at all.
/// @param progress  called with the number of bytes written so far, if given
/// @throws InvalidOption     another extension
/// @throws InvalidParameter  arrays that do not fit together, or normals per corner in a .ply
/// @throws InvalidMesh       coordinates or sharpness that no reader would take back: infinite, not a number, negative
/// @throws IoError           unwritable;  ResourceError  a full disk
/// @note  Rows are formatted by all threads: the same bytes for any number of them.
void write_mesh(const std::filesystem::path& path, const MeshOutput& mesh,
                const std::function<void(std::int64_t)>& progress = {});

/// The checks of `write_mesh`, for writers. Messages start with `name`.
void check_output(const MeshOutput& mesh, const std::string& name);

}  // namespace sublimit
