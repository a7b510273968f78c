// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/difference_space.h"

#include <algorithm>

namespace sublimit {
namespace {

void add(Functional& sum, const Functional& u, const Rational& factor) {
  for (const auto& [place, weight] : u) {
    const auto at = sum.emplace(place, 0).first;
    at->second += factor * weight;
    if (at->second.is_zero()) sum.erase(at);
  }
}

/// The functional of the old points that is u of the new ones in cell `digit`.
Functional pulled_back(const Functional& u, const RegularMask<Rational>& mask, const Offset& digit) {
  Functional result;
  const int d = mask.dilation;
  for (const auto& [place, weight] : u)
    for (const auto& [key, a] : mask.weights) {
      const int x = place[0] + digit[0] - key[0], y = place[1] + digit[1] - key[1];
      if (x % d != 0 || y % d != 0) continue;
      const auto at = result.emplace(Offset{x / d, y / d}, 0).first;
      at->second += weight * a;
    }
  for (auto at = result.begin(); at != result.end();) at = at->second.is_zero() ? result.erase(at) : std::next(at);
  return result;
}

/// A basis in reduced echelon form: each functional is 1 at its pivot, where all others are 0.
class Echelon {
 public:
  /// Adds what is new in u; true if something was.
  bool add_new(Functional u) {
    for (size_t i = 0; i < basis_.size(); ++i) clear(u, i);
    if (u.empty()) return false;
    const Offset pivot = u.begin()->first;
    const Rational lead = u.begin()->second;
    for (auto& [place, weight] : u) weight /= lead;
    for (Functional& other : basis_) {
      const auto at = other.find(pivot);
      if (at != other.end()) add(other, u, -Rational(at->second));
    }
    basis_.push_back(std::move(u));
    pivots_.push_back(pivot);
    return true;
  }
  const std::vector<Functional>& basis() const { return basis_; }
  /// Of a functional in the span.
  Rational coordinate(const Functional& u, size_t i) const {
    const auto at = u.find(pivots_[i]);
    return at == u.end() ? Rational(0) : at->second;
  }

 private:
  void clear(Functional& u, size_t i) const {
    const auto at = u.find(pivots_[i]);
    if (at != u.end()) add(u, basis_[i], -Rational(at->second));
  }
  std::vector<Functional> basis_;
  std::vector<Offset> pivots_;
};

std::vector<Offset> digits(int dilation) {
  std::vector<Offset> all;
  for (int x = 0; x < dilation; ++x)
    for (int y = 0; y < dilation; ++y) all.push_back({x, y});
  return all;
}

Echelon space_of_differences(const RegularMask<Rational>& mask, int m, const Functional& first, int largest) {
  Echelon space;
  for (int i = 0; i <= m; ++i) {  // i differences along one direction, m - i along the other
    Functional u = first.empty() ? Functional{{{0, 0}, 1}} : first;
    for (int k = 0; k < m; ++k) {
      Functional moved;
      for (const auto& [place, weight] : u) moved[{place[0] + (k < i ? 1 : 0), place[1] + (k < i ? 0 : 1)}] = weight;
      add(u, moved, -1);
    }
    space.add_new(std::move(u));
  }
  const std::vector<Offset> cells = digits(mask.dilation);
  // Elements change while others are added, but their span only grows: rounds until all images are in it.
  for (bool is_closed = false; !is_closed;) {
    is_closed = true;
    const std::vector<Functional> now = space.basis();
    for (const Functional& u : now)
      for (const Offset& cell : cells) is_closed &= !space.add_new(pulled_back(u, mask, cell));
    if (static_cast<int>(space.basis().size()) > largest)
      throw AnalysisError("the space of differences of order " + std::to_string(m) + " has more than " +
                          std::to_string(largest) + " dimensions");
  }
  return space;
}

}  // namespace

Functional limit_functional(const RegularMask<Rational>& mask) {
  // Left eigenvector for 1 of the matrix with entries a(p' - dilation p) over the places that the origin needs.
  std::vector<Offset> places{{0, 0}};
  for (size_t i = 0; i < places.size(); ++i)
    for (const auto& [place, weight] : pulled_back({{places[i], 1}}, mask, {0, 0}))
      if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  const Eigen::Index n = static_cast<Eigen::Index>(places.size());
  // Unknowns: the weights. Equations: sum_i w_i A(i, j) - w_j = 0, one of which the sum 1 replaces.
  RationalMatrix M = RationalMatrix::Constant(n + 1, n + 1, Rational(0));
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const auto& [place, weight] : pulled_back({{places[i], 1}}, mask, {0, 0}))
      M(std::find(places.begin(), places.end(), place) - places.begin(), i) += weight;
    M(i, i) -= 1;
    M(n, i) = 1;
  }
  M(n, n) = 1;  // last column: right sides
  // One solution: a pivot in each column but the last.
  const std::vector<Eigen::Index> pivots = reduce_rows(M);
  if (static_cast<Eigen::Index>(pivots.size()) != n || pivots.back() != n - 1) return {};
  Functional result;
  for (Eigen::Index i = 0; i < n; ++i)
    if (!M(i, n).is_zero()) result[places[i]] = M(i, n);
  return result;
}

bool generates(const RegularMask<Rational>& mask, const Functional& values, int degree) {
  const Echelon space = space_of_differences(mask, degree + 1, values, 400);
  for (const Functional& u : space.basis())
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        Rational sum = 0;
        for (const auto& [place, weight] : u) {
          Rational term = weight;
          for (int k = 0; k < i; ++k) term *= place[0];
          for (int k = 0; k < j; ++k) term *= place[1];
          sum += term;
        }
        if (!sum.is_zero()) return false;
      }
  return true;
}

DifferenceTransitions difference_transitions(const RegularMask<Rational>& mask, int m, const Functional& first,
                                             int largest) {
  const Echelon space = space_of_differences(mask, m, first, largest);
  const std::vector<Offset> cells = digits(mask.dilation);
  const Eigen::Index n = static_cast<Eigen::Index>(space.basis().size());
  DifferenceTransitions t{.order = m, .dilation = mask.dilation};
  for (const Offset& cell : cells) {
    RationalMatrix A(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Functional image = pulled_back(space.basis()[i], mask, cell);
      for (Eigen::Index j = 0; j < n; ++j) A(i, j) = space.coordinate(image, j);
    }
    t.matrices.push_back(std::move(A));
  }
  return t;
}

}  // namespace sublimit
