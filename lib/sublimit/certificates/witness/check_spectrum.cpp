// SPDX-License-Identifier: Apache-2.0
// The spectral half of the checker: the eigenpair by an interval Newton step, the rest by norms of powers.
#include <Eigen/LU>

#include "sublimit/certificates/witness/witness_parts.h"

namespace sublimit::witness {
namespace {

using Matrix = DenseMatrix<ComplexBall>;

/// Fourier block k: rows of sector 0 against all sectors. The centre is row 0 of block 0.
Matrix block(const Parts& w, int k) {
  std::map<Spot, Eigen::Index> at;
  if (k == 0 && w.rows.contains({0, 0})) at[{0, 0}] = 0;
  for (const Spot& l : w.labels) at.emplace(l, static_cast<Eigen::Index>(at.size()));
  Matrix B(static_cast<Eigen::Index>(at.size()), static_cast<Eigen::Index>(at.size()));
  for (const auto& [row, i] : at)
    for (const auto& [from, weight] : w.rows.at(row)) {
      const auto j = at.find({from[1], from[2]});
      if (j != at.end())
        B(i, j->second) += weight.enclosure() * ComplexBall::root_of_unity(static_cast<long>(k) * from[0], w.n);
    }
  return B;
}

Ball widened(const Ball& x) {
  Ball r = x;
  arb_add_error_2exp_si(r.get(), -90);
  return r;
}
Ball middle(const Ball& x) {
  Ball r;
  arb_get_mid_arb(r.get(), x.get());
  return r;
}
ComplexBall middle(const ComplexBall& z) { return {middle(z.re()), middle(z.im())}; }
std::complex<double> rough(const ComplexBall& z) { return {z.re().mid(), z.im().mid()}; }

/// Largest sum of moduli of a row.
Ball norm(const Matrix& B) {
  Ball greatest(0);
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    Ball sum(0);
    for (Eigen::Index j = 0; j < B.cols(); ++j) sum += abs(B(i, j));
    arb_max(greatest.get(), greatest.get(), sum.get(), PrecisionScope::bits());
  }
  return greatest;
}

/// All eigenvalues are smaller than lambda, for ||(B/lambda)^m|| < 1.
bool is_smaller(Matrix B, const Ball& lambda) {
  const PrecisionScope precision(64);
  for (Eigen::Index i = 0; i < B.size(); ++i) B.data()[i] /= ComplexBall(lambda);
  for (int squarings = 0; squarings < 14; ++squarings) {
    if (certainly_less(norm(B), Ball(1))) return true;
    B = Matrix(B * B);
  }
  return false;
}

/// B without the eigenvalue of x, whose component `unit` is 1.
Matrix without(const Matrix& B, const std::vector<ComplexBall>& x, Eigen::Index unit) {
  Matrix D = B;
  for (Eigen::Index i = 0; i < B.rows(); ++i)
    for (Eigen::Index j = 0; j < B.cols(); ++j) D(i, j) -= x[static_cast<size_t>(i)] * B(unit, j);
  return D;
}

/// The mirror image of a label: sectors run the other way, x and y change places.
Label mirrored(const Parts& w, Label l) {
  if (l[1] == 0 && l[2] == 0) return l;
  const int sector = (w.n - l[0]) % w.n;
  return l[2] == 0 ? Label{(sector + 1) % w.n, l[1], 0} : Label{sector, l[2], l[1]};
}

bool is_symmetric(const Parts& w) {
  for (const auto& [at, row] : w.rows) {
    const Label image = mirrored(w, {0, at[0], at[1]});
    const auto other = w.rows.find({image[1], image[2]});
    if (other == w.rows.end() || other->second.size() != row.size()) return false;
    for (const auto& [from, weight] : row) {
      Label to = mirrored(w, from);
      if (to[1] != 0 || to[2] != 0) to[0] = (to[0] - image[0] + w.n) % w.n;  // seen from the row's own sector
      const auto same = other->second.find(to);
      if (same == other->second.end() || !(same->second == weight)) return false;
    }
  }
  return true;
}

}  // namespace

void check_spectrum(Parts& w, std::vector<std::string>& problems) {
  const auto fail = [&](const std::string& what) { problems.push_back("spectrum: " + what); };
  if (w.rows.contains({0, 0}) == w.dual)
    return fail(w.dual ? "there is a row of a centre, and a face has no point there"
                       : "the row of the centre is missing");
  for (const auto& [at, row] : w.rows) {
    Exact sum;
    for (const auto& [from, weight] : row) {
      sum += weight;
      if (!w.rows.contains({from[1], from[2]})) return fail("rows use points that have no row");
    }
    if (!sum.is_one()) return fail("a row does not sum to 1");
  }
  if (!is_symmetric(w)) return fail("no mirror symmetry, so lambda need not be real");
  const Matrix B = block(w, 1);
  const auto n = static_cast<size_t>(B.rows());
  std::vector<ComplexBall> x;
  size_t unit = n;
  for (const Spot& l : w.labels) {
    const auto z = w.net.find(l);
    if (z == w.net.end()) return fail("the net has holes");
    if (z->second == ComplexBall(1) && unit == n) unit = x.size();
    x.push_back(z->second);
  }
  if (unit == n || w.net.size() != n)
    return fail("no point of the net is exactly 1, or the net has other points than the rows");
  // Unknowns: x but its component `unit`, whose place lambda takes. F = B x - lambda x.
  const auto F = [&](const std::vector<ComplexBall>& z, const ComplexBall& lambda, size_t i) {
    ComplexBall sum(0);
    for (size_t j = 0; j < n; ++j) sum += B(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * z[j];
    return sum - lambda * z[i];
  };
  const auto slope = [&](const std::vector<ComplexBall>& z, const ComplexBall& lambda, size_t i, size_t j) {
    if (j == unit) return -z[i];
    ComplexBall s = B(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    return i == j ? s -= lambda : s;
  };
  std::vector<ComplexBall> m, wide;
  for (size_t i = 0; i < n; ++i) {
    m.push_back(i == unit ? ComplexBall(1) : middle(x[i]));
    wide.push_back(i == unit ? ComplexBall(1) : ComplexBall(widened(x[i].re()), widened(x[i].im())));
  }
  const ComplexBall m_lambda(middle(w.lambda)), wide_lambda(widened(w.lambda), widened(Ball(0)));
  Eigen::MatrixXcd J(n, n);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < n; ++j)
      J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rough(slope(m, m_lambda, i, j));
  const Eigen::MatrixXcd Y = J.inverse();
  if (!Y.allFinite()) return fail("lambda is no simple eigenvalue");
  // K = m - Y F(m) + (I - Y F'(wide)) (wide - m); inside `wide` it holds the only solution there.
  for (size_t i = 0; i < n; ++i) {
    ComplexBall K = i == unit ? m_lambda : m[i];
    for (size_t j = 0; j < n; ++j) {
      const std::complex<double> y = Y(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      K -= ComplexBall(Ball(y.real()), Ball(y.imag())) * F(m, m_lambda, j);
    }
    for (size_t j = 0; j < n; ++j) {
      ComplexBall rest(i == j ? 1 : 0);
      for (size_t k = 0; k < n; ++k) {
        const std::complex<double> y = Y(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
        rest -= ComplexBall(Ball(y.real()), Ball(y.imag())) * slope(wide, wide_lambda, k, j);
      }
      K += rest * (j == unit ? wide_lambda - m_lambda : wide[j] - m[j]);
    }
    const ComplexBall& whole = i == unit ? wide_lambda : wide[i];
    if (!acb_contains_interior(whole.get(), K.get())) return fail("no eigenvector near the net");
    const bool agrees = i == unit ? w.lambda.contains(K.re()) && K.im().contains_zero() : x[i].contains(K);
    if (!agrees) return fail("the net does not hold the eigenvector");
  }
  if (!certainly_positive(w.lambda) || !certainly_less(w.lambda, Ball(1))) return fail("lambda is not between 0 and 1");
  for (int k = 0; 2 * k <= w.n; ++k) {
    Matrix rest = block(w, k);
    if (k == 0) rest = without(rest, std::vector<ComplexBall>(static_cast<size_t>(rest.rows()), ComplexBall(1)), 0);
    if (k == 1) rest = without(rest, x, static_cast<Eigen::Index>(unit));
    if (!is_smaller(std::move(rest), w.lambda))
      return fail("block " + std::to_string(k) + " may have another eigenvalue as large as lambda");
  }
}

}  // namespace sublimit::witness
