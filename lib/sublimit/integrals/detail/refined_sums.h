// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sums over a limit that is not made of polynomials, extrapolated from sums over the meshes of successive
// levels, whose faces are cut into triangles. Such a mesh is closed where the limit is. At level k its sums
// differ from those of the limit by sums of powers q^k: q = 1/4 in regular regions, products of eigenvalues
// around extraordinary vertices. The limit of the sums is extrapolated (sequence_limit.h); the error is
// estimated as twice the difference from the value extrapolated with one level less, at least half of that with
// two levels less.
#include "sublimit/integrals/detail/surface_sums.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// When to stop refining.
struct RefinedSumsOptions {
  double enough = 1e-10;              ///< largest error of all sums, divided by the area, that ends refinement
  std::int64_t most_faces = 1 << 20;  ///< largest number of faces of the last level; level 2 is made in any case
};

/// Returns sums over the limit without its holes, with error estimates.
/// @param points  points of the level; translated and scaled so that they are near 0 and of size about 1
/// @return  the same bits for any number of threads
/// @throws UnsupportedTopology  holes, if faces of a level lie on several of the one before (sqrt3, dual schemes)
/// @throws ResourceError        the second level takes more memory than there is
EstimatedSums refined_sums(const Level& level, const Points& points, const Scheme<double>& scheme,
                           const RefinedSumsOptions& options = {});

}  // namespace sublimit
