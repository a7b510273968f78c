// SPDX-License-Identifier: Apache-2.0
#pragma once
// Vertices where corners of patches meet: how many, whether they have one tangent plane, and whether the curves between
// the patches can have a G^1 surface at all.
//
// Let c_1 .. c_n be the curves that leave an interior vertex, in order around it, with tangents t_i in one plane of
// normal N, and x_i the patch between c_i and c_{i+1}. G^1 across c_i, derived once along it, has the normal part
//
//   M_i + M_{i-1} = r_i,   M_i = N.x_i,uv / [t_i, t_{i+1}],   r_i = k_i (cot f_{i-1} + cot f_i)
//
// with [a, b] = det(a, b, N), the angle f_i of t_i and t_{i+1} and the normal curvature k_i of c_i. For odd n twists
// M_i exist for any curves; for even n only if the alternating sum of the r_i vanishes. It does if all k_i are those of
// one second fundamental form. Source: Peters 1991, "Smooth interpolation of a mesh of curves"; the normalisation is
// ours.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit {

/// A corner of a patch.
struct PatchCorner {
  std::size_t patch = 0;
  bool u_end = false, v_end = false;  ///< else begin

  bool operator==(const PatchCorner&) const = default;
};

struct SeamVertex {
  std::vector<PatchCorner> corners;  ///< in order around the vertex: neighbours have a side in common
  bool is_interior = false;          ///< the last corner is followed by the first
  std::array<double, 3> point = {};
  /// A side of a corner is one point, derivatives at a corner are parallel, or the surface has no point: nothing below
  /// is filled.
  bool is_degenerate = false;
  double plane_angle = 0;  ///< the greatest of two corners' tangent planes, radians
  bool planes_agree = false;
  /// Interior vertices with one tangent plane: the greatest |M_i + M_{i-1} - r_i|, 1/length. It vanishes where all
  /// patches around are G^1.
  std::optional<double> twist_residual{};
  /// Those of even valence: the alternating sum of the r_i, 1/length, and whether it vanishes.
  std::optional<double> enclosure{};
  std::optional<bool> can_be_enclosed{};

  int valence() const { return static_cast<int>(corners.size()); }
};

/// Vertices at the ends of sides, of patches that are open in both directions; by their first corners.
/// @param seams  of the same patches
std::vector<SeamVertex> seam_vertices(std::span<const PatchColumns> patches, Coordinates coordinates,
                                      const PatchSeams& seams, const JoinTolerance& tolerance = {});

}  // namespace sublimit
