// SPDX-License-Identifier: Apache-2.0
#pragma once
// Comparison of spectra and limit masks with formulas and tables of papers, for the tests of schemes.
#include <complex>
#include <initializer_list>
#include <string>
#include <vector>

#include "sublimit/limit/detail/limit_masks.h"
#include "truth/local_spectrum.h"

namespace sublimit::testing {

/// Tolerance of spectra and limit masks against closed forms.
inline constexpr double closed_form = 1e-12;
/// Tolerances of tables with eight decimals, some of them truncated instead of rounded, and of ratios with
/// three.
inline constexpr double eight_cut_decimals = 1e-8, three_decimals = 5.1e-4;
/// Tolerances of tables: half of the last of so many decimals, and rounding.
inline constexpr double four_decimals = 5.1e-5, five_decimals = 5.1e-6, six_decimals = 5.1e-7;

/// Returns the limit of an isolated vertex of valence n, or of an isolated n-gon if the scheme is dual.
IsolatedLimit isolated_centre(const std::string& name, int n, const SchemeOptions& options = {});

/// Expects that block k has exactly these eigenvalues with these multiplicities, decided by ranks.
void expect_eigenvalues(const LocalSpectrum& spectrum, int k, std::vector<Precise> values);

/// Expects that the tangents span the plane of `cosines` and `sines`, with the same orientation.
void expect_tangents(const Eigen::VectorXd& tangent1, const Eigen::VectorXd& tangent2, const Eigen::VectorXd& cosines,
                     const Eigen::VectorXd& sines);
/// Expects this for cos and sin of 2 pi s/n on n points from `first` on, and weights 0 on all others.
void expect_first_mode(const IsolatedLimit& limit, int n, int first);

/// Expects the printed values of lambda for valences 3, 4, ...
void expect_table(const std::string& name, std::initializer_list<double> lambdas, const SchemeOptions& options = {});

/// Block k of a local matrix that a test specifies, with `points` points in each sector.
class HandBlock {
 public:
  HandBlock(int n, int k, int points) : n_(n), k_(k), B_(Eigen::MatrixXcd::Zero(points, points)) {}
  /// Adds a weight of the new point `row` of sector 0 on the old point `column` of a sector.
  void add(int row, int column, int sector, double weight);
  std::vector<std::complex<double>> power_sums() const;

 private:
  int n_, k_;
  Eigen::MatrixXcd B_;
};

/// Expects that block k has the eigenvalues of the given one, and the eigenvalue 1 of a centre that stays.
void expect_same_spectrum(const LocalSpectrum& spectrum, int k, const HandBlock& hand);

}  // namespace sublimit::testing
