// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tensor product B-spline surfaces. Control points are a grid, u fastest; faces are the spans of the knots that are not
// empty, u fastest.
//
//   const auto u = Knots<double>::closed(2, {0, 1, 2, 3, 4});  // 4 control points around a tube
//   const SplineSurface tube(u, bezier_knots<double>(1));
//   const Points control = Points::Random(tube.num_points(), 3);
//   const LimitSamples samples = tube.evaluate(control, std::vector<Place>{tube.place({.u = 0.5, .v = 0.5})}, 1);
//
// The square of a face is its span in u times that in v, and derivatives are per unit of it. With the basis functions
// b_u and b_v of both directions x(f,u,v) = (b_v (x) b_u) x_0; refinement is S = S_v (x) S_u. Closed knots give
// cylinders and tori; a row of equal control points gives a pole.
#include "sublimit/patches/knots.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

/// A tensor product B-spline surface without control points. It never changes: threads may share it.
class SplineSurface : public Patch {
 public:
  /// Makes the surface of the knots of both directions.
  /// @throws ResourceError  more control points than 32-bit indices count
  SplineSurface(Knots<double> u, Knots<double> v);

  const Knots<double>& u() const { return u_; }
  const Knots<double>& v() const { return v_; }
  Index num_points() const override { return u_.num_points() * v_.num_points(); }
  Index num_faces() const { return u_.num_faces() * v_.num_faces(); }
  FaceCount faces() const override { return {num_faces(), false}; }

  std::vector<Index> slots(Index face) const override;
  /// Computes the weights of a place, which depend on the types of the two spans alone.
  LimitStatus rows(const Place& place, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;
  std::string ends(Index face) const override;

  Place place(const Parameters& parameters) const override;
  Parameters parameters(const Place& place) const override;
  Lengths lengths(Index face) const override;
  std::optional<BezierRows> bezier(Index face) const override;
  Refined refined() const override;
  /// Returns the control net. Its places are the Greville abscissae; those outside the domain are moved to its ends.
  Net net() const override;

 protected:
  /// Returns the limit normal at a point that a whole side of the domain is mapped to, if the pieces around it touch
  /// one plane and go around the point once (a sphere's pole, but not the apex of a cone).
  Eigen::Vector3d limit_normal(const Points& columns, Coordinates coordinates, const Place& place) const override;

 private:
  KnotPlace<double> u_place(const Place& s) const { return {s.face % u_.num_faces(), s.u}; }
  KnotPlace<double> v_place(const Place& s) const { return {s.face / u_.num_faces(), s.v}; }

  Knots<double> u_, v_;
};

/// Returns the matrix S_v (x) S_u that makes the control points of a surface with finer knots in one or both
/// directions, or of one degree more.
/// @throws InvalidParameter  knots of `fine` that lack some of `coarse`, or have another domain
/// @throws ResourceError     more nonzeros than 32-bit indices count
SparseMatrix refinement_matrix(const SplineSurface& coarse, const SplineSurface& fine);

/// Returns the natural next level, with a knot in the middle of every span.
/// @throws InvalidParameter  a span too short to have a middle
SplineSurface halved(const SplineSurface& surface);

/// Returns the Kronecker product of two matrices: blocks of B times the entries of A, rows and columns of B fastest.
/// @throws ResourceError  more nonzeros than 32-bit indices count
SparseMatrix kronecker(const SparseMatrix& A, const SparseMatrix& B);

}  // namespace sublimit
