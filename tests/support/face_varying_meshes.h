// SPDX-License-Identifier: Apache-2.0
#pragma once
// Face-varying channels for meshes that the tests make, and channels beside OpenSubdiv's.
#include <string>
#include <utility>
#include <vector>

#include "support/meshes.h"

namespace sublimit::testing {

using Seams = std::vector<std::pair<Index, Index>>;  ///< edges, by their vertices in either order

/// The mesh with a channel that is continuous across all edges but the seams. Values are random, two columns.
/// @param joined  vertices at which all corners have one value in spite of seams
Mesh with_channel(Mesh mesh, const Seams& seams, const std::vector<Index>& joined = {}, unsigned seed = 1);

/// The same, with every edge a seam with this probability, and some vertices joined.
Mesh with_random_channel(Mesh mesh, double probability, unsigned seed = 1);

/// The mesh with other indices where two values take turns twice around a vertex (a b a b): then each run of faces has
/// a value of its own, with the same numbers. Of such values OpenSubdiv 3.5 takes a for one value and every b for
/// another (its search for values that it met before looks at the first of two only), so that refined values depend on
/// the face it starts from.
Mesh without_turns(Mesh mesh);

inline constexpr FaceVaryingInterpolation all_interpolations[] = {
    FaceVaryingInterpolation::none,          FaceVaryingInterpolation::corners_only,
    FaceVaryingInterpolation::corners_plus1, FaceVaryingInterpolation::corners_plus2,
    FaceVaryingInterpolation::boundaries,    FaceVaryingInterpolation::all};
const char* name(FaceVaryingInterpolation interpolation);

struct ChannelComparison {
  std::string mismatch;  ///< what differs in which corners share a value, empty if nothing does
  double error = 0;      ///< largest difference of values, all levels, over their range
};
/// Our levels of the mesh's first channel against OpenSubdiv's, corner by corner, under the mesh's own tags.
ChannelComparison compare_channel_with_opensubdiv(const Mesh& mesh, const std::string& scheme,
                                                  FaceVaryingInterpolation interpolation, int levels);

}  // namespace sublimit::testing
