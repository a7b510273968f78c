// SPDX-License-Identifier: Apache-2.0
#pragma once
// Eigenvalues and eigenvectors of local matrices. Defective clusters lose half their digits in a general solver, so a
// cluster's value is its mean (which keeps them) and its eigenvectors are the null space at that value, by rank decision.
// Rotationally symmetric neighbourhoods are taken apart into Fourier blocks first: conjugate blocks would otherwise give
// double eigenvalues with arbitrary bases.
#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

namespace sublimit {

/// Equal eigenvalues of one block.
struct EigenCluster {
  std::complex<double> value;
  int block = 0;            ///< Fourier index
  int multiplicity = 1;     ///< algebraic
  Eigen::MatrixXcd left, right;  ///< eigenvectors as columns, as many as the geometric multiplicity
  double conditioning = 1;  ///< 1 / |l . r| of unit vectors, infinite if defective

  int geometric() const { return static_cast<int>(left.cols()); }
  bool is_jordan() const { return geometric() < multiplicity; }
};

/// Clusters by descending modulus.
struct EigenStructure {
  std::vector<EigenCluster> clusters;
};

/// Eigenvalues closer than this (relative to the largest) are one cluster: a pair that rounding has split lies within
/// sqrt(eps), a triple within eps^(1/3).
inline constexpr double cluster_tolerance = 1e-5;

/// The `leading` largest clusters of a matrix.
EigenStructure eigen_structure(const Eigen::MatrixXcd& matrix, int block = 0, int leading = 1 << 30);

/// Left eigenvectors l^T A = value l^T (columns, an orthonormal basis of the null space of A^T - value).
Eigen::MatrixXcd left_eigenvectors(const Eigen::MatrixXcd& A, std::complex<double> value);

/// A matrix on a centre and n sectors of p points, slot 1 + s p + i for point i of sector s.
struct FourierBlocks {
  int n = 0, p = 0;
  /// Block k acts on the sectors' amplitudes x_i w^(k s), w = exp(2 pi i/n); block 0 has the centre first.
  std::vector<Eigen::MatrixXcd> blocks;
};

/// Blocks of A, if it commutes with the shift of sectors (up to rounding).
std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, int n);

/// All blocks' clusters together, by descending modulus.
EigenStructure eigen_structure(const FourierBlocks& blocks);

/// Weights of the limit point: l^T A = l^T, sum l = 1.
/// @throws AnalysisError  eigenvalue 1 is not simple and dominant
Eigen::VectorXd limit_weights(const Eigen::MatrixXd& A);

}  // namespace sublimit
