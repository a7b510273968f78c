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

/// Returns the knots of one direction of a Bezier or B-spline element. Adjacent Bezier pieces share a control
/// point.
/// @throws InvalidParameter  knots that make no B-spline
Knots<double> free_form_knots(FreeFormBasis basis, const FreeFormDirection& direction);

/// Returns one direction of an element of any other basis.
/// @throws InvalidParameter  see SegmentBasis
SegmentBasis free_form_segments(const FreeForm& shapes, FreeFormBasis basis, const FreeFormDirection& direction);

/// Patches with the columns of their control points, and the line of each in the file.
struct [[nodiscard]] FreeFormPatches {
  PatchSet patches;
  Points columns;                  ///< #points x 3; homogeneous, x 4, if a patch is rational
  std::vector<std::int64_t> line;  ///< line of each patch in the file
};

/// Returns the surfaces of a file as patches. Bezier surfaces of several pieces get knots of full multiplicity.
/// A surface whose range is smaller than its domain is cut to its range.
/// @throws UnsupportedTopology  no surfaces
/// @throws FormatError          knots that make no B-spline, a degree that is too high, with the line
FreeFormPatches free_form_patches(const FreeForm& shapes, const std::string& name);

/// The space curves of a file as one source: B-splines; curves in other bases are converted to Bezier pieces.
struct [[nodiscard]] FreeFormCurves {
  CurveSet curves;
  Points columns;  ///< curve by curve: #points x 3; homogeneous, x 4, if a curve is rational
  Coordinates coordinates = Coordinates::plain;
  std::vector<std::int64_t> line;  ///< line of each curve in the file
};
/// Returns the curves of a file.
/// @throws UnsupportedTopology  no curves; a curve whose range is smaller than its domain
/// @throws FormatError          knots that make no B-spline, a degree that is too high, with the line
FreeFormCurves free_form_curves(const FreeForm& shapes, const std::string& name);

/// Returns B-spline patches as free-form surfaces for a file. Closed ones have repeated points, rational ones
/// weights after their points.
/// @param columns  control columns of all patches
/// @throws UnsupportedTopology  a patch that is no B-spline; its refinement may be one
/// @throws InvalidParameter     columns of another size
FreeForm to_free_form(const PatchSet& patches, const Points& columns);

}  // namespace sublimit
