// SPDX-License-Identifier: Apache-2.0
#pragma once
// What there is to know of a mesh that no process has whole, before it is refined: the counts of mesh_info.h, and how
// its parts would be.
#include <nlohmann/json.hpp>

#include <map>

#include "sublimit/distributed/jobs/shard_jobs.h"

namespace sublimit {

struct SpreadInfo {
  /// How many there are of each.
  using Histogram = std::map<std::int64_t, std::int64_t>;
  struct Extent {
    std::int64_t least = 0, most = 0;
  };

  // As of `MeshInfo`.
  std::int64_t vertices = 0, edges = 0, faces = 0;
  std::int64_t euler_characteristic = 0, components = 0, boundary_loops = 0;
  Histogram face_sizes, interior_valences, boundary_valences;
  bool triangles = false;
  std::int64_t addresses = 0;
  std::int64_t creases = 0, corners = 0, holes = 0;
  std::string boundary, creasing, smooth_triangles;
  std::vector<std::string> warnings;
  std::string scheme, why_not;

  /// How many there are, of what is no manifold with all its vertices in faces.
  std::int64_t isolated_vertices = 0, nonmanifold_vertices = 0, nonmanifold_edges = 0;

  int parts = 0, rings = 0;  ///< parts, one a rank, and the rings of faces around each
  Extent part_faces, halo_faces;
  /// Of memory, of a rank: the mesh, its part and the rings; tables and points come to it.
  Extent part_bytes;
};

/// All ranks call.
/// @param request  without a scheme: `rings` is what counting takes
/// @throws as `spread_job`, but for a mesh that the scheme does not take, which is an answer
SpreadInfo spread_info(const Ranks& ranks, const MeshRequest& request, SpreadMesh mesh, const std::string& name,
                       const Told& told);

/// As `sublimit info --json` has it, where it has the same.
nlohmann::ordered_json to_json(const SpreadInfo& info, const std::string& name);

}  // namespace sublimit
