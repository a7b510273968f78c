// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/eigen_structure.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/core/dense_decompositions.h"
#include "sublimit/core/number.h"
#include "sublimit/limit/no_limit.h"

namespace sublimit {
namespace {

using Complex = std::complex<double>;

/// Orthonormal basis of the vectors that M sends to zero, at most `at_most`, at least one.
Eigen::MatrixXcd null_space(const Eigen::MatrixXcd& M, int at_most) {
  const Eigen::Index size = M.rows();
  if (at_most == 1 && size > 32) {  // inverse iteration: the singular values would cost more and tell no more
    const double shift = std::numeric_limits<double>::epsilon() * std::max(1.0, M.norm());
    const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(M + shift * Eigen::MatrixXcd::Identity(size, size));
    Eigen::VectorXcd x = Eigen::VectorXcd::Ones(size);
    for (Eigen::Index i = 0; i < size; ++i)
      x[i] += 0.5 * std::sin(static_cast<double>(i));  // no symmetry to be blind to
    for (int k = 0; k < 4; ++k) x = lu.solve(x.normalized()).eval();
    return x.normalized();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(M, Eigen::ComputeFullV);
  const auto& sigma = svd.singularValues();
  // A cluster's value is known to some ulps; what is no null vector has a singular value of the order of a gap.
  const double zero = 1e-9 * std::max(sigma[0], 1e-3);
  int dimension = 0;
  while (dimension < at_most && dimension < size && sigma[size - 1 - dimension] <= zero) ++dimension;
  return svd.matrixV().rightCols(std::max(dimension, 1));
}

}  // namespace

Eigen::MatrixXcd left_eigenvectors(const Eigen::MatrixXcd& A, Complex value) {
  return null_space(A.transpose() - value * Eigen::MatrixXcd::Identity(A.rows(), A.cols()), static_cast<int>(A.rows()));
}

EigenStructure eigen_structure(const Eigen::MatrixXcd& A, int block, int leading) {
  EigenStructure result;
  if (A.rows() == 0) return result;
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(A, false);
  if (solver.info() != Eigen::Success) throw AnalysisError("the eigenvalues of a local matrix did not converge");
  std::vector<Complex> values(solver.eigenvalues().begin(), solver.eigenvalues().end());
  const double scale = std::abs(
      *std::max_element(values.begin(), values.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); }));
  while (!values.empty() && static_cast<int>(result.clusters.size()) < leading) {
    const auto largest = std::max_element(values.begin(), values.end(), [](Complex a, Complex b) {
      return std::pair(std::abs(a), a.real()) < std::pair(std::abs(b), b.real());
    });
    const Complex seed = *largest;
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
    const Eigen::JacobiSVD<Eigen::MatrixXcd> overlap(cluster.left.transpose() * cluster.right);
    const double least = overlap.singularValues().minCoeff();
    cluster.conditioning = cluster.is_jordan() || least == 0 ? std::numeric_limits<double>::infinity() : 1 / least;
    result.clusters.push_back(std::move(cluster));
  }
  return result;
}

namespace {

/// exp(2 pi i turn/n), exact at quarter turns.
Complex root_of_unity(long long turn, int n) {
  const int k = static_cast<int>(turn % n);
  return {Number<double>::cos_2pi(k, n), Number<double>::cos_2pi(4 * k - n, 4 * n)};
}

}  // namespace

std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, std::vector<std::vector<int>> orbits) {
  FourierBlocks result;
  std::stable_partition(orbits.begin(), orbits.end(), [](const auto& orbit) { return orbit.size() == 1; });
  for (const auto& orbit : orbits) {
    if (orbit.size() == 1)
      ++result.fixed;
    else if (result.n != 0 && result.n != static_cast<int>(orbit.size()))
      return std::nullopt;
    else
      result.n = static_cast<int>(orbit.size());
  }
  const int n = result.n, fixed = result.fixed, size = static_cast<int>(orbits.size());
  if (n < 2) return std::nullopt;
  const double tolerance = 64 * std::numeric_limits<double>::epsilon() * std::max(1.0, A.cwiseAbs().maxCoeff());
  const auto at = [&](int i, int s) { return orbits[i][i < fixed ? 0 : s % n]; };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      for (int s = 0; s < n; ++s)
        for (int t = 0; t < n; ++t)
          if (std::abs(A(at(i, s), at(j, s + t)) - A(at(i, 0), at(j, t))) > tolerance) return std::nullopt;
  for (int k = 0; k < n; ++k) {
    const int first = k == 0 ? 0 : fixed;
    Eigen::MatrixXcd B = Eigen::MatrixXcd::Zero(size - first, size - first);
    for (int i = first; i < size; ++i)
      for (int j = first; j < size; ++j) {
        if (j < fixed) {
          B(i, j) = A(at(i, 0), at(j, 0));
          continue;
        }
        for (int t = 0; t < n; ++t)
          B(i - first, j - first) += A(at(i, 0), at(j, t)) * root_of_unity(static_cast<long long>(k) * t, n);
      }
    result.blocks.push_back(std::move(B));
  }
  result.orbits = std::move(orbits);
  return result;
}

std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, int n) {
  if (n < 2 || (A.rows() - 1) % n != 0) return std::nullopt;
  const int p = static_cast<int>(A.rows() - 1) / n;
  std::vector<std::vector<int>> orbits{{0}};
  for (int i = 0; i < p; ++i) {
    orbits.emplace_back();
    for (int s = 0; s < n; ++s) orbits.back().push_back(1 + s * p + i);
  }
  return fourier_blocks(A, std::move(orbits));
}

Eigen::VectorXcd FourierBlocks::mask(int k, const Eigen::VectorXcd& l) const {
  const int first = k == 0 ? 0 : fixed, size = static_cast<int>(orbits.size());
  Eigen::VectorXcd result = Eigen::VectorXcd::Zero(fixed + n * (size - fixed));
  for (int i = first; i < size; ++i)
    for (int s = 0; s < static_cast<int>(orbits[i].size()); ++s)
      result[orbits[i][s]] = i < fixed ? l[i]
                                       : l[i - first] * std::conj(root_of_unity(static_cast<long long>(k) * s, n)) /
                                             static_cast<double>(n);
  return result;
}

EigenStructure eigen_structure(const FourierBlocks& fourier) {
  EigenStructure result;
  for (int k = 0; k < fourier.n; ++k)
    for (EigenCluster& cluster : eigen_structure(fourier.blocks[k], k).clusters)
      result.clusters.push_back(std::move(cluster));
  std::stable_sort(result.clusters.begin(), result.clusters.end(), [](const EigenCluster& a, const EigenCluster& b) {
    return std::abs(a.value) > std::abs(b.value) * (1 + 1e-12);
  });
  return result;
}

Eigen::VectorXd limit_weights(const Eigen::MatrixXd& A) {
  const Eigen::Index size = A.rows();
  Eigen::MatrixXd equations(size + 1, size);
  equations.topRows(size) = A.transpose() - Eigen::MatrixXd::Identity(size, size);
  equations.row(size).setOnes();
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(size + 1, size);
  const PivotedQr qr(equations);
  Eigen::VectorXd l = qr.solve(right);
  l += qr.solve(right - equations * l);  // one step of refinement: the last digits
  if (qr.rank() < size || (equations * l - right).norm() > 1e-10)
    throw AnalysisError(std::string(local_divergence) + ": eigenvalue 1 is not simple");
  const Eigen::VectorXcd values = size > 1 ? eigenvalues(A) : Eigen::VectorXcd::Ones(1);
  int at_one = 0;
  for (const Complex value : values) at_one += std::abs(value) >= 1 - 1e-9;
  if (at_one != 1) throw AnalysisError(std::string(local_divergence) + ": eigenvalue 1 is not dominant");
  return l;
}

}  // namespace sublimit
