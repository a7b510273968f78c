// SPDX-License-Identifier: Apache-2.0
#pragma once
// A mesh that no process has whole, with the scheme that is to refine it; and its division into parts.
#include "sublimit/distributed/mesh/gather_part.h"
#include "sublimit/distributed/mesh/partition.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit {

struct SpreadJob {
  std::string name;  ///< name of the mesh in messages
  SpreadMesh mesh;
  Incidence incidence;
  Scheme<double> scheme;
  SchemeOptions options;  ///< options of the scheme
  SubdivisionOptions rules;
  Creasing creasing = Creasing::uniform;  ///< creasing in effect
  bool all_whole = false;                 ///< every face has as many corners as the scheme splits at once (3 or 4)
};

/// Returns the job of a request. Collective: all ranks call.
/// @param request  `strict` is not supported: faults are searched in whole meshes only
/// @param name     name of the mesh for messages
/// @throws InvalidOption, InvalidMesh, UnsupportedTopology  on all ranks: as `mesh_job`; a request with
///                                                          `strict`
SpreadJob spread_job(const Ranks& ranks, const MeshRequest& request, SpreadMesh mesh, const std::string& name);

/// How to divide a mesh into parts.
struct Division {
  int parts = 0;      ///< number of parts; 0: one for each rank
  bool runs = false;  ///< parts are runs of faces in the order of the file, instead of parts with few neighbours
};
/// Returns the part of each face of this rank's run. Collective: all ranks call.
std::vector<int> divided(const Ranks& ranks, const SpreadJob& job, const Division& division);

/// Returns a hash of the faces (`faces_hash`), or of faces, tags and the number of vertices (`mesh_hash`). It
/// is a sum over the mesh, and so does not depend on the ranks' runs. Collective: all ranks call.
std::uint64_t faces_hash(const Ranks& ranks, const SpreadMesh& mesh);
std::uint64_t mesh_hash(const Ranks& ranks, const SpreadMesh& mesh);
/// Returns a hash with another value mixed in, as values are hashed one after the other.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value);
std::string in_hexadecimal(std::uint64_t hash);

}  // namespace sublimit
