// SPDX-License-Identifier: Apache-2.0
#pragma once
// From sums over a surface of a size near 1 about the origin to integrals where the surface is.
#include <string>

#include "sublimit/integrals/detail/surface_sums.h"
#include "sublimit/integrals/limit_integrals.h"

namespace sublimit {

/// Where a surface is moved and scaled to, by a power of two: squares and fifth powers of coordinates neither overflow
/// nor vanish, and differences keep their digits.
class UnitBox {
 public:
  /// @param points  at least one
  explicit UnitBox(const Points& points);

  /// Returns points moved and scaled to the box.
  Points to_unit(const Points& points) const { return (points.rowwise() - middle_) / scale_; }
  /// Returns the length that is 1 in the box.
  double scale() const { return scale_; }

  /// Returns the integrals of the surface.
  /// @param sums          of the surface in the box
  /// @param why_no_solid  why it bounds no solid; empty if it does
  /// @param points        control points, to name one in errors
  /// @throws InvalidMesh  an integral that is larger than numbers are
  LimitIntegrals integrals(const EstimatedSums& sums, std::string why_no_solid, const Points& points) const;

 private:
  Eigen::RowVector3d middle_;
  double scale_;
};

/// Returns the integrals of a surface without faces.
LimitIntegrals no_faces();

}  // namespace sublimit
