// SPDX-License-Identifier: Apache-2.0
#pragma once
// Information on a mesh that no process has whole, before it is refined: the counts of mesh_info.h, and the
// sizes of the parts that it would be divided into.
#include <nlohmann/json.hpp>

#include <map>

#include "sublimit/distributed/jobs/shard_jobs.h"

namespace sublimit {

struct SpreadInfo {
  /// Number of elements by key: by number of corners, or by valence.
  using Histogram = std::map<std::int64_t, std::int64_t>;
  struct Extent {
    std::int64_t least = 0, most = 0;
  };

  // As the fields of `MeshInfo` with these names.
  std::int64_t vertices = 0, edges = 0, faces = 0;
  std::int64_t euler_characteristic = 0, components = 0, boundary_loops = 0;
  Histogram face_sizes, interior_valences, boundary_valences;
  bool triangles = false;
  std::int64_t addresses = 0;
  std::int64_t creases = 0, corners = 0, holes = 0;
  std::string boundary, creasing, smooth_triangles;
  std::vector<std::string> warnings;
  std::string scheme, why_not;

  /// Numbers of elements that a manifold without isolated vertices does not have.
  std::int64_t isolated_vertices = 0, nonmanifold_vertices = 0, nonmanifold_edges = 0;

  int parts = 0, rings = 0;  ///< number of parts, one for each rank; rings of faces around a part
  Extent part_faces, halo_faces;
  /// Memory of a rank in bytes: its run of the mesh, and its part with the rings around it. Tables and results
  /// are not included.
  Extent part_bytes;
};

/// Returns the information on a mesh. Collective: all ranks call.
/// @param request  may be without a scheme; parts then have the one ring that counting needs
/// @param told     called with the steps of the work, see `Told`
/// @throws as `spread_job`, except for a mesh that the scheme does not take: `why_not` of the result says so
SpreadInfo spread_info(const Ranks& ranks, const MeshRequest& request, SpreadMesh mesh, const std::string& name,
                       const Told& told);

/// Returns information as JSON, with the keys of `sublimit info --json` and those that only parts have.
nlohmann::ordered_json to_json(const SpreadInfo& info, const std::string& name);

}  // namespace sublimit
