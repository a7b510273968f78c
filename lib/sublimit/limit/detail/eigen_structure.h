// SPDX-License-Identifier: Apache-2.0
#pragma once
// Eigenvalues and eigenvectors of local matrices. Defective clusters lose half their digits in a general solver, so a
// cluster's value is its mean (which keeps them) and its eigenvectors are the null space at that value, by rank
// decision. Rotationally symmetric neighbourhoods are taken apart into Fourier blocks first: conjugate blocks would
// otherwise give double eigenvalues with arbitrary bases.
#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Equal eigenvalues of one block.
struct EigenCluster {
  std::complex<double> value;
  int block = 0;                 ///< Fourier index
  int multiplicity = 1;          ///< algebraic
  Eigen::MatrixXcd left, right;  ///< eigenvectors as columns, as many as the geometric multiplicity
  double conditioning = 1;       ///< 1 / |l . r| of unit vectors, infinite if defective

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

/// The `leading` largest clusters of a matrix, of modulus `least` or more.
EigenStructure eigen_structure(const Eigen::MatrixXcd& matrix, int block = 0, int leading = 1 << 30, double least = 0);

/// Left eigenvectors l^T A = value l^T (columns, an orthonormal basis of the null space of A^T - value).
Eigen::MatrixXcd left_eigenvectors(const Eigen::MatrixXcd& A, std::complex<double> value);

/// A sparse matrix that commutes with a rotation, kept as the rows of one sector. Slots are in orbits: n places that
/// the rotation takes into each other, or a single one that stays.
struct SectorRows {
  /// Weight of the place of an orbit that lies `turn` sectors on.
  struct Term {
    int orbit, turn;
    double weight;
  };
  int n = 0;
  std::vector<std::vector<int>> orbits;      ///< slots, sector by sector; those of size 1 first
  int fixed = 0;                             ///< number of those
  std::vector<std::vector<Term>> rows;       ///< of the first place of each orbit; terms by orbit and turn
  std::vector<std::vector<int>> components;  ///< orbits that depend on each other: strongly connected ones
  std::vector<std::complex<double>> roots;   ///< exp(2 pi i t/n)

  /// Block k acts on the orbits' amplitudes x_i w^(k s), w = exp(2 pi i/n); only block 0 has the fixed places.
  Eigen::MatrixXcd block(int k) const;
  /// Eigenvalues of block k, in no order, with multiplicity: those of its components, which are small.
  std::vector<std::complex<double>> values(int k) const;
  /// Left eigenvector l of block k as a mask over the slots: sum_s sum_i l_i w^(-k s) x_(s,i) / n, and the fixed
  /// places'.
  Eigen::VectorXcd mask(int k, const Eigen::VectorXcd& l) const;
};

/// Rows of one sector of A, if A commutes with the rotation (up to rounding): all nonzeros are compared.
std::optional<SectorRows> sector_rows(const SparseMatrix& A, std::vector<std::vector<int>> orbits);
/// Returns the rows of sectors of a matrix in which slot 0 is fixed and slot 1 + s p + i is place i of sector s.
std::optional<SectorRows> sector_rows(const SparseMatrix& A, int n);

/// Rows of one sector with all Fourier blocks of the matrix.
struct FourierBlocks : SectorRows {
  std::vector<Eigen::MatrixXcd> blocks;  ///< 0 to n - 1
};

/// Blocks of A, if it commutes with the rotation (up to rounding).
std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, std::vector<std::vector<int>> orbits);
/// Returns the Fourier blocks of a matrix whose slot 0 is fixed and whose slot 1 + s p + i is place i of sector s.
std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, int n);

/// Leading clusters of blocks 0 to n/2 (the others are their conjugates), by descending modulus. Eigenvectors are found
/// of these clusters alone, so that the work is linear in n.
/// @param values  of each of these blocks, as SectorRows::values has them
/// @param least   clusters of smaller modulus are left out
EigenStructure leading_structure(const SectorRows& rows, const std::vector<std::vector<std::complex<double>>>& values,
                                 double least);

/// All blocks' clusters together, by descending modulus.
EigenStructure eigen_structure(const FourierBlocks& blocks);

/// Weights of the limit point: l^T A = l^T, sum l = 1.
/// @throws AnalysisError  eigenvalue 1 is not simple and dominant
Eigen::VectorXd limit_weights(const Eigen::MatrixXd& A);

}  // namespace sublimit
