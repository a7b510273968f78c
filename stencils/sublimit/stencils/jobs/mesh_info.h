// SPDX-License-Identifier: Apache-2.0
#pragma once
// Information on a mesh before it is refined: counts, valences, boundaries, tags, faults, and whether a scheme can
// refine it. The function `info` is in sublimit.h:
//
//   const MeshInfo facts = info(read_mesh("torus.obj"), "loop", {.limit = true});
//   std::cout << facts.vertices << " vertices, " << facts.boundary_loops << " boundary loops\n";
//   if (!facts.why_not.empty()) std::cerr << facts.why_not << "\n";
//   if (facts.limit) std::cout << "area " << facts.limit->area << "\n";
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/integrals/limit_integrals.h"

namespace sublimit {

struct MeshJob;

/// Information on a mesh, and on how a scheme refines it. Plain data.
struct [[nodiscard]] MeshInfo {
  /// Number of elements for each size or valence.
  using Histogram = std::map<Index, Index>;

  Index vertices = 0, edges = 0, faces = 0;
  Index euler_characteristic = 0, components = 0, boundary_loops = 0;  ///< components joined by edges
  Histogram face_sizes, interior_valences, boundary_valences;
  bool triangles = false;                     ///< true if the faces of places are triangles, false if they are squares
  Index addresses = 0;                        ///< number of faces of places (`LimitSurface::faces`)
  Index creases = 0, corners = 0, holes = 0;  ///< numbers of tags
  std::string boundary, creasing, smooth_triangles, face_varying;  ///< rules in force, by the words of files
  /// A face-varying channel.
  struct Channel {
    std::string name;
    Index values = 0, numbers = 0;  ///< number of values, and of numbers in each
  };
  std::vector<Channel> channels;
  std::vector<std::string> warnings, faults;  ///< reservations of the reader; errors in the connectivity

  std::string scheme;                   ///< name of the scheme that was asked about; empty: none
  std::string why_not;                  ///< why the scheme cannot refine the mesh; empty: it can
  std::vector<double> predicted_bytes;  ///< memory in bytes that levels 1 to 6 take
  std::optional<LimitIntegrals> limit;  ///< area, volume and other integrals, if they were asked for
};

/// Returns information on the mesh of a job. `info` in sublimit.h is the public function.
/// @param triangles  count faces of places as under schemes for triangles, whatever the scheme
MeshInfo mesh_info(const MeshJob& job, bool triangles = false);

/// Returns integrals over the limit of the mesh of a job.
/// @throws InvalidOption  the job has no scheme; else as `LimitMap` and `limit_integrals`
LimitIntegrals limit_integrals(const MeshJob& job);

}  // namespace sublimit
