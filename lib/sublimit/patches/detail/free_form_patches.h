// SPDX-License-Identifier: Apache-2.0
#pragma once
// Free-form surfaces of a file as patches with their control points.
#include <string>
#include <vector>

#include "sublimit/io/free_form.h"
#include "sublimit/patches/curve_set.h"
#include "sublimit/patches/detail/segment_basis.h"
#include "sublimit/patches/patch_set.h"

namespace sublimit {

/// Knots of one direction of a Bezier or B-spline element: pieces side by side share a control point.
/// @throws InvalidParameter  knots that make no B-spline
Knots<double> free_form_knots(FreeFormBasis basis, const FreeFormDirection& direction);

/// One direction of an element of any other basis.
/// @throws InvalidParameter  as SegmentBasis
SegmentBasis free_form_segments(const FreeForm& shapes, FreeFormBasis basis, const FreeFormDirection& direction);

/// Patches, the columns of their control points, and what each was in the file.
struct [[nodiscard]] FreeFormPatches {
  PatchSet patches;
  Points columns;                  ///< x 3, or x 4, homogeneous, if one of them is rational
  std::vector<std::int64_t> line;  ///< of each patch
};

/// The surfaces of a file: Bezier surfaces of several pieces have knots of full multiplicity; of one whose range cuts
/// its domain the part inside.
/// @throws UnsupportedTopology  no surfaces
/// @throws FormatError          knots that make no B-spline, a degree that is too high, with the line
FreeFormPatches free_form_patches(const FreeForm& shapes, const std::string& name);

/// The space curves of a file as one source: B-splines, pieces in other bases as the Bezier pieces that they are.
struct [[nodiscard]] FreeFormCurves {
  CurveSet curves;
  Points columns;  ///< x 3, or x 4, homogeneous, if one of them is rational; of one curve after the other
  Coordinates coordinates = Coordinates::plain;
  std::vector<std::int64_t> line;  ///< of each curve
};
/// @throws UnsupportedTopology  no curves; one whose range cuts its domain
/// @throws FormatError          knots that make no B-spline, a degree that is too high, with the line
FreeFormCurves free_form_curves(const FreeForm& shapes, const std::string& name);

/// Patches as free-form surfaces, for a file: B-splines, closed ones with repeated points, rational ones with weights
/// behind their points.
/// @param columns  of all patches
/// @throws UnsupportedTopology  a patch that is no B-spline; refined once it may be
/// @throws InvalidParameter     columns of another size
FreeForm to_free_form(const PatchSet& patches, const Points& columns);

}  // namespace sublimit
