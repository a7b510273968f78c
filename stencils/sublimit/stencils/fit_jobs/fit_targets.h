// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets of fits from a CSV. Its header says what a row is:
//
//   vertex,x,y,z[,nx,ny,nz[,k1,k2,d1x,d1y,d1z]]    the limit of a control vertex, counted from 0; fields of a normal,
//   or
//                                                  of curvatures, may all be empty: that row has none
//   face,u,v,x,y,z[,weight]                        the limit at a place, as `Addresses` numbers them; or
//   patch,u,v,x,y,z[,weight]                       a free-form surface at a place by its own parameters
//
// Every error names file and line.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sublimit/fit/targets.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/source/address.h"

namespace sublimit {

struct FitTargets {
  std::filesystem::path file;
  bool by_place = false;               ///< targets are at places, not at vertices
  bool by_patch = false;               ///< `face` of places is a patch, u and v are its own parameters
  std::vector<VertexTarget> vertices;  ///< in the order of the rows; normals and directions of length 1
  PlaceTargets places;
  std::vector<std::int64_t> lines;  ///< line of the file for each target
  Index num_normals = 0, num_curvatures = 0;

  size_t size() const { return lines.size(); }
  /// Returns "NAME:LINE: " of a target.
  std::string where(size_t target) const;
  Points positions() const;  ///< positions of the targets, one in each row
};

/// Reads targets, and checks everything that can be checked without the mesh.
/// @throws FormatError  another header, no rows; a field that is no number or not finite; two targets on one vertex; a
///                      normal of zero length; curvatures without normal or direction; a direction of zero length or
///                      not in the tangent plane; a negative weight
/// @throws IoError      unreadable
FitTargets read_fit_targets(const std::filesystem::path& path);

/// Checks targets at vertices.
/// @throws FormatError  a target on a vertex that does not exist, is in no face or only in holes
void check_vertices(const FitTargets& targets, const Topology& topology, const std::vector<bool>& holes);
/// Checks targets at places.
/// @throws FormatError  a target on a face that does not exist or is a hole, or outside its face; targets on
///                      patches
void check_places(const FitTargets& targets, const Addresses& addresses, const std::vector<bool>& holes);
/// Returns the targets as targets at places on the faces of patches.
/// @throws FormatError  targets at vertices; a face or patch that does not exist, a place outside of it
FitTargets targets_on(const PatchSet& patches, const FitTargets& targets);

}  // namespace sublimit
