// SPDX-License-Identifier: Apache-2.0
#include "truth/closed_form.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <numbers>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

}  // namespace

IsolatedLimit isolated_centre(const std::string& name, int n, const SchemeOptions& options) {
  const Scheme<double> scheme = find_scheme(name, options).value();
  return isolated_limit(scheme, {.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = n})
      .value();
}

void expect_eigenvalues(const LocalSpectrum& spectrum, int k, std::vector<Precise> values) {
  ASSERT_EQ(spectrum.size(k), std::ssize(values)) << "n = " << spectrum.n() << ", block " << k;
  const auto same = [](const Precise& a) { return [a](const Precise& b) { return abs(a - b) < Precise("1e-45"); }; };
  for (const Precise& value : values)
    EXPECT_EQ(spectrum.multiplicity(k, value), std::count_if(values.begin(), values.end(), same(value)))
        << static_cast<double>(value) << ", n = " << spectrum.n() << ", block " << k;
}

void expect_tangents(const Eigen::VectorXd& tangent1, const Eigen::VectorXd& tangent2, const Eigen::VectorXd& cosines,
                     const Eigen::VectorXd& sines) {
  ASSERT_EQ(tangent1.size(), cosines.size());
  Eigen::MatrixXd expected(cosines.size(), 2), ours(cosines.size(), 2);
  expected << cosines, sines;
  ours << tangent1, tangent2;
  const Eigen::Matrix2d within = PivotedQr(expected).solve(ours);
  EXPECT_LE((ours - expected * within).norm(), closed_form * ours.norm());
  EXPECT_GT(within.determinant(), 0);
}

void expect_first_mode(const IsolatedLimit& limit, int n, int first) {
  const LimitMasks::Side& side = limit.masks.sides.at(0);
  Eigen::VectorXd cosines = Eigen::VectorXd::Zero(side.tangent1.size()), sines = cosines;
  ASSERT_LE(first + n, cosines.size());
  for (int i = 0; i < n; ++i) {
    cosines[first + i] = std::cos(2 * pi * i / n);
    sines[first + i] = std::sin(2 * pi * i / n);
  }
  expect_tangents(side.tangent1, side.tangent2, cosines, sines);
}

void expect_table(const std::string& name, std::initializer_list<double> lambdas, const SchemeOptions& options) {
  int n = 3;
  for (const double lambda : lambdas) {
    EXPECT_NEAR(LocalSpectrum(name, n, -1, options).leading(1), lambda, eight_cut_decimals) << name << ", n = " << n;
    ++n;
  }
}

void HandBlock::add(int row, int column, int sector, double weight) {
  B_(row, column) += weight * std::polar(1.0, 2 * pi * k_ * sector / n_);
}

std::vector<std::complex<double>> HandBlock::power_sums() const {
  std::vector<std::complex<double>> sums;
  for (Eigen::MatrixXcd power = B_; std::ssize(sums) < B_.rows(); power = (power * B_).eval())
    sums.push_back(power.trace());
  return sums;
}

void expect_same_spectrum(const LocalSpectrum& spectrum, int k, const HandBlock& hand) {
  const std::vector<std::complex<double>> ours = spectrum.power_sums(k), expected = hand.power_sums();
  const int fixed = k % spectrum.n() == 0;
  ASSERT_EQ(ours.size(), expected.size() + fixed) << "n = " << spectrum.n() << ", block " << k;
  for (size_t j = 0; j < expected.size(); ++j)
    EXPECT_LE(std::abs(ours[j] - expected[j] - double(fixed)), closed_form)
        << "power " << j + 1 << ", n = " << spectrum.n() << ", block " << k;
}

}  // namespace sublimit::testing
