// SPDX-License-Identifier: Apache-2.0
#pragma once
// Coons patches: surfaces with given boundary curves on the unit square,
//
//   c0(u) = S(u,0), c1(u) = S(u,1), d0(v) = S(0,v), d1(v) = S(1,v)
//
// as boolean sums (boolean_sum.h) with linear blending, with cubic blending (cross derivatives depend on the ends of
// the side curves alone, so that patches over a C^1 network join C^1), or with given cross derivatives. Of splines
// these are splines: the exact net, linear in the control points of the curves. Source: Coons 1967, "Surfaces for
// computer-aided design of space forms"; Gregory 1974.
#include <array>
#include <string>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Blending functions.
enum class CoonsBlending {
  bilinear,  ///< 1 - t, t: degree at least 1 in each direction; Greville abscissae as weights
  bicubic,   ///< F1, F2: degree at least 3; twists at the corners are 0
};

/// The boundary curves c0, c1, d0, d1; for general patches also the cross derivatives S_v(u,0), S_v(u,1),
/// S_u(0,v), S_u(1,v).
using CoonsBoundary = std::array<CurveNet, 4>;
using CoonsFields = std::array<CurveNet, 4>;

/// Names of curves and fields in messages and files.
inline constexpr const char* coons_names[] = {"c0", "c1", "d0", "d1", "xv0", "xv1", "xu0", "xu1"};
/// Names of the corners (0,0), (1,0), (0,1), (1,1), in this order.
inline constexpr const char* coons_corners[] = {"(0,0)", "(1,0)", "(0,1)", "(1,1)"};

/// Returns the builder of the net over the control points of c0, c1, d0, d1, one curve after the other. Corners
/// are taken from c0 and c1.
/// @param knots  knots of the curves, with interpolated ends
/// @throws InvalidParameter  curves that are not on [0, 1] or whose ends are not interpolated, naming the curve
NetBuilder coons_builder(const std::array<Knots<double>, 4>& knots, CoonsBlending blending);
/// Returns the builder of general Coons patches, over the control points of c0, c1, d0, d1, xv0, xv1, xu0, xu1, and the
/// twists S_uv at (0,0), (1,0), (0,1), (1,1).
NetBuilder general_coons_builder(const std::array<Knots<double>, 8>& knots);

/// Distance of the ends of curves at a corner.
struct CornerGap {
  double distance = 0;
  std::string corner{}, curves{};
};
/// Returns the largest gap. Rational curves are compared by their columns: weights have to agree too.
CornerGap boundary_gap(const CoonsBoundary& curves);

/// Returns the default tolerance, 1e-9 of the size of the data. Gaps up to the tolerance count as rounding:
/// corners are then averaged.
double default_gap(const CoonsBoundary& curves);

/// Returns the Coons patch of four boundary curves.
/// @param tolerance  largest gap at a corner; < 0: default_gap
/// @throws InvalidParameter  curves that are not on [0, 1], naming the curve
/// @throws InvalidMesh       a larger gap at a corner, naming the corner, the curves and the gap
SplineNet coons(const CoonsBoundary& curves, CoonsBlending blending, double tolerance = -1);

/// Returns the patch with given cross derivatives ("general bicubic"), of degree at least 3. It reproduces
/// every bicubic surface from its own data.
/// @param twists     4 x 3: S_uv at (0,0), (1,0), (0,1), (1,1)
/// @param tolerance  largest gap at corners, ends of fields and twists; < 0: default_gap
/// @throws InvalidParameter  see `coons`; rational curves
/// @throws InvalidMesh       see `coons`; cross derivatives whose end values are not the derivatives of the
///                           side curves, or whose derivatives are not the twists, naming corner and gap (for
///                           fields that disagree use gregory_patch)
SplineNet general_coons(const CoonsBoundary& curves, const CoonsFields& fields, const Points& twists,
                        double tolerance = -1);

/// Data that general_coons and gregory_patch share, checked except for the twists.
struct CheckedCoons {
  std::array<CurveNet, 8> curves;  ///< curves and fields with interpolated ends and common corners
  /// Derivatives of the fields at the corners, a row for each of coons_corners: d/du of xv, and d/dv of xu.
  Points twists_of_xv, twists_of_xu;
  double tolerance = 0;

  /// Returns the data of general_coons_builder: control points curve by curve, then twists.
  Points data(const Points& twists) const;
  std::array<Knots<double>, 8> knots() const;
};
/// Returns the checked data.
/// @throws InvalidParameter, InvalidMesh  see general_coons, except for twists
CheckedCoons checked_coons(const CoonsBoundary& curves, const CoonsFields& fields, double tolerance);

}  // namespace sublimit
