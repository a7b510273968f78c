// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/eigen_structure.h"

#include <algorithm>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/complex_decompositions.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/left_eigenvector.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {
namespace {

using Complex = std::complex<double>;

/// Orthonormal basis of the vectors that M sends to zero, at most `at_most`, at least one.
Eigen::MatrixXcd null_space(const Eigen::MatrixXcd& M, int at_most) {
  const Eigen::Index size = M.rows();
  if (at_most == 1 && size > 32) {  // inverse iteration: the singular values would cost more and tell no more
    const double shift = std::numeric_limits<double>::epsilon() * std::max(1.0, M.norm());
    const ComplexLu lu(M + shift * Eigen::MatrixXcd::Identity(size, size));
    Eigen::VectorXcd x = Eigen::VectorXcd::Ones(size);
    for (Eigen::Index i = 0; i < size; ++i)
      x[i] += 0.5 * std::sin(static_cast<double>(i));  // no symmetry to be blind to
    for (int k = 0; k < 4; ++k) x = lu.solve(x.normalized());
    return x.normalized();
  }
  const ComplexSingularValues svd = singular_values(M);
  const Eigen::VectorXd& sigma = svd.values;
  // A cluster's value is known to some ulps; what is no null vector has a singular value of the order of a gap.
  const double zero = 1e-9 * std::max(sigma[0], 1e-3);
  int dimension = 0;
  while (dimension < at_most && dimension < size && sigma[size - 1 - dimension] <= zero) ++dimension;
  return svd.right.rightCols(std::max(dimension, 1));
}

}  // namespace

Eigen::MatrixXcd left_eigenvectors(const Eigen::MatrixXcd& A, Complex value) {
  return null_space(A.transpose() - value * Eigen::MatrixXcd::Identity(A.rows(), A.cols()), static_cast<int>(A.rows()));
}

EigenStructure eigen_structure(const Eigen::MatrixXcd& A, int block, int leading, double least) {
  EigenStructure result;
  if (A.rows() == 0) return result;
  const Eigen::VectorXcd found = eigenvalues(A);
  std::vector<Complex> values(found.begin(), found.end());
  const double scale = std::abs(
      *std::max_element(values.begin(), values.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); }));
  while (!values.empty() && static_cast<int>(result.clusters.size()) < leading) {
    const auto largest = std::max_element(values.begin(), values.end(), [](Complex a, Complex b) {
      return std::pair(std::abs(a), a.real()) < std::pair(std::abs(b), b.real());
    });
    const Complex seed = *largest;
    if (std::abs(seed) < least) break;
    Complex sum = 0;
    EigenCluster cluster;
    cluster.block = block;
    cluster.multiplicity = 0;
    std::vector<Complex> rest;
    for (const Complex value : values) {
      if (std::abs(value - seed) <= cluster_tolerance * scale) {
        sum += value;
        ++cluster.multiplicity;
      } else {
        rest.push_back(value);
      }
    }
    values = std::move(rest);
    cluster.value = sum / static_cast<double>(cluster.multiplicity);
    if (std::abs(cluster.value.imag()) <= 1e-13 * scale) cluster.value = cluster.value.real();
    const Eigen::MatrixXcd shifted = A - cluster.value * Eigen::MatrixXcd::Identity(A.rows(), A.cols());
    cluster.right = null_space(shifted, cluster.multiplicity);
    cluster.left = null_space(shifted.transpose(), cluster.multiplicity);
    const double cosine = smallest_singular_value(cluster.left.transpose() * cluster.right);
    cluster.conditioning = cluster.is_jordan() || cosine == 0 ? std::numeric_limits<double>::infinity() : 1 / cosine;
    result.clusters.push_back(std::move(cluster));
  }
  return result;
}

namespace {

/// Slot 0 and p orbits around it.
Orbits orbits_around(Eigen::Index slots, int n) {
  const int p = static_cast<int>(slots - 1) / n;
  Orbits orbits{{0}};
  for (int i = 0; i < p; ++i) {
    orbits.emplace_back();
    for (int s = 0; s < n; ++s) orbits.back().push_back(1 + s * p + i);
  }
  return orbits;
}

}  // namespace

std::optional<SectorRows> sector_rows(const SparseMatrix& A, Orbits orbits) {
  const auto others =
      std::stable_partition(orbits.begin(), orbits.end(), [](const auto& orbit) { return orbit.size() == 1; });
  const auto fixed = static_cast<int>(others - orbits.begin());
  if (others == orbits.end()) return std::nullopt;
  double largest = 1;
  for (Eigen::Index k = 0; k < A.nonZeros(); ++k) largest = std::max(largest, std::abs(A.valuePtr()[k]));
  const double tolerance = 64 * std::numeric_limits<double>::epsilon() * largest;
  auto found = sector_rows_of<double, Complex>(
      A.rows(), std::move(orbits),
      [&](Index i, const auto& visit) {
        for (SparseMatrix::InnerIterator it(A, i); it; ++it) visit(it.col(), it.value());
      },
      [&](double a, double b) { return std::abs(a - b) <= tolerance; });
  if (!found) return std::nullopt;
  SectorRows result{std::move(*found), fixed, {}};
  std::vector<std::vector<Index>> columns;
  for (const auto& row : result.rows) {
    columns.emplace_back();
    for (const auto& term : row) columns.back().push_back(term.orbit);
  }
  result.components = strong_components(columns);
  return result;
}

std::optional<SectorRows> sector_rows(const SparseMatrix& A, int n) {
  if (n < 2 || (A.rows() - 1) % n != 0) return std::nullopt;
  return sector_rows(A, orbits_around(A.rows(), n));
}

std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, Orbits orbits) {
  std::optional<SectorRows> rows = sector_rows(SparseMatrix(A.sparseView()), std::move(orbits));
  if (!rows) return std::nullopt;
  FourierBlocks result{std::move(*rows), {}};
  for (int k = 0; k < result.n; ++k) result.blocks.push_back(result.block(k));
  return result;
}

std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, int n) {
  if (n < 2 || (A.rows() - 1) % n != 0) return std::nullopt;
  return fourier_blocks(A, orbits_around(A.rows(), n));
}

std::vector<Complex> SectorRows::values(int k) const {
  const int first = k == 0 ? 0 : fixed;
  const Eigen::MatrixXcd B = block(k);
  std::vector<Complex> values;
  for (const std::vector<Index>& component : components) {
    std::vector<int> places;
    for (const int i : component)
      if (i >= first) places.push_back(i - first);
    if (places.empty()) continue;
    if (places.size() == 1) {
      values.push_back(B(places[0], places[0]));
      continue;
    }
    const Eigen::VectorXcd found = eigenvalues(Eigen::MatrixXcd(B(places, places)));
    values.insert(values.end(), found.begin(), found.end());
  }
  return values;
}

namespace {

void sort_by_modulus(EigenStructure& structure) {
  std::stable_sort(
      structure.clusters.begin(), structure.clusters.end(),
      [](const EigenCluster& a, const EigenCluster& b) { return std::abs(a.value) > std::abs(b.value) * (1 + 1e-12); });
}

}  // namespace

EigenStructure leading_structure(const SectorRows& rows, const std::vector<std::vector<Complex>>& values,
                                 double least) {
  EigenStructure result;
  for (size_t k = 0; k < values.size(); ++k) {
    const auto is_leading = [&](Complex value) { return std::abs(value) >= least; };
    if (std::none_of(values[k].begin(), values[k].end(), is_leading)) continue;
    for (EigenCluster& cluster :
         eigen_structure(rows.block(static_cast<int>(k)), static_cast<int>(k), 1 << 30, least).clusters)
      result.clusters.push_back(std::move(cluster));
  }
  sort_by_modulus(result);
  return result;
}

EigenStructure eigen_structure(const FourierBlocks& fourier) {
  EigenStructure result;
  for (int k = 0; k < fourier.n; ++k)
    for (EigenCluster& cluster : eigen_structure(fourier.blocks[k], k).clusters)
      result.clusters.push_back(std::move(cluster));
  sort_by_modulus(result);
  return result;
}

Eigen::VectorXd limit_weights(const Eigen::MatrixXd& A) {
  const Eigen::Index size = A.rows();
  const std::optional<Eigen::VectorXd> l = left_eigenvector(A, 1, Eigen::VectorXd::Ones(size));
  if (!l) throw AnalysisError(std::string(local_divergence) + ": eigenvalue 1 is not simple");
  const Eigen::VectorXcd values = size > 1 ? eigenvalues(A) : Eigen::VectorXcd::Ones(1);
  int at_one = 0;
  for (const Complex value : values) at_one += std::abs(value) >= 1 - 1e-9;
  if (at_one != 1) throw AnalysisError(std::string(local_divergence) + ": eigenvalue 1 is not dominant");
  return *l;
}

}  // namespace sublimit
