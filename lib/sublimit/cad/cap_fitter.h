// SPDX-License-Identifier: Apache-2.0
#pragma once
// Caps: patches that approximate the limit around an extraordinary vertex, where it is no polynomial.
//
// Near the vertex the limit behaves like r^alpha, alpha = -log2 lambda, where lambda is the subdominant
// eigenvalue. A patch has a finite, nonzero slope at the vertex if it is fitted over the parameters (u, v)
// r^(1/alpha - 1), where r = u + v - u v on squares and u + v on triangles. Since r = 1 on the outer sides,
// their curves do not change, and patches meet their exact neighbours without gaps.
#include <Eigen/Core>

#include <span>
#include <vector>

#include "sublimit/cad/cad_cells.h"
#include "sublimit/cad/limit_quads.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {

/// Coordinates of a cell without a polynomial, relative to one of its corners.
struct SeenFromCorner {
  Eigen::Vector2d origin;
  Eigen::Matrix2d sides;  ///< both sides at the corner, as columns
  bool triangle;

  SeenFromCorner(const CadCell& cell, int corner);
  /// Returns the place of parameters relative to the corner.
  Place place(Index address, double u, double v) const;
  /// Returns a place with its parameters multiplied by r^exponent, over which a cap is fitted.
  Place warped(const Place& place, double exponent) const;
};

/// Returns for each cell the corner of its only child without a polynomial; -1 if there is no single one.
std::vector<int> centres_of(const std::vector<CadCell>& cells);

/// Fits caps to a limit surface.
class CapFitter {
 public:
  /// @param surface  must outlive this
  /// @param degree   degree of the caps, at least that of the polynomials around them
  CapFitter(const LimitMap& surface, const Points& points, int degree);
  CapFitter(const LimitMap&&, const Points&, int) = delete;

  /// Returns the caps of cells without polynomials: one for a square, three for a triangle.
  /// @param group  group of each cell; cells around the same vertex are in the same group
  std::vector<LimitQuad> caps(const std::vector<CadCell>& cells, std::span<const size_t> group) const;
  /// Makes patches of squares join their exact neighbours with common tangent planes.
  void join(const std::vector<CadCell>& cells, std::span<const size_t> group, std::vector<LimitQuad>& quads) const;
  /// Returns for each patch the largest distance of its points from nearby points of the limit.
  std::vector<double> deviations(const std::vector<LimitQuad>& quads) const;

 private:
  Place inside(Place place) const;
  /// Returns the exponents of r for the cells of each group; 0 if a group has no vertex to shrink to.
  std::vector<double> exponents(const std::vector<CadCell>& cells, std::span<const int> centres,
                                std::span<const size_t> group) const;

  LimitSurface bound_;
  bool triangles_;
  int degree_;
  Eigen::MatrixXd coefficients_;
};

}  // namespace sublimit
