// SPDX-License-Identifier: Apache-2.0
#pragma once
// What there is to know of a mesh before it is refined: counts, valences, borders, tags, faults, and whether a scheme
// takes it.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/limit/limit_integrals.h"

namespace sublimit {

struct MeshJob;

struct [[nodiscard]] MeshInfo {
  /// Counts by size or valence.
  using Histogram = std::map<Index, Index>;

  Index vertices = 0, edges = 0, faces = 0;
  Index euler_characteristic = 0, components = 0, boundary_loops = 0;
  Histogram face_sizes, interior_valences, boundary_valences;
  bool triangles = false;  ///< true if addresses are triangles
  Index addresses = 0;     ///< number of faces that places may be on
  Index creases = 0, corners = 0, holes = 0;
  std::string boundary, creasing, smooth_triangles, face_varying;  ///< rules in force, in words
  struct Channel {
    std::string name;
    Index values = 0, numbers = 0;  ///< how many values, of how many numbers each
  };
  std::vector<Channel> channels;
  std::vector<std::string> warnings, faults;

  std::string scheme;                   ///< name of the scheme that was asked about; empty: none
  std::string why_not;                  ///< why the scheme cannot refine the mesh; empty: it can
  std::vector<double> predicted_bytes;  ///< memory of levels 1 to 6
  std::optional<LimitIntegrals> limit;  ///< area, volume and others, if they were asked for
};

/// Returns what is known of a mesh before it is refined.
/// @param triangles  count addresses as for schemes on triangles, whatever the scheme
MeshInfo mesh_info(const MeshJob& job, bool triangles = false);

/// Returns integrals over the limit of a mesh.
/// @throws InvalidOption  no scheme; else as `LimitMap` and `limit_integrals`
LimitIntegrals limit_integrals(const MeshJob& job);

}  // namespace sublimit
