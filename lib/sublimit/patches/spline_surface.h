// SPDX-License-Identifier: Apache-2.0
#pragma once
// A tensor product of two B-splines. Control points are a grid, u fastest; faces are the spans of the knots that are
// not empty, u fastest; the square of a face is its span in u times that in v, and derivatives are per unit of it.
//
//   x(f,u,v) = (b_v (x) b_u) x_0       S = S_v (x) S_u
//
// Closed knots give cylinders and tori; a row of equal control points, a pole.
#include "sublimit/patches/knots.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

class SplineSurface : public Patch {
 public:
  /// @throws ResourceError  more control points than 32-bit indices count
  SplineSurface(Knots<double> u, Knots<double> v);

  const Knots<double>& u() const { return u_; }
  const Knots<double>& v() const { return v_; }
  Index num_points() const override { return u_.num_points() * v_.num_points(); }
  Index num_faces() const { return u_.num_faces() * v_.num_faces(); }
  FaceCount faces() const override { return {num_faces(), false}; }

  /// Weights depend on the types of the two spans alone.
  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Sample& sample, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;
  std::string ends(Index face) const override;

  Sample place(const Parameters& parameters) const override;
  Parameters parameters(const Sample& place) const override;
  Lengths lengths(Index face) const override;
  std::optional<BezierRows> bezier(Index face) const override;
  Refined refined() const override;
  /// Places are the Greville abscissae, those outside the domain moved to its ends.
  Net net() const override;

 protected:
  /// Where a whole side of the domain is one point: the limit normal of the pieces around, if these touch one plane and
  /// turn around it once (a sphere's pole, not a cone's).
  Eigen::Vector3d limit_normal(const Points& columns, Coordinates coordinates, const Sample& sample) const override;

 private:
  KnotPlace<double> u_place(const Sample& s) const { return {s.face % u_.num_faces(), s.u}; }
  KnotPlace<double> v_place(const Sample& s) const { return {s.face / u_.num_faces(), s.v}; }

  Knots<double> u_, v_;
};

/// S of a surface with finer knots in one or both directions, or of one degree more: S_v (x) S_u.
/// @throws InvalidParameter  see the same of knots (spline_rows.h)
/// @throws ResourceError     more nonzeros than 32-bit indices count
SparseMatrix refinement_matrix(const SplineSurface& coarse, const SplineSurface& fine);

/// The natural next level: the middle of every span.
SplineSurface halved(const SplineSurface& surface);

/// The outer product of two matrices, blocks of B times the entries of A: columns of B fastest.
/// @throws ResourceError  more nonzeros than 32-bit indices count
SparseMatrix kronecker(const SparseMatrix& A, const SparseMatrix& B);

}  // namespace sublimit
