// SPDX-License-Identifier: Apache-2.0
// Characteristic polynomials: by FLINT over the rationals, else by Faddeev and LeVerrier; the matrices are small.
#include <flint/fmpq_mat.h>

#include "sublimit/certificates/numbers/detail/flint_value.h"
#include "sublimit/certificates/numbers/detail/polynomial.h"

namespace sublimit {
namespace {

Polynomial rational_characteristic_polynomial(const DenseMatrix<Algebraic>& A) {
  RationalPolynomial p;
  FlintRatio c;
  fmpq_mat_t M;
  fmpq_mat_init(M, A.rows(), A.cols());
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      fmpq_poly_get_coeff_fmpq(fmpq_mat_entry(M, i, j), A(i, j).polynomial(), 0);
  fmpq_mat_charpoly(p, M);
  fmpq_mat_clear(M);
  std::vector<Algebraic> coefficients;
  for (Eigen::Index i = 0; i <= A.rows(); ++i) {
    fmpq_poly_get_coeff_fmpq(c, p, i);
    coefficients.emplace_back(c);
  }
  return Polynomial(std::move(coefficients));
}

}  // namespace

Polynomial characteristic_polynomial(const DenseMatrix<Algebraic>& A) {
  const Eigen::Index n = A.rows();
  bool is_rational = true;
  for (Eigen::Index i = 0; i < A.size(); ++i) is_rational = is_rational && A.data()[i].is_rational();
  if (is_rational && n > 2) return rational_characteristic_polynomial(A);
  std::vector<Algebraic> c(n + 1);
  c[n] = 1;
  // M_k = A M_(k-1) + c_(n-k+1), c_(n-k) = -trace(A M_k)/k.
  DenseMatrix<Algebraic> M = DenseMatrix<Algebraic>::Zero(n, n);
  for (Eigen::Index k = 1; k <= n; ++k) {
    if (k > 1) M = (A * M).eval();
    for (Eigen::Index i = 0; i < n; ++i) M(i, i) += c[n - k + 1];
    Algebraic trace;
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        if (!A(i, j).is_zero() && !M(j, i).is_zero()) trace += A(i, j) * M(j, i);
    c[n - k] = trace * Algebraic::ratio(-1, k);
  }
  return Polynomial(std::move(c));
}

Polynomial products_of_roots(const Polynomial& a, const Polynomial& b) {
  // The Kronecker product of the companion matrices has them as eigenvalues.
  const int m = a.degree(), n = b.degree();
  const auto companion = [](const Polynomial& p, int i, int j) {
    return j == p.degree() - 1 ? -p.coefficients()[i] : Algebraic(i == j + 1 ? 1 : 0);
  };
  DenseMatrix<Algebraic> K(m * n, m * n);
  for (int i = 0; i < m * n; ++i)
    for (int j = 0; j < m * n; ++j) {
      const Algebraic first = companion(a, i / n, j / n);
      K(i, j) = first.is_zero() ? first : first * companion(b, i % n, j % n);
    }
  return characteristic_polynomial(K);
}

Polynomial squares_of_roots(const Polynomial& p) {
  // p(x) p(-x) has even powers only.
  const Polynomial both = p * p.negated();
  std::vector<Algebraic> c;
  for (int i = 0; i <= both.degree(); i += 2) c.push_back(both.coefficients()[i]);
  return Polynomial(std::move(c)).monic();
}

}  // namespace sublimit
