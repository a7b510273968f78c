// SPDX-License-Identifier: Apache-2.0
// Volumes around extraordinary vertices, which the library sums ring by ring, against their sum in closed form: with A
// the block of a piece whose first child is of its own type, and R the volume of its other children,
//
//   V(x) = R(x) + R(A x) + R(A^2 x) + ...,   V(x) = sum over a, b, c of v_abc det(x_a, x_b, x_c)
//
// where x_a are the coordinates of the points x in the basis of eigenvectors, and v_abc = r_abc / (1 - l_a l_b l_c) by
// the eigenvalues l. As A may have no such basis, Schur's is taken: T = Q* A Q is triangular, with the eigenvalues on
// its diagonal, and v = r + v(T, T, T) is solved from the first vector on.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>
#include <vector>

#include "laws/tested_schemes.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/nets/piece_hull.h"
#include "sublimit/surface/detail/limit_map_parts.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Complex = std::complex<double>;
using Basis = Eigen::MatrixXcd;

/// A trilinear form f(x_a, x_b, x_c) over n vectors.
class Form {
 public:
  explicit Form(Index n) : n_(n), values_(size_t(n * n * n)) {}
  Index n() const { return n_; }
  Complex& operator()(Index a, Index b, Index c) { return values_[size_t((a * n_ + b) * n_ + c)]; }

 private:
  Index n_;
  std::vector<Complex> values_;
};

/// Adds the volume (1/3) X.(X_u x X_v) of a polynomial piece, X = sum of f_a x_a: f_a f_b,u f_c,v / 3.
/// @param M  points of the piece by the basis
void add_polynomial(const PieceType& type, const Basis& M, Form& form) {
  const PiecePolynomial& polynomial = *type.polynomial();
  ASSERT_EQ(polynomial.coefficients.size(), 1u);
  for (const QuadraturePoint& p : polynomial.basis.total() ? triangle_rule(8) : square_rule(6)) {
    Basis f = polynomial.rows({p.u, p.v, 1 - p.u, 1 - p.v}, 1) * (M.bottomRows(M.rows() - 1).rowwise() - M.row(0));
    f.row(0) += M.row(0);  // rows are over differences
    for (Index a = 0; a < form.n(); ++a)
      for (Index b = 0; b < form.n(); ++b)
        for (Index c = 0; c < form.n(); ++c) form(a, b, c) += p.weight / 3 * f(0, a) * f(1, b) * f(2, c);
  }
}

Eigen::MatrixXd block_of(const PieceType& type, const PieceLink& link) {
  return child_points(link, Points(Eigen::MatrixXd::Identity(type.num_slots(), type.num_slots())));
}

/// The part of r that determinants see.
Form antisymmetric(Form& r) {
  Form result(r.n());
  for (Index a = 0; a < r.n(); ++a)
    for (Index b = 0; b < r.n(); ++b)
      for (Index c = 0; c < r.n(); ++c)
        result(a, b, c) = (r(a, b, c) + r(b, c, a) + r(c, a, b) - r(a, c, b) - r(c, b, a) - r(b, a, c)) / 6.0;
  return result;
}

/// v with v = r + v(T, T, T), of an antisymmetric r: where two vectors are the same it is 0, as its product of three
/// eigenvalues 1 is never asked for.
Form geometric_sum(Form r, const Basis& T) {
  Form v(r.n());
  for (Index a = 0; a < r.n(); ++a)
    for (Index b = 0; b < r.n(); ++b)
      for (Index c = 0; c < r.n(); ++c) {
        if (a == b || b == c || a == c) continue;
        Complex sum = r(a, b, c);  // v(a, b, c) is 0 until it is known
        for (Index i = 0; i <= a; ++i)
          for (Index j = 0; j <= b; ++j) {
            const Complex t = T(i, a) * T(j, b);
            for (Index k = 0; k <= c; ++k) sum += t * T(k, c) * v(i, j, k);
          }
        v(a, b, c) = sum / (1.0 - T(a, a) * T(b, b) * T(c, c));
      }
  return v;
}

/// Adds the volume of any piece.
/// @param sums  how many sums of rings there were
void add(const PieceType& type, const Basis& M, Form& form, int& sums, int depth = 0) {
  ASSERT_LE(depth, 12);
  if (type.polynomial()) return add_polynomial(type, M, form);
  const PieceLink* first = nullptr;
  for (const PieceLink& link : type.children())
    if (link.repeats) first = &link;
  if (!first) {
    for (const PieceLink& link : type.children()) add(*link.type, block_of(type, link) * M, form, sums, depth + 1);
    return;
  }
  ++sums;
  const Eigen::ComplexSchur<Eigen::MatrixXd> schur(block_of(type, *first));
  const Basis &Q = schur.matrixU(), C = Q.adjoint() * M;
  Form ring(type.num_slots());
  for (const PieceLink& link : type.children())
    if (&link != first) add(*link.type, block_of(type, link) * Q, ring, sums, depth + 1);
  Form v = geometric_sum(antisymmetric(ring), schur.matrixT());
  for (Index a = 0; a < form.n(); ++a)
    for (Index b = 0; b < form.n(); ++b)
      for (Index c = 0; c < form.n(); ++c)
        for (Index i = 0; i < v.n(); ++i)
          for (Index j = 0; j < v.n(); ++j)
            for (Index k = 0; k < v.n(); ++k) form(a, b, c) += v(i, j, k) * C(i, a) * C(j, b) * C(k, c);
}

/// @return  volume, and how many pieces had sums of rings
std::pair<double, int> closed_sum(const LimitMap& surface, const Points& points) {
  const LimitMap::Parts& parts = surface.parts();
  const LimitMap::Parts::Pieces& pieces = parts.pieces();
  Form form(3);
  int sums = 0;
  for (Index i = 0; i < parts.num_pieces(); ++i)
    add(*pieces.types[size_t(i)], pieces.points_of(i, points).cast<Complex>(), form, sums);
  Form alternating = antisymmetric(form);
  return {6 * alternating(0, 1, 2).real(), sums};
}

/// Valences 3, 4, 5 and 8; creases that pass extraordinary vertices or end there.
TEST(RingSums, AreThoseOfAllRings) {
  Mesh creased = cube(), dart = cube();
  add_crease(creased, {0, 1, 3, 2, 0}, 10);
  add_crease(dart, {0, 1, 3}, 10);
  const std::vector<std::pair<const char*, Mesh>> cases{
      {"catmull-clark", cube()}, {"catmull-clark", prism(5)}, {"catmull-clark", pole(8)}, {"catmull-clark", creased},
      {"catmull-clark", dart},   {"loop", octahedron()},      {"loop", icosahedron()},
  };
  for (const auto& [name, mesh] : cases) {
    const Points points = jittered(mesh, 0.2).positions;
    SCOPED_TRACE(std::string(name) + ", " + std::to_string(points.rows()) + " vertices");
    const LimitMap surface(*find_scheme<double>(name), mesh);
    const LimitIntegrals found = limit_integrals(surface, points);
    const auto [volume, sums] = closed_sum(surface, points);
    ASSERT_TRUE(found.solid) << found.why_no_solid;
    EXPECT_NEAR(found.solid->volume, volume, rounding(10, found.area * diagonal(points)));
    EXPECT_GE(sums, 1);
  }
}

}  // namespace
}  // namespace sublimit::testing
