// SPDX-License-Identifier: Apache-2.0
#pragma once
// Refined meshes for who wants points and faces: each row of S is used where it is made, and none is kept.
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// A level without its matrix, and its points.
struct RefinedPoints {
  Level level;
  Points points;
};

/// The last of `levels` levels, with the points that `refine` and its matrices make, in the same order: the same bits
/// where a level takes one step of its scheme.
/// @param mesh      whose positions are refined: one row a vertex
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter     negative `levels`
/// @throws UnsupportedTopology  a face that the scheme cannot take
/// @throws ResourceError        more elements than 32-bit indices, or more memory than the machine has; predicted
/// before
///                              memory is taken
RefinedPoints refine_points(const Scheme<double>& scheme, const ControlMesh& mesh, int levels,
                            const SubdivisionOptions& options = {}, const std::function<void(int)>& progress = {});
/// The same from a control level that is there, for other points.
/// @param points  a row for each of its vertices, any number of columns
/// @throws InvalidParameter  another number of points
RefinedPoints refine_points(const Scheme<double>& scheme, Level control, Points points, int levels,
                            const std::function<void(int)>& progress = {});

}  // namespace sublimit
