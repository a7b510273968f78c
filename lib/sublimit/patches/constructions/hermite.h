// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bicubic patches from corners, tangents and twists, as Bezier nets:
//
//   S(u,v) = [F1 F2 F3 F4](u) G [F1 F2 F3 F4](v)^T
//
// Source: Ferguson 1964, "Multivariable curve interpolation"; Adini's twists after Barnhill (see Farin 2002, "Curves
// and Surfaces for CAGD", section 22).
#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Vectors given at each corner.
enum class HermiteVectors {
  twelve,   ///< points and tangents; twists are 0
  sixteen,  ///< points, tangents and twists
  adini,    ///< points and tangents; twists are those of the bilinear Coons patch of the four boundary curves
};
/// Names in files, by HermiteVectors.
inline constexpr const char* hermite_vectors_names[] = {"12", "16", "adini"};

/// Returns the builder of the net over p, p_u, p_v and, with sixteen vectors, p_uv: four rows each, at (0,0),
/// (1,0), (0,1), (1,1). Weights of p sum to 1; the other data are vectors.
NetBuilder hermite_builder(HermiteVectors vectors);

/// Returns the patch of given data.
/// @param data  12 x 3, or 16 x 3 with sixteen vectors
/// @throws InvalidParameter  another number of rows
SplineNet hermite_patch(HermiteVectors vectors, const Points& data);

}  // namespace sublimit
