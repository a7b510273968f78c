// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/leading_pair.h"

#include <acb_mat.h>

#include <cmath>

namespace sublimit {
namespace {

struct AcbMatrix {
  acb_mat_t m;
  AcbMatrix(slong rows, slong columns) { acb_mat_init(m, rows, columns); }
  explicit AcbMatrix(const DenseMatrix<ComplexBall>& B) : AcbMatrix(B.rows(), B.cols()) {
    for (Eigen::Index i = 0; i < B.rows(); ++i)
      for (Eigen::Index j = 0; j < B.cols(); ++j) acb_set(acb_mat_entry(m, i, j), B(i, j).get());
  }
  AcbMatrix(const AcbMatrix&) = delete;
  AcbMatrix& operator=(const AcbMatrix&) = delete;
  ~AcbMatrix() { acb_mat_clear(m); }
};

double modulus(const acb_t z) {
  return std::hypot(arf_get_d(arb_midref(acb_realref(z)), ARF_RND_NEAR),
                    arf_get_d(arb_midref(acb_imagref(z)), ARF_RND_NEAR));
}

}  // namespace

std::optional<LeadingPair> leading_pair(const DenseMatrix<ComplexBall>& B) {
  const long bits = PrecisionScope::bits();
  const slong n = B.rows();
  if (n == 0) return std::nullopt;
  const AcbMatrix A(B);
  AcbMatrix right(n, n);
  acb_ptr values = _acb_vec_init(n);
  acb_mat_approx_eig_qr(values, nullptr, right.m, A.m, nullptr, 0, bits);
  slong first = 0;
  for (slong i = 1; i < n; ++i)
    if (modulus(values + i) > modulus(values + first)) first = i;
  AcbMatrix approximate(n, 1), vector(n, 1);
  for (slong i = 0; i < n; ++i) acb_set(acb_mat_entry(approximate.m, i, 0), acb_mat_entry(right.m, i, first));
  LeadingPair pair;
  acb_mat_eig_enclosure_rump(pair.value.get(), nullptr, vector.m, A.m, values + first, approximate.m, bits);
  _acb_vec_clear(values, n);
  // Any component that is not zero may be one: the largest keeps the balls small.
  slong unit = 0;
  for (slong i = 1; i < n; ++i)
    if (modulus(acb_mat_entry(vector.m, i, 0)) > modulus(acb_mat_entry(vector.m, unit, 0))) unit = i;
  pair.unit = static_cast<size_t>(unit);
  if (!pair.value.is_finite() || !acb_mat_is_finite(vector.m) || acb_contains_zero(acb_mat_entry(vector.m, unit, 0)))
    return std::nullopt;
  const ComplexBall scale(acb_mat_entry(vector.m, unit, 0));
  for (slong i = 0; i < n; ++i)
    pair.vector.push_back(i == unit ? ComplexBall(1) : ComplexBall(acb_mat_entry(vector.m, i, 0)) / scale);
  return pair;
}

DenseMatrix<ComplexBall> deflated(const DenseMatrix<ComplexBall>& B, const std::vector<ComplexBall>& x, size_t unit) {
  DenseMatrix<ComplexBall> D = B;
  for (Eigen::Index i = 0; i < B.rows(); ++i)
    for (Eigen::Index j = 0; j < B.cols(); ++j)
      D(i, j) -= x[static_cast<size_t>(i)] * B(static_cast<Eigen::Index>(unit), j);
  return D;
}

std::optional<long> power_below(DenseMatrix<ComplexBall> B, const Ball& bound, int most) {
  const PrecisionScope precision(64);
  AcbMatrix A(B);
  Ball power = bound, norm;
  for (int k = 0; k <= most; ++k) {
    acb_mat_bound_inf_norm(arb_radref(norm.get()), A.m);
    arf_set_mag(arb_midref(norm.get()), arb_radref(norm.get()));
    mag_zero(arb_radref(norm.get()));
    if (certainly_less(norm, power)) return 1L << k;
    if (!norm.is_finite() || k == most) break;
    acb_mat_sqr(A.m, A.m, 64);
    power *= power;
    // Both sides by the same power of two, lest they vanish.
    const slong exponent = -static_cast<slong>(std::ilogb(std::max(power.mid(), 1e-300)));
    for (slong i = 0; i < B.rows(); ++i)
      for (slong j = 0; j < B.cols(); ++j)
        acb_mul_2exp_si(acb_mat_entry(A.m, i, j), acb_mat_entry(A.m, i, j), exponent);
    arb_mul_2exp_si(power.get(), power.get(), exponent);
  }
  return std::nullopt;
}

}  // namespace sublimit
