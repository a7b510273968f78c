// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of patches along their lines and sides, which of these are the same curve, and how far they deviate from a
// smooth join.
#include <optional>
#include <span>
#include <vector>

#include "sublimit/patches/joins/edge_deviation.h"
#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit {

/// The place of a patch on a line.
/// @param along  face and place in it of the knots along the line
Place line_place(const PatchColumns& patch, const PatchLine& line, const KnotPlace<double>& along);

/// Points at 0 <= s <= 1, the domain of the knots along the line.
LimitSamples line_samples(const PatchColumns& patch, Coordinates coordinates, const PatchLine& line,
                          std::span<const double> s, int order);

/// The sign of du x dv seen from the join, where the line is u = 1 of a left or u = 0 of a right patch.
double line_sign(const PatchLine& line, bool is_left, bool reversed);

/// A side of a patch by points of it.
struct SideCurve {
  PatchLine line;
  bool is_there = true;  ///< false: poles of its parametrisation on it
  bool is_collapsed = false;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> points{};  ///< evenly spaced in its parameter
  Eigen::RowVector3d low{}, high{};
};

/// The sides of all patches that are not closed there, in order.
std::vector<SideCurve> side_curves(std::span<const PatchColumns> patches, Coordinates coordinates, double same);

/// Returns whether two sides are one curve in one parameter.
/// @return  whether the second one is reversed
std::optional<bool> same_curve(const SideCurve& a, const SideCurve& b, double same);

/// Pairs of sides whose boxes meet, the lesser first, ascending.
std::vector<std::pair<size_t, size_t>> near_pairs(const std::vector<SideCurve>& sides, double same);

/// Where two sides that are no such curves have points in common, on the first one.
struct SideOverlap {
  double begin = 0, end = 1;   ///< of the first side's 0 .. 1
  bool all_of_second = false;  ///< and whether that is all of the second side
};
/// @return  nothing if they have at most a point in common, or less than a thirty-second of the first side
std::optional<SideOverlap> side_overlap(std::span<const PatchColumns> patches, Coordinates coordinates,
                                        const SideCurve& a, const SideCurve& b, double same);

}  // namespace sublimit
