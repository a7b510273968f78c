// SPDX-License-Identifier: Apache-2.0
#pragma once
// Caps: patches that interpolate the limit around an extraordinary vertex, where it is no polynomial.
//
// Towards the vertex the limit shrinks by its subdominant eigenvalue lambda when its parameters are halved: as r^alpha,
// alpha = -log2 lambda. A patch follows that with a slope that is neither 0 nor infinite if it is fitted over other
// parameters, (u, v) r^(1/alpha - 1), r = u + v - u v on squares and u + v on triangles: r = 1 on the outer sides,
// whose curves stay as they are, so that patches meet their exact neighbours without gaps.
#include <Eigen/Core>

#include <span>
#include <vector>

#include "sublimit/cad/cad_cells.h"
#include "sublimit/cad/limit_quads.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {

/// A cell that is no polynomial, seen from one of its corners.
struct SeenFromCorner {
  Eigen::Vector2d origin;
  Eigen::Matrix2d sides;  ///< by columns
  bool triangle;

  SeenFromCorner(const CadCell& cell, int corner);
  Place place(Index address, double u, double v) const;
  /// The place by whose parameters a cap is fitted.
  Place warped(const Place& place, double exponent) const;
};

/// The corner of each cell that its only child without a polynomial is at; -1 if there is none.
std::vector<int> centres_of(const std::vector<CadCell>& cells);

class CapFitter {
 public:
  /// @param surface  which must stay
  /// @param degree   of the patches: that of the polynomials around them at least
  CapFitter(const LimitMap& surface, const Points& points, int degree);
  CapFitter(const LimitMap&&, const Points&, int) = delete;

  /// Patches of cells that are no polynomials, one of a square, three of a triangle.
  /// @param group  of each cell: those around the same vertex have the same
  std::vector<LimitQuad> caps(const std::vector<CadCell>& cells, std::span<const size_t> group) const;
  /// Makes patches of squares join their exact neighbours with common tangent planes.
  void join(const std::vector<CadCell>& cells, std::span<const size_t> group, std::vector<LimitQuad>& quads) const;
  /// Largest distance of points of each patch from points of the limit near them.
  std::vector<double> deviations(const std::vector<LimitQuad>& quads) const;

 private:
  Place inside(Place place) const;
  /// Exponents of r for the cells of each group, 0 where there is no vertex to shrink to.
  std::vector<double> exponents(const std::vector<CadCell>& cells, std::span<const int> centres,
                                std::span<const size_t> group) const;

  LimitSurface bound_;
  bool triangles_;
  int degree_;
  Eigen::MatrixXd coefficients_;
};

}  // namespace sublimit
