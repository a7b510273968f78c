// SPDX-License-Identifier: Apache-2.0
#pragma once
// Eigenvalues and eigenvectors of local matrices. Defective clusters lose half their digits in a general solver, so a
// cluster's value is its mean, which is accurate, and its eigenvectors span the null space at that value (by
// rank decision). Matrices of rotationally symmetric neighbourhoods are split into Fourier blocks first:
// conjugate blocks would otherwise give double eigenvalues with arbitrary bases.
#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

#include "sublimit/core/detail/sector_rows.h"

namespace sublimit {

/// Eigenvalues of one block that are equal up to `cluster_tolerance`, with their eigenvectors.
struct EigenCluster {
  std::complex<double> value;
  int block = 0;                 ///< index of the Fourier block
  int multiplicity = 1;          ///< algebraic multiplicity
  Eigen::MatrixXcd left, right;  ///< eigenvectors as columns, as many as the geometric multiplicity
  double conditioning = 1;       ///< 1 / |l . r| of unit vectors, infinite if defective

  /// Returns the geometric multiplicity: the number of eigenvectors.
  int geometric() const { return static_cast<int>(left.cols()); }
  bool is_jordan() const { return geometric() < multiplicity; }
};

/// Clusters of a matrix, by descending modulus.
struct EigenStructure {
  std::vector<EigenCluster> clusters;
};

/// Eigenvalues closer than this (relative to the largest) are one cluster: a pair that rounding has split lies within
/// sqrt(eps), a triple within eps^(1/3).
inline constexpr double cluster_tolerance = 1e-5;

/// Returns the `leading` largest clusters of a matrix with modulus >= `least`.
/// @param block  index that the clusters get
EigenStructure eigen_structure(const Eigen::MatrixXcd& matrix, int block = 0, int leading = 1 << 30, double least = 0);

/// Returns the left eigenvectors l^T A = value l^T (columns, an orthonormal basis of the null space of A^T -
/// value).
Eigen::MatrixXcd left_eigenvectors(const Eigen::MatrixXcd& A, std::complex<double> value);

/// A sparse matrix that commutes with a rotation by one of n sectors, n >= 2.
struct SectorRows : SectorRowsOf<double, std::complex<double>> {
  int fixed = 0;                               ///< number of orbits of size 1; they come first
  std::vector<std::vector<Index>> components;  ///< strongly connected components of the orbits

  /// Returns the eigenvalues of block k with multiplicity, in any order. They are computed by component, since
  /// components are small.
  std::vector<std::complex<double>> values(int k) const;
};

/// Returns the rows of one sector of A; nothing unless A commutes with the rotation up to rounding. Compares
/// all nonzeros.
/// @param orbits  slots of each orbit, sector by sector
std::optional<SectorRows> sector_rows(const SparseMatrix& A, Orbits orbits);
/// Returns the rows of sectors of a matrix in which slot 0 is fixed and slot 1 + s p + i is place i of sector s.
std::optional<SectorRows> sector_rows(const SparseMatrix& A, int n);

/// The rows of one sector, and all Fourier blocks of the matrix.
struct FourierBlocks : SectorRows {
  std::vector<Eigen::MatrixXcd> blocks;  ///< blocks 0 to n - 1
};

/// Returns the Fourier blocks of A; nothing unless A commutes with the rotation up to rounding.
std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, Orbits orbits);
/// Returns the Fourier blocks of a matrix whose slot 0 is fixed and whose slot 1 + s p + i is place i of sector s.
std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, int n);

/// Returns the leading clusters of blocks 0 to n/2 (the others are their conjugates), by descending modulus.
/// Only eigenvectors of these clusters are computed, which keeps the work linear in n.
/// @param values  eigenvalues of each of these blocks, from SectorRows::values
/// @param least   clusters of smaller modulus are left out
EigenStructure leading_structure(const SectorRows& rows, const std::vector<std::vector<std::complex<double>>>& values,
                                 double least);

/// Returns the clusters of all blocks, by descending modulus.
EigenStructure eigen_structure(const FourierBlocks& blocks);

/// Returns the weights of the limit point: l^T A = l^T, sum l = 1.
/// @throws AnalysisError  eigenvalue 1 is not simple and dominant
Eigen::VectorXd limit_weights(const Eigen::MatrixXd& A);

}  // namespace sublimit
