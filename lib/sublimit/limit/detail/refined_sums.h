// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sums over a limit that is not made of polynomials: over the meshes of one level after another, whose faces are cut
// into triangles. Such a mesh is closed where the limit is, and differs from it by powers of numbers below 1 to the
// level: of 1/4 where it is regular, of products of eigenvalues around extraordinary vertices. What the sums tend to is
// extrapolated (sequence_limit.h); their error is twice the difference to what fewer levels give.
#include "sublimit/limit/detail/surface_sums.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

struct RefinedSumsOptions {
  double enough = 1e-10;              ///< errors that end refinement, relative to the area
  std::int64_t most_faces = 1 << 20;  ///< of the last level, where this does not keep it below level 2
};

/// Returns sums over the limit without its holes.
/// @param points  of the level, near 0 and of a size near 1
/// @return  the same bits for any number of threads
/// @throws UnsupportedTopology  holes, if faces of a level lie on several of the one before (sqrt3, dual schemes)
/// @throws ResourceError        the second level takes more memory than there is
EstimatedSums refined_sums(const Level& level, const Points& points, const Scheme<double>& scheme,
                           const RefinedSumsOptions& options = {});

}  // namespace sublimit
