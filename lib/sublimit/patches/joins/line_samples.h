// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of patches along lines and sides, and the search for sides that are the same curve.
#include <optional>
#include <span>
#include <vector>

#include "sublimit/patches/joins/edge_deviation.h"
#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit {

/// Returns a place on a line as a place of the patch.
/// @param along  place on the knots along the line
Place line_place(const PatchColumns& patch, const PatchLine& line, const KnotPlace<double>& along);

/// Returns points of a line at parameters s; 0 <= s <= 1 is the domain of the knots along it.
LimitSamples line_samples(const PatchColumns& patch, Coordinates coordinates, const PatchLine& line,
                          std::span<const double> s, int order);

/// Returns the sign of du x dv in the orientation of the join, where the line is u = 1 of a left patch, or u =
/// 0 of a right one.
double line_sign(const PatchLine& line, bool is_left, bool reversed);

/// Points of a side of a patch.
struct SideCurve {
  PatchLine line;
  bool is_there = true;  ///< false if the parametrisation has poles on the side
  bool is_collapsed = false;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> points{};  ///< evenly spaced in its parameter
  Eigen::RowVector3d low{}, high{};
};

/// Returns the sides of all patches, in order, without those at which a patch is closed.
std::vector<SideCurve> side_curves(std::span<const PatchColumns> patches, Coordinates coordinates, double same);

/// Returns whether two sides are the same curve with the same parameter.
/// @return  nothing if they are not; else whether the second one is reversed
std::optional<bool> same_curve(const SideCurve& a, const SideCurve& b, double same);

/// Returns pairs of sides whose bounding boxes meet, the lower index first, ascending.
std::vector<std::pair<size_t, size_t>> near_pairs(const std::vector<SideCurve>& sides, double same);

/// The common part of two sides that are not the same curve.
struct SideOverlap {
  double begin = 0, end = 1;   ///< the common part in the parameter 0 .. 1 of the first side
  bool all_of_second = false;  ///< true if the common part is the whole second side
};
/// Returns the common part of two sides.
/// @return  nothing if it is at most a point, or less than 1/32 of the first side
std::optional<SideOverlap> side_overlap(std::span<const PatchColumns> patches, Coordinates coordinates,
                                        const SideCurve& a, const SideCurve& b, double same);

}  // namespace sublimit
