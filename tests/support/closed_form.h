// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the tests of the schemes hold spectra and limit masks to what is written in papers.
#include <complex>
#include <initializer_list>
#include <string>
#include <vector>

#include "sublimit/limit/detail/limit_masks.h"
#include "support/local_spectrum.h"

namespace sublimit::testing {

/// Spectra and limit masks against closed forms.
inline constexpr double closed_form = 1e-12;
/// What eight printed decimals can tell, some of them cut off instead of rounded, and ratios with three.
inline constexpr double eight_cut_decimals = 1e-8, three_decimals = 5.1e-4;
/// Half of the last of so many printed decimals, and rounding.
inline constexpr double four_decimals = 5.1e-5, five_decimals = 5.1e-6, six_decimals = 5.1e-7;

/// The limit of an isolated vertex of valence n, or of an isolated n-gon if the scheme is dual.
IsolatedLimit isolated_centre(const std::string& name, int n, const SchemeOptions& options = {});

/// Block k has exactly these eigenvalues with these multiplicities, by ranks.
void expect_eigenvalues(const LocalSpectrum& spectrum, int k, std::vector<Precise> values);

/// The tangents span the plane of `cosines` and `sines` and turn as these do.
void expect_tangents(const Eigen::VectorXd& tangent1, const Eigen::VectorXd& tangent2, const Eigen::VectorXd& cosines,
                     const Eigen::VectorXd& sines);
/// The same for cos and sin of 2 pi s/n on n points, the first of which is `first`, and nothing on others.
void expect_first_mode(const IsolatedLimit& limit, int n, int first);

/// lambda of valences 3, 4, ... as printed.
void expect_table(const std::string& name, std::initializer_list<double> lambdas, const SchemeOptions& options = {});

/// Block k of a local matrix, written down by hand: `points` places a sector.
class HandBlock {
 public:
  HandBlock(int n, int k, int points) : n_(n), k_(k), B_(Eigen::MatrixXcd::Zero(points, points)) {}
  /// The new point `row` of sector 0 has this weight on the old point `column` of a sector.
  void add(int row, int column, int sector, double weight);
  std::vector<std::complex<double>> power_sums() const;

 private:
  int n_, k_;
  Eigen::MatrixXcd B_;
};

/// Block k has the eigenvalues of the one that was written by hand, and the 1 of a centre that stays.
void expect_same_spectrum(const LocalSpectrum& spectrum, int k, const HandBlock& hand);

}  // namespace sublimit::testing
