// SPDX-License-Identifier: Apache-2.0
#pragma once
// Refines polygons: the matrices S_k of a curve scheme, x_{k+1} = S_k x_k, filled from its masks. Points are in order
// along the curves, one curve after the other.
//
//   const CurveScheme<double> scheme = curve_scheme("four-point");
//   const ControlPolygon polygon = polygon_through(points, true);
//   const std::vector<CurveLevel> levels = refine(scheme, polygon, 3);
//   const Points fine = refinement_matrix(levels) * unknowns(scheme, polygon);
//   const ControlPolygon refined = refined_polygon(levels.back(), fine);
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sublimit/curves/curve_scheme.h"
#include "sublimit/mesh/control_polygon.h"

namespace sublimit {

/// A curve of a level without coordinates.
struct CurveOutline {
  Index size = 0;  ///< number of points
  bool closed = false;
  std::int64_t first = 0;  ///< position of the first point

  bool operator==(const CurveOutline&) const = default;
};

/// A matrix of weights: each row is a stencil, columns ascending.
template <class T>
using CurveMatrix = Eigen::SparseMatrix<T, Eigen::RowMajor, Index>;

/// One level of refined curves.
template <class T>
struct CurveLevelOf {
  int number = 0;    ///< 0 for the control polygon
  int unknowns = 1;  ///< unknowns of every point, whose rows and columns are next to each other
  std::vector<CurveOutline> curves;
  /// The scheme that made the level: limits of the level are limits of this scheme. Null for a level made otherwise.
  std::shared_ptr<const CurveScheme<T>> made_by;
  /// Matrix with x_k = S x_{k-1}; for level 0 the selection of the curves' points from those of the control polygon.
  CurveMatrix<T> S;

  Index num_points() const {
    Index sum = 0;
    for (const CurveOutline& curve : curves) sum += curve.size;
    return sum;
  }
};
using CurveLevel = CurveLevelOf<double>;

/// Returns levels 0 to `levels` of a control polygon.
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter     negative `levels`; a scheme whose masks are missing or not affine
/// @throws InvalidMesh          no curves, an index that points nowhere
/// @throws UnsupportedTopology  a curve of too few points for the scheme
/// @throws ResourceError        more points than 32-bit indices count
[[nodiscard]] std::vector<CurveLevel> refine(const CurveScheme<double>& scheme, const ControlPolygon& polygon,
                                             int levels, const std::function<void(int)>& progress = {});

/// Throws unless a scheme makes the same rows, to the last bit, as the scheme that made a level.
/// @param what  name of what takes limits by `scheme`, for the message: "the limit curve"
/// @throws InvalidParameter  a level that another scheme made
void check_made_by(const CurveLevel& level, const CurveScheme<double>& scheme, const std::string& what);

/// Returns the matrix that makes the last level from the control points: the product of all S.
[[nodiscard]] SparseMatrix refinement_matrix(const std::vector<CurveLevel>& levels);

/// Returns the vector that a scheme's matrices multiply: a row for each point; for a Hermite scheme each is followed by
/// a row with its derivative, the polygon's tangent.
/// @throws InvalidMesh  a Hermite scheme and a polygon without tangents
[[nodiscard]] Points unknowns(const CurveScheme<double>& scheme, const ControlPolygon& polygon);

/// Returns the curves of a level as a polygon without coordinates.
ControlPolygon curve_outlines(const CurveLevel& level);

/// Returns a level as a polygon, whose refinement continues that of the level.
/// @param unknowns  a row for each row of the level's matrix: `refinement_matrix(levels) * unknowns(scheme, polygon)`
ControlPolygon refined_polygon(const CurveLevel& level, const Points& unknowns);

}  // namespace sublimit
