// SPDX-License-Identifier: Apache-2.0
#include "truth/local_spectrum.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <stdexcept>

namespace sublimit::testing {
namespace {

using Matrix = DenseMatrix<Precise>;

/// What is zero but for rounding, and what is not: nothing lies between 1e-60 and 1e-20 here.
const Precise zero("1e-45");

int nullity(Matrix m) {
  const Eigen::Index size = m.rows();
  Eigen::Index rank = 0;
  while (rank < size) {
    Eigen::Index row = 0, column = 0;
    Precise largest = 0;
    for (Eigen::Index i = rank; i < size; ++i)
      for (Eigen::Index j = rank; j < size; ++j)
        if (abs(m(i, j)) > largest) {
          largest = abs(m(i, j));
          row = i;
          column = j;
        }
    if (largest < zero) break;
    m.row(rank).swap(m.row(row));
    m.col(rank).swap(m.col(column));
    for (Eigen::Index i = rank + 1; i < size; ++i) {
      const Precise factor = m(i, rank) / m(rank, rank);
      if (factor == 0) continue;
      for (Eigen::Index j = rank; j < size; ++j) m(i, j) -= factor * m(rank, j);
    }
    ++rank;
  }
  return static_cast<int>(size - rank);
}

}  // namespace

LocalSpectrum::LocalSpectrum(const Scheme<Precise>& scheme, int n, int rings) : n_(n) {
  const LocalType type{.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = n};
  const auto patch = local_patch(scheme, type, rings);
  if (!patch) throw std::runtime_error(scheme.name + ": no local matrix");
  std::vector<std::vector<Index>> orbits = patch->orbits;
  std::stable_partition(orbits.begin(), orbits.end(), [](const auto& orbit) { return orbit.size() == 1; });
  const Matrix& A = patch->A;
  const auto size = std::ssize(orbits);
  const auto at = [&](std::ptrdiff_t i, int s) { return orbits[i][orbits[i].size() == 1 ? 0 : s % n]; };
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    if (orbits[i].size() != 1 && std::ssize(orbits[i]) != n) throw std::runtime_error(scheme.name + ": odd orbits");
    for (std::ptrdiff_t j = 0; j < size; ++j)
      for (int s = 0; s < n; ++s)
        for (int t = 0; t < n; ++t)
          if (abs(A(at(i, s), at(j, s + t)) - A(at(i, 0), at(j, t))) > zero)
            throw std::runtime_error(scheme.name + ": the local matrix does not commute with the rotation");
  }
  for (int k = 0; k < n; ++k) {
    std::vector<std::ptrdiff_t> kept;
    for (std::ptrdiff_t i = 0; i < size; ++i)
      if (k == 0 || orbits[i].size() != 1) kept.push_back(i);
    const auto p = std::ssize(kept);
    Matrix B = Matrix::Zero(2 * p, 2 * p);
    for (std::ptrdiff_t i = 0; i < p; ++i)
      for (std::ptrdiff_t j = 0; j < p; ++j) {
        const int terms = orbits[kept[j]].size() == 1 ? 1 : n;
        for (int t = 0; t < terms; ++t) {
          const Precise a = A(at(kept[i], 0), at(kept[j], t));
          if (a == 0) continue;
          const Precise re = a * cosine(k * t, n), im = a * sine(k * t % n, n);
          B(i, j) += re;
          B(i + p, j + p) += re;
          B(i + p, j) += im;
          B(i, j + p) -= im;
        }
      }
    blocks_.push_back(std::move(B));
  }
}

LocalSpectrum::LocalSpectrum(const std::string& name, int n, int rings, const SchemeOptions& options)
    : LocalSpectrum(find_scheme<Precise>(name, options).value(), n, rings) {}

std::vector<int> LocalSpectrum::staircase(int k, const Precise& lambda) const {
  const Matrix& B = blocks_[wrapped(k)];
  const Matrix shifted = B - lambda * Matrix::Identity(B.rows(), B.cols());
  std::vector<int> steps;
  for (Matrix power = shifted;; power = (power * shifted).eval()) {
    const int dimension = nullity(power) / 2;
    if (dimension == (steps.empty() ? 0 : steps.back())) return steps;
    steps.push_back(dimension);
  }
}

int LocalSpectrum::multiplicity(int k, const Precise& lambda) const {
  const std::vector<int> steps = staircase(k, lambda);
  return steps.empty() ? 0 : steps.back();
}

std::vector<std::complex<double>> LocalSpectrum::power_sums(int k) const {
  const Matrix& B = blocks_[wrapped(k)];
  const Eigen::Index p = size(k);
  std::vector<std::complex<double>> sums;
  for (Matrix power = B; std::ssize(sums) < p; power = (power * B).eval())
    sums.emplace_back(static_cast<double>(power.topLeftCorner(p, p).trace()),
                      static_cast<double>(power.bottomLeftCorner(p, p).trace()));
  return sums;
}

std::vector<double> LocalSpectrum::moduli(int k) const {
  const Matrix& B = blocks_[wrapped(k)];
  const Eigen::RealSchur<Matrix> schur(B, false);
  if (schur.info() != Eigen::Success) throw std::runtime_error("eigenvalues did not converge");
  const Matrix& T = schur.matrixT();
  std::vector<double> all;
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    if (i + 1 < T.rows() && T(i + 1, i) != 0) {  // a conjugate pair: its modulus is the root of the determinant
      const double modulus = static_cast<double>(sqrt(abs(T(i, i) * T(i + 1, i + 1) - T(i, i + 1) * T(i + 1, i))));
      all.push_back(modulus);
      all.push_back(modulus);
      ++i;
    } else {
      all.push_back(static_cast<double>(abs(T(i, i))));
    }
  }
  std::sort(all.rbegin(), all.rend());
  std::vector<double> half;
  for (size_t i = 0; i < all.size(); i += 2) half.push_back(all[i]);
  return half;
}

double LocalSpectrum::largest_below(double modulus) const {
  double largest = 0;
  for (int k = 0; 2 * k <= n_; ++k)
    for (const double value : moduli(k))
      if (value < modulus * (1 - 1e-12)) largest = std::max(largest, value);
  return largest;
}

double LocalSpectrum::leading(int k) const {
  for (const double value : moduli(k))
    if (value < 1 - 1e-12) return value;
  return 0;
}

}  // namespace sublimit::testing
