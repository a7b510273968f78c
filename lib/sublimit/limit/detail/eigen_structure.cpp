// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/eigen_structure.h"

#include <algorithm>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/complex_decompositions.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/left_eigenvector.h"
#include "sublimit/core/number.h"
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

/// exp(2 pi i turn/n), exact at quarter turns.
Complex root_of_unity(long long turn, int n) {
  const int k = static_cast<int>(turn % n);
  return {Number<double>::cos_2pi(k, n), Number<double>::cos_2pi(4 * k - n, 4 * n)};
}

/// Orbits that depend on each other, directly or not.
std::vector<std::vector<int>> strong_components(const std::vector<std::vector<SectorRows::Term>>& rows) {
  const size_t size = rows.size();
  std::vector<std::vector<std::uint8_t>> reaches(size, std::vector<std::uint8_t>(size, 0));
  for (size_t i = 0; i < size; ++i)
    for (const SectorRows::Term& term : rows[i]) reaches[i][size_t(term.orbit)] = 1;
  for (size_t k = 0; k < size; ++k)
    for (size_t i = 0; i < size; ++i)
      if (reaches[i][k])
        for (size_t j = 0; j < size; ++j) reaches[i][j] |= reaches[k][j];
  std::vector<std::vector<int>> components;
  std::vector<std::uint8_t> done(size, 0);
  for (size_t i = 0; i < size; ++i) {
    if (done[i]) continue;
    components.emplace_back();
    for (size_t j = i; j < size; ++j)
      if (j == i || (reaches[i][j] && reaches[j][i])) {
        done[j] = 1;
        components.back().push_back(static_cast<int>(j));
      }
  }
  return components;
}

/// Compares rows of a matrix with those of the first sector, turned.
class SectorRowsFinder {
 public:
  SectorRowsFinder(const SparseMatrix& A, SectorRows& result)
      : A_(A), result_(result), orbit_of_(size_t(A.rows()), -1), sector_of_(size_t(A.rows()), 0) {
    for (size_t i = 0; i < result.orbits.size(); ++i)
      for (size_t s = 0; s < result.orbits[i].size(); ++s) {
        orbit_of_[size_t(result.orbits[i][s])] = static_cast<int>(i);
        sector_of_[size_t(result.orbits[i][s])] = static_cast<int>(s);
      }
    weight_.assign(result.orbits.size() * size_t(result.n), 0);
    double largest = 1;
    for (Eigen::Index k = 0; k < A.nonZeros(); ++k) largest = std::max(largest, std::abs(A.valuePtr()[k]));
    tolerance_ = 64 * std::numeric_limits<double>::epsilon() * largest;
  }

  bool find() {
    if (std::find(orbit_of_.begin(), orbit_of_.end(), -1) != orbit_of_.end()) return false;
    for (int i = 0; i < static_cast<int>(result_.orbits.size()); ++i)
      if (!(i < result_.fixed ? add_fixed(i) : add_row(i))) return false;
    return true;
  }

 private:
  using Iterator = SparseMatrix::InnerIterator;

  std::vector<SectorRows::Term> terms(int i) const {
    std::vector<SectorRows::Term> terms;
    for (Iterator it(A_, result_.orbits[size_t(i)][0]); it; ++it)
      terms.push_back({orbit_of_[size_t(it.col())], sector_of_[size_t(it.col())], it.value()});
    std::sort(terms.begin(), terms.end(),
              [](const auto& a, const auto& b) { return std::pair(a.orbit, a.turn) < std::pair(b.orbit, b.turn); });
    return terms;
  }
  double& weight(int orbit, int turn) { return weight_[size_t(orbit) * size_t(result_.n) + size_t(turn)]; }

  /// What stays sees all sectors alike.
  bool add_fixed(int i) {
    const std::vector<SectorRows::Term> row = terms(i);
    for (size_t first = 0, end = 0; first < row.size(); first = end) {
      while (end < row.size() && row[end].orbit == row[first].orbit) ++end;
      if (row[first].orbit < result_.fixed) continue;
      const bool all = end - first == size_t(result_.n);
      for (size_t k = first; k < end; ++k)
        if (std::abs(row[k].weight - (all ? row[first].weight : 0)) > tolerance_) return false;
    }
    result_.rows.push_back(row);
    return true;
  }

  bool add_row(int i) {
    const std::vector<SectorRows::Term> row = terms(i);
    const auto is_large = [&](double value) { return std::abs(value) > tolerance_; };
    std::ptrdiff_t large = 0;
    for (const SectorRows::Term& term : row) {
      weight(term.orbit, term.turn) = term.weight;
      large += is_large(term.weight);
    }
    bool same = true;
    for (int s = 1; s < result_.n && same; ++s) {
      std::ptrdiff_t met = 0;  // of the first row's large terms
      for (Iterator it(A_, result_.orbits[size_t(i)][size_t(s)]); it && same; ++it) {
        const int orbit = orbit_of_[size_t(it.col())], turn = sector_of_[size_t(it.col())] - s;
        const double first = weight(orbit, orbit < result_.fixed ? 0 : turn < 0 ? turn + result_.n : turn);
        met += is_large(first);
        same = std::abs(it.value() - first) <= tolerance_;
      }
      same = same && met == large;
    }
    for (const SectorRows::Term& term : row) weight(term.orbit, term.turn) = 0;
    result_.rows.push_back(row);
    return same;
  }

  const SparseMatrix& A_;
  SectorRows& result_;
  std::vector<int> orbit_of_, sector_of_;  // by slot
  std::vector<double> weight_;             // of the first row, by orbit and turn
  double tolerance_ = 0;
};

/// Slot 0 and p orbits around it.
std::vector<std::vector<int>> orbits_around(Eigen::Index slots, int n) {
  const int p = static_cast<int>(slots - 1) / n;
  std::vector<std::vector<int>> orbits{{0}};
  for (int i = 0; i < p; ++i) {
    orbits.emplace_back();
    for (int s = 0; s < n; ++s) orbits.back().push_back(1 + s * p + i);
  }
  return orbits;
}

}  // namespace

std::optional<SectorRows> sector_rows(const SparseMatrix& A, std::vector<std::vector<int>> orbits) {
  SectorRows result;
  std::stable_partition(orbits.begin(), orbits.end(), [](const auto& orbit) { return orbit.size() == 1; });
  for (const auto& orbit : orbits) {
    if (orbit.size() == 1)
      ++result.fixed;
    else if (result.n != 0 && result.n != static_cast<int>(orbit.size()))
      return std::nullopt;
    else
      result.n = static_cast<int>(orbit.size());
  }
  if (result.n < 2) return std::nullopt;
  result.orbits = std::move(orbits);
  if (!SectorRowsFinder(A, result).find()) return std::nullopt;
  result.components = strong_components(result.rows);
  for (int t = 0; t < result.n; ++t) result.roots.push_back(root_of_unity(t, result.n));
  return result;
}

std::optional<SectorRows> sector_rows(const SparseMatrix& A, int n) {
  if (n < 2 || (A.rows() - 1) % n != 0) return std::nullopt;
  return sector_rows(A, orbits_around(A.rows(), n));
}

std::optional<FourierBlocks> fourier_blocks(const Eigen::MatrixXd& A, std::vector<std::vector<int>> orbits) {
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

Eigen::MatrixXcd SectorRows::block(int k) const {
  const int first = k == 0 ? 0 : fixed, size = static_cast<int>(orbits.size());
  Eigen::MatrixXcd B = Eigen::MatrixXcd::Zero(size - first, size - first);
  for (int i = first; i < size; ++i)
    for (const Term& term : rows[size_t(i)])
      if (term.orbit >= first)
        B(i - first, term.orbit - first) +=
            term.weight * (term.orbit < fixed ? 1.0 : roots[size_t(std::int64_t{k} * term.turn % n)]);
  return B;
}

std::vector<Complex> SectorRows::values(int k) const {
  const int first = k == 0 ? 0 : fixed;
  const Eigen::MatrixXcd B = block(k);
  std::vector<Complex> values;
  for (const std::vector<int>& component : components) {
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

Eigen::VectorXcd SectorRows::mask(int k, const Eigen::VectorXcd& l) const {
  const int first = k == 0 ? 0 : fixed, size = static_cast<int>(orbits.size());
  Eigen::VectorXcd result = Eigen::VectorXcd::Zero(fixed + n * (size - fixed));
  for (int i = first; i < size; ++i)
    for (int s = 0; s < static_cast<int>(orbits[i].size()); ++s)
      result[orbits[i][s]] =
          i < fixed ? l[i] : l[i - first] * std::conj(roots[size_t(std::int64_t{k} * s % n)]) / static_cast<double>(n);
  return result;
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
