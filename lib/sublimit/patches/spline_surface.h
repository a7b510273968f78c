// SPDX-License-Identifier: Apache-2.0
#pragma once
// A tensor product of two B-splines as a linear source: what LimitSurface is for schemes. Control points are a grid, u
// fastest; faces are the spans of the knots that are not empty, u fastest; the square of a face is its span in u times
// that in v, and derivatives are per unit of it.
//
//   x(f,u,v) = (b_v (x) b_u) x_0       S = S_v (x) S_u
//
// Closed knots give cylinders and tori; a row of equal control points, a pole.
#include <span>

#include "sublimit/limit/limit_surface.h"
#include "sublimit/patches/knots.h"
#include "sublimit/patches/rational.h"

namespace sublimit {

class SplineSurface {
 public:
  /// @throws ResourceError  more control points than 32-bit indices count
  SplineSurface(Knots<double> u, Knots<double> v);

  const Knots<double>& u() const { return u_; }
  const Knots<double>& v() const { return v_; }
  Index num_points() const { return u_.num_points() * v_.num_points(); }
  Index num_faces() const { return u_.num_faces() * v_.num_faces(); }

  /// Parameters of the knots, the second way to name a place. A knot belongs to the piece on the side that is asked
  /// for, see Knots.
  struct Parameters {
    double u = 0, v = 0;
    KnotSide u_side = KnotSide::right, v_side = KnotSide::right;
  };
  /// @throws InvalidParameter  outside the domain
  Sample place(const Parameters& parameters) const;
  Parameters parameters(const Sample& place) const;

  /// Rows over the control points, of the face's side at knots. Status: `crease` where the other side has other rows,
  /// of those asked for, else `regular`. Weights depend on the types of the two spans alone.
  /// @throws InvalidParameter  a face that does not exist, parameters outside the square or not finite, another order
  LimitStencil stencil(const Sample& sample, int order = 0) const;

  /// Points with derivatives and normals; in parallel. A place where w = 0 has the status `pole`, one outside its
  /// square `outside`, and nothing else.
  ///
  /// Normals are du x dv, by the order of u and v. Where a whole side of the domain is one point, it is the limit
  /// normal of the pieces around, if these touch one plane and turn around it once (a sphere's pole, not a cone's);
  /// elsewhere parallel derivatives are `undefined-normal`.
  /// @param columns  #points x 3, or x 4 if they are homogeneous
  /// @throws InvalidParameter  an array of another size, another order
  LimitSamples evaluate(const Points& columns, std::span<const Sample> samples, int order = 0,
                        Coordinates coordinates = Coordinates::plain) const;

 private:
  bool is_inside(const Sample& s) const {
    return s.face >= 0 && s.face < num_faces() && s.u >= 0 && s.u <= 1 && s.v >= 0 && s.v <= 1;
  }
  LimitStencil rows(const Sample& sample, int order) const;

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
