// SPDX-License-Identifier: Apache-2.0
#pragma once
// Face-varying channels for test meshes, and their comparison with OpenSubdiv's.
#include <string>
#include <utility>
#include <vector>

#include "meshes/meshes.h"

namespace sublimit::testing {

using Seams = std::vector<std::pair<Index, Index>>;  ///< edges, by their vertices in either order

/// Returns the mesh with a channel of random values in two columns that is continuous across all edges except
/// seams.
/// @param joined  vertices at which all corners have one value despite seams
Mesh with_channel(Mesh mesh, const Seams& seams, const std::vector<Index>& joined = {}, unsigned seed = 1);

/// Returns the mesh with a channel in which each edge is a seam with this probability, and some vertices are
/// joined.
Mesh with_random_channel(Mesh mesh, double probability, unsigned seed = 1);

/// Returns the mesh with new indices where two values alternate around a vertex (a b a b): each run of faces
/// gets its own value, with equal numbers. OpenSubdiv 3.5 treats such a as one value, but each b as a different
/// one (its search for values that occurred before compares with the first value only), so that its refined
/// values depend on the face that it starts from.
Mesh without_turns(Mesh mesh);

inline constexpr FaceVaryingInterpolation all_interpolations[] = {
    FaceVaryingInterpolation::none,          FaceVaryingInterpolation::corners_only,
    FaceVaryingInterpolation::corners_plus1, FaceVaryingInterpolation::corners_plus2,
    FaceVaryingInterpolation::boundaries,    FaceVaryingInterpolation::all};
const char* name(FaceVaryingInterpolation interpolation);

struct ChannelComparison {
  std::string mismatch;  ///< difference in which corners share a value; empty if there is none
  double error = 0;      ///< largest difference of values, all levels, over their range
};
/// Compares levels of the mesh's first channel with OpenSubdiv's, corner by corner, under the mesh's tags.
ChannelComparison compare_channel_with_opensubdiv(const Mesh& mesh, const std::string& scheme,
                                                  FaceVaryingInterpolation interpolation, int levels);

}  // namespace sublimit::testing
