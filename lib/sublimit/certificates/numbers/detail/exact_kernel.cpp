// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/exact_kernel.h"

#include <flint/fmpz_vec.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace sublimit {
namespace {

using PolynomialMatrix = std::vector<std::vector<Polynomial>>;

/// K[x]/(g) as far as lambda sees it: g shrinks while it is used.
class Extension {
 public:
  explicit Extension(const AlgebraicRoot& lambda) : lambda_(lambda), g_(lambda.polynomial()) {}
  const Polynomial& modulus() const { return g_; }

  Polynomial reduced(const Polynomial& p) const { return p.degree() < g_.degree() ? p : divide(p, g_).remainder; }
  Polynomial product(const Polynomial& a, const Polynomial& b) const { return reduced(a * b); }

  /// 1/p, or nothing where p(lambda) = 0.
  std::optional<Polynomial> inverse(const Polynomial& p) {
    for (;;) {
      const Polynomial a = reduced(p);
      if (a.is_zero()) return std::nullopt;
      if (a.degree() == 0) return Polynomial({a.leading().inverse()});
      const Polynomial common = gcd(g_, a);
      if (common.degree() == 0) return inverse_of_coprime(a);
      g_ = lambda_.is_root_of(common) ? common : divide(g_, common).quotient;
    }
  }

 private:
  Polynomial inverse_of_coprime(const Polynomial& a) const {
    Polynomial r0 = g_, r1 = a, t0, t1({1});
    while (r1.degree() > 0) {
      const Division step = divide(r0, r1);
      r0 = std::exchange(r1, step.remainder);
      t0 = std::exchange(t1, t0 - step.quotient * t1);
    }
    return reduced(r1.leading().inverse() * t1);
  }

  const AlgebraicRoot& lambda_;
  Polynomial g_;
};

struct Echelon {
  PolynomialMatrix rows;       ///< reduced, one per pivot
  std::vector<size_t> pivots;  ///< columns
};

/// Bits that a polynomial takes, about.
long length(const Polynomial& p) {
  long bits = 0;
  for (const Algebraic& c : p.coefficients()) {
    const fmpq_poly_struct* q = c.polynomial();
    bits += fmpq_poly_length(q) * std::abs(_fmpz_vec_max_bits(q->coeffs, fmpq_poly_length(q))) +
            static_cast<long>(fmpz_bits(fmpq_poly_denref(q)));
  }
  return bits;
}

Echelon echelon(PolynomialMatrix M, Extension& field) {
  Echelon result;
  const size_t columns = M.empty() ? 0 : M[0].size();
  size_t row = 0;
  for (size_t j = 0; j < columns && row < M.size(); ++j) {
    // Any number that is not zero serves: the shortest is the cheapest to invert, and keeps the others short.
    std::vector<size_t> candidates;
    for (size_t i = row; i < M.size(); ++i)
      if (!M[i][j].is_zero()) candidates.push_back(i);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](size_t a, size_t b) { return length(M[a][j]) < length(M[b][j]); });
    std::optional<Polynomial> inverse;
    size_t pivot = row;
    for (const size_t i : candidates)
      if ((inverse = field.inverse(M[i][j]))) {
        pivot = i;
        break;
      }
    if (!inverse) continue;
    std::swap(M[pivot], M[row]);
    for (size_t c = j; c < columns; ++c)
      if (!M[row][c].is_zero()) M[row][c] = field.product(M[row][c], *inverse);
    for (size_t i = 0; i < M.size(); ++i) {
      if (i == row) continue;
      const Polynomial factor = field.reduced(M[i][j]);
      if (factor.is_zero()) continue;
      for (size_t c = j; c < columns; ++c)
        if (!M[row][c].is_zero()) M[i][c] = field.reduced(M[i][c] - factor * M[row][c]);
      M[i][j] = {};
    }
    result.pivots.push_back(j);
    ++row;
  }
  M.resize(row);
  result.rows = std::move(M);
  return result;
}

PolynomialMatrix shifted(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda) {
  const Polynomial x = lambda.exact() ? Polynomial({*lambda.exact()}) : Polynomial::x();
  PolynomialMatrix M(B.rows(), std::vector<Polynomial>(B.cols()));
  for (Eigen::Index i = 0; i < B.rows(); ++i)
    for (Eigen::Index j = 0; j < B.cols(); ++j) {
      if (!B(i, j).is_zero()) M[i][j] = Polynomial({B(i, j)});
      if (i == j) M[i][j] -= x;
    }
  return M;
}

PolynomialMatrix product(const PolynomialMatrix& A, const PolynomialMatrix& B, const Extension& field) {
  PolynomialMatrix C(A.size(), std::vector<Polynomial>(B.size()));
  for (size_t i = 0; i < A.size(); ++i)
    for (size_t k = 0; k < B.size(); ++k) {
      if (A[i][k].is_zero()) continue;
      for (size_t j = 0; j < B.size(); ++j)
        if (!B[k][j].is_zero()) C[i][j] += field.product(A[i][k], B[k][j]);
    }
  return C;
}

/// Elimination in balls, by the largest pivots, as long as they are certain not to be zero: at least that is the rank.
struct BallElimination {
  std::vector<std::vector<ComplexBall>> rows;  ///< triangular up to the rank; rows and columns are exchanged
  std::vector<size_t> columns;                 ///< what each was
  size_t rank = 0;
};

BallElimination eliminated(const PolynomialMatrix& M, const AlgebraicRoot& lambda, long bits = 128) {
  const PrecisionScope scope(bits);
  const ComplexBall x = lambda.enclosure(bits);
  const size_t n = M.size();
  BallElimination result{std::vector<std::vector<ComplexBall>>(n, std::vector<ComplexBall>(n)), {}, 0};
  auto& [B, columns, rank] = result;
  for (size_t i = 0; i < n; ++i) {
    columns.push_back(i);
    for (size_t j = 0; j < n; ++j)
      if (!M[i][j].is_zero()) B[i][j] = M[i][j].at(x);
  }
  for (; rank < n; ++rank) {
    size_t row = n, column = n;
    double largest = 0;
    for (size_t i = rank; i < n; ++i)
      for (size_t j = rank; j < n; ++j)
        if (const double least = abs(B[i][j]).lower(); least > largest) {
          largest = least;
          row = i;
          column = j;
        }
    if (row == n) break;
    std::swap(B[row], B[rank]);
    std::swap(columns[column], columns[rank]);
    for (std::vector<ComplexBall>& line : B) std::swap(line[column], line[rank]);
    for (size_t i = rank + 1; i < n; ++i) {
      if (B[i][rank] == ComplexBall(0)) continue;
      const ComplexBall factor = B[i][rank] / B[rank][rank];
      for (size_t j = rank + 1; j < n; ++j) B[i][j] -= factor * B[rank][j];
    }
  }
  return result;
}

/// Dimension of the null space of a power of B - lambda, which has one: where certain pivots meet the number of rows or
/// columns that are not zero there is nothing to eliminate exactly.
size_t nullity(const PolynomialMatrix& M, const AlgebraicRoot& lambda, Extension& field) {
  const size_t n = M.size();
  size_t rows = 0, columns = 0;
  for (size_t i = 0; i < n; ++i) {
    bool row = false, column = false;
    for (size_t j = 0; j < n; ++j) {
      row = row || !M[i][j].is_zero();
      column = column || !M[j][i].is_zero();
    }
    rows += row;
    columns += column;
  }
  const size_t most = std::min({rows, columns, n - 1});
  return n - (eliminated(M, lambda).rank == most ? most : echelon(M, field).pivots.size());
}

}  // namespace

std::vector<ComplexBall> ExactKernel::enclosure(int i, long bits) const {
  const PrecisionScope scope(bits);
  const ComplexBall x = lambda.enclosure(bits);
  std::vector<ComplexBall> values;
  for (const Polynomial& entry : vectors[i]) values.push_back(entry.at(x));
  return values;
}

ExactKernel exact_eigenvectors(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda) {
  return exact_chain_ends(B, lambda, 1);
}

ExactKernel exact_chain_ends(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda, int length) {
  Extension field(lambda);
  const PolynomialMatrix M = shifted(B, lambda);
  PolynomialMatrix before, power = M;  // powers length - 1 and length; no matrix for 0
  for (int j = 1; j < length; ++j) {
    before = power;
    power = product(power, M, field);
  }
  const Echelon form = echelon(power, field);
  ExactKernel kernel{lambda, field.modulus(), {}};
  for (size_t j = 0; j < static_cast<size_t>(B.cols()); ++j) {
    if (std::count(form.pivots.begin(), form.pivots.end(), j)) continue;
    std::vector<Polynomial> v(B.cols());
    v[j] = Polynomial({1});
    for (size_t r = 0; r < form.rows.size(); ++r) v[form.pivots[r]] = field.reduced(Polynomial() - form.rows[r][j]);
    if (length == 1) {
      kernel.vectors.push_back(std::move(v));
      continue;
    }
    std::vector<Polynomial> end(B.cols());
    for (size_t i = 0; i < end.size(); ++i)
      for (size_t k = 0; k < v.size(); ++k)
        if (!v[k].is_zero() && !before[i][k].is_zero()) end[i] += field.product(before[i][k], v[k]);
    for (Polynomial& entry : end) entry = field.reduced(entry);
    kernel.vectors.push_back(std::move(end));
  }
  return kernel;
}

std::optional<std::vector<ComplexBall>> enclosed_eigenvector(const DenseMatrix<Algebraic>& B,
                                                             const AlgebraicRoot& lambda, long bits) {
  const BallElimination found = eliminated(shifted(B, lambda), lambda, bits);
  const size_t n = found.rows.size();
  // An eigenvalue leaves at most n - 1 pivots; where all of them are certain, what is left of the last row is zero.
  if (n == 0 || found.rank + 1 != n) return std::nullopt;
  const PrecisionScope scope(bits);
  std::vector<ComplexBall> x(n), result(n);
  x[n - 1] = ComplexBall(1);
  for (size_t i = n - 1; i-- > 0;) {
    ComplexBall sum(0);
    for (size_t j = i + 1; j < n; ++j) sum += found.rows[i][j] * x[j];
    x[i] = ComplexBall(0) - sum / found.rows[i][i];
  }
  for (size_t i = 0; i < n; ++i) result[found.columns[i]] = x[i];
  return result;
}

std::vector<int> jordan_sizes(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda, int multiplicity) {
  if (multiplicity == 1) return {1};
  Extension field(lambda);
  const PolynomialMatrix M = shifted(B, lambda);
  // nullities[j]: of the j-th power.
  std::vector<int> nullities{0};
  for (PolynomialMatrix power = M;; power = product(power, M, field)) {
    nullities.push_back(static_cast<int>(nullity(power, lambda, field)));
    if (nullities.back() >= multiplicity || nullities.back() == nullities[nullities.size() - 2]) break;
  }
  std::vector<int> sizes;
  const auto at_least = [&](size_t j) { return j < nullities.size() ? nullities[j] - nullities[j - 1] : 0; };
  for (size_t j = nullities.size() - 1; j > 0; --j)
    sizes.insert(sizes.end(), at_least(j) - at_least(j + 1), static_cast<int>(j));
  return sizes;
}

}  // namespace sublimit
