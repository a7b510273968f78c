// SPDX-License-Identifier: Apache-2.0
#pragma once
// Vertices at which corners of patches meet: their valence, whether they have a common tangent plane, and
// whether a G^1 surface through the curves between the patches exists.
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
  bool u_end = false, v_end = false;  ///< true: at the end of u (v); false: at its beginning

  bool operator==(const PatchCorner&) const = default;
};

/// A vertex.
struct SeamVertex {
  std::vector<PatchCorner> corners;  ///< in order around the vertex; consecutive ones share a side
  bool is_interior = false;          ///< the last corner is followed by the first
  std::array<double, 3> point = {};
  /// True if a side at a corner is collapsed, derivatives at a corner are parallel, or the surface has a pole.
  /// The members below are then not set.
  bool is_degenerate = false;
  double plane_angle = 0;  ///< largest angle between tangent planes of two corners, radians
  bool planes_agree = false;
  /// Interior vertices with a common tangent plane: the largest |M_i + M_{i-1} - r_i|, 1/length. It vanishes if
  /// all patches around join G^1.
  std::optional<double> twist_residual{};
  /// Such vertices of even valence: the alternating sum of the r_i, 1/length, and whether it vanishes.
  std::optional<double> enclosure{};
  std::optional<bool> can_be_enclosed{};

  int valence() const { return static_cast<int>(corners.size()); }
};

/// Returns the vertices at the ends of sides of patches that are open in both directions, ordered by first
/// corner.
/// @param seams  seams of the same patches
std::vector<SeamVertex> seam_vertices(std::span<const PatchColumns> patches, Coordinates coordinates,
                                      const PatchSeams& seams, const JoinTolerance& tolerance = {});

}  // namespace sublimit
