// SPDX-License-Identifier: Apache-2.0
#pragma once
// A spread mesh with the scheme that is to refine it, and its parts.
#include "sublimit/distributed/mesh/gather_part.h"
#include "sublimit/distributed/mesh/partition.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit {

struct SpreadJob {
  std::string name;  ///< of the mesh, in messages
  SpreadMesh mesh;
  Incidence incidence;
  Scheme<double> scheme;
  SchemeOptions options;  ///< of the scheme
  SubdivisionOptions rules;
  Creasing creasing = Creasing::uniform;  ///< in effect
  bool all_whole = false;                 ///< every face has as many corners as the scheme splits without a first step
};

/// @throws InvalidOption, InvalidMesh, UnsupportedTopology  on all ranks: as `mesh_job`; `strict`
SpreadJob spread_job(const Ranks& ranks, const MeshRequest& request, SpreadMesh mesh, const std::string& name);

/// How a mesh is divided.
struct Division {
  int parts = 0;      ///< 0: one a rank
  bool runs = false;  ///< runs of faces as they stand, instead of parts with few neighbours
};
/// Part of each face of the own run.
std::vector<int> divided(const Ranks& ranks, const SpreadJob& job, const Division& division);

/// Hash of faces, or of faces and tags: a sum over the mesh that does not depend on how it is divided.
std::uint64_t faces_hash(const Ranks& ranks, const SpreadMesh& mesh);
std::uint64_t mesh_hash(const Ranks& ranks, const SpreadMesh& mesh);
/// One after the other.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value);
std::string in_hexadecimal(std::uint64_t hash);

}  // namespace sublimit
