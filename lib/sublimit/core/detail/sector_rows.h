// SPDX-License-Identifier: Apache-2.0
#pragma once
// Matrices with a cyclic symmetry, in any number type: a rotation by one of n sectors, or a mirror (n = 2), permutes
// the slots in orbits of n or leaves a slot fixed (an orbit of 1), and the matrix commutes with it. The rows of one
// sector are then the whole matrix, and with w = exp(2 pi i/n) it decomposes into Fourier blocks
//
//   B_k(i, j) = sum_t A(orbit_i[0], orbit_j[t]) w^(k t).
//
// An eigenvector x of B_k is one of A with the value x_i w^(k s) on slot s of orbit i. Fixed slots are only in block 0.
// The blocks of a mirror are the even one (k = 0) and the odd one. Eigenvalues of a block are those of the strongly
// connected components of its pattern: the diagonal blocks of its block triangular form.
#include <Eigen/Core>

#include <algorithm>
#include <complex>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sublimit/core/number.h"
#include "sublimit/core/types.h"

namespace sublimit {

/// Slots of each orbit of a symmetry, sector by sector.
using Orbits = std::vector<std::vector<Index>>;

/// Returns exp(2 pi i k/n), exact at quarter turns.
template <class Root>
Root root_of_unity(int k, int n) {
  if constexpr (requires { Root::root_of_unity(k, n); })
    return Root::root_of_unity(k, n);
  else
    return {Number<typename Root::value_type>::cos_2pi(k, n),
            Number<typename Root::value_type>::cos_2pi(4 * k - n, 4 * n)};
}

/// A matrix with a cyclic symmetry, as the rows of one sector.
/// @tparam T     weights
/// @tparam Root  entries of blocks; weights times roots of unity
template <class T, class Root>
struct SectorRowsOf {
  using Block = Eigen::Matrix<Root, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Root, Eigen::Dynamic, 1>;
  /// Weight of the slot of an orbit that lies `turn` sectors after that of the row.
  struct Term {
    int orbit, turn;
    T weight;
  };
  int n = 1;                            ///< number of sectors; 1 if all slots are fixed
  Orbits orbits;                        ///< each of n slots or of 1
  std::vector<std::vector<Term>> rows;  ///< row of the first slot of each orbit; terms by orbit and turn
  std::vector<Root> roots;              ///< exp(2 pi i t/n)

  /// Returns the orbits of the rows of block k, ascending.
  std::vector<int> places(int k) const {
    std::vector<int> places;
    for (size_t i = 0; i < orbits.size(); ++i)
      if (k == 0 || orbits[i].size() > 1) places.push_back(static_cast<int>(i));
    return places;
  }

  /// Returns Fourier block k.
  Block block(int k) const {
    const std::vector<int> places = this->places(k);
    const auto size = static_cast<Eigen::Index>(places.size());
    std::vector<Eigen::Index> at(orbits.size(), -1);
    for (Eigen::Index i = 0; i < size; ++i) at[size_t(places[size_t(i)])] = i;
    Block B = Block::Constant(size, size, Root(0));
    for (Eigen::Index i = 0; i < size; ++i)
      for (const Term& term : rows[size_t(places[size_t(i)])])
        if (const Eigen::Index j = at[size_t(term.orbit)]; j >= 0) B(i, j) += term.weight * power(k, term.turn);
    return B;
  }

  /// Returns a left eigenvector l of block k as a mask over the slots: sum_s sum_i l_i w^(-k s) x_(s,i) / n, plus
  /// l_i x_i of the fixed slots.
  Vector mask(int k, const Vector& l) const {
    size_t slots = 0;
    for (const std::vector<Index>& orbit : orbits) slots += orbit.size();
    Vector result = Vector::Constant(static_cast<Eigen::Index>(slots), Root(0));
    Eigen::Index row = 0;
    for (const int i : places(k)) {
      const std::vector<Index>& orbit = orbits[size_t(i)];
      for (size_t s = 0; s < orbit.size(); ++s)
        result[orbit[s]] = orbit.size() == 1 ? l[row] : Root(l[row] * conj(power(k, static_cast<int>(s))) / T(n));
      ++row;
    }
    return result;
  }

 private:
  /// w^(k turn)
  const Root& power(int k, int turn) const { return roots[size_t(std::int64_t{k} * turn % n)]; }
};

/// Returns the rows of one sector of a matrix; nothing if orbits have several sizes but 1, slots have no orbit, or the
/// matrix does not commute with the rotation: rows are compared with those of the first sector, rotated.
/// @param slots   number of rows and columns
/// @param row_of  row_of(i, visit) calls visit(column, weight) for each nonzero of row i, columns ascending
/// @param equal   whether two weights are equal, exactly or up to rounding
template <class T, class Root, class RowOf, class Equal>
std::optional<SectorRowsOf<T, Root>> sector_rows_of(Eigen::Index slots, Orbits orbits, const RowOf& row_of,
                                                    const Equal& equal) {
  using Term = typename SectorRowsOf<T, Root>::Term;
  SectorRowsOf<T, Root> result;
  std::vector<int> orbit_of(size_t(slots), -1), sector_of(size_t(slots), 0);
  for (size_t i = 0; i < orbits.size(); ++i) {
    const int size = static_cast<int>(orbits[i].size());
    if (size != 1 && result.n != 1 && result.n != size) return std::nullopt;
    if (size != 1) result.n = size;
    for (int s = 0; s < size; ++s) {
      orbit_of[size_t(orbits[i][size_t(s)])] = static_cast<int>(i);
      sector_of[size_t(orbits[i][size_t(s)])] = s;
    }
  }
  if (std::find(orbit_of.begin(), orbit_of.end(), -1) != orbit_of.end()) return std::nullopt;
  const int n = result.n;
  const T zero(0);

  /// What stays sees all sectors alike.
  const auto is_fixed_row = [&](const std::vector<Term>& row) {
    for (size_t first = 0, end = 0; first < row.size(); first = end) {
      while (end < row.size() && row[end].orbit == row[first].orbit) ++end;
      const bool all = end - first == orbits[size_t(row[first].orbit)].size();
      for (size_t k = first; k < end; ++k)
        if (!equal(row[k].weight, all ? row[first].weight : zero)) return false;
    }
    return true;
  };
  std::vector<T> weights(orbits.size() * size_t(n), zero);  // of the first sector's row, by orbit and turn
  std::vector<Index> met(weights.size(), 0);                // number of the last rotated row that has this weight
  Index rotated = 0;
  const auto at = [&](int orbit, int turn) { return size_t(orbit) * size_t(n) + size_t(turn < 0 ? turn + n : turn); };
  const auto are_rotated = [&](const std::vector<Index>& orbit, const std::vector<Term>& row) {
    for (const Term& term : row) weights[at(term.orbit, term.turn)] = term.weight;
    bool same = true;
    for (int s = 1; s < n && same; ++s) {
      ++rotated;
      row_of(orbit[size_t(s)], [&](Eigen::Index column, const T& weight) {
        const int i = orbit_of[size_t(column)];
        const size_t place = at(i, orbits[size_t(i)].size() == 1 ? 0 : sector_of[size_t(column)] - s);
        met[place] = rotated;
        same = same && equal(weight, weights[place]);
      });
      for (const Term& term : row)
        same = same && (met[at(term.orbit, term.turn)] == rotated || equal(zero, term.weight));
    }
    for (const Term& term : row) weights[at(term.orbit, term.turn)] = zero;
    return same;
  };
  for (const std::vector<Index>& orbit : orbits) {
    std::vector<Term>& row = result.rows.emplace_back();
    row_of(orbit[0], [&](Eigen::Index column, const T& weight) {
      row.push_back({orbit_of[size_t(column)], sector_of[size_t(column)], weight});
    });
    std::sort(row.begin(), row.end(),
              [](const Term& a, const Term& b) { return std::pair(a.orbit, a.turn) < std::pair(b.orbit, b.turn); });
    if (!(orbit.size() == 1 ? is_fixed_row(row) : are_rotated(orbit, row))) return std::nullopt;
  }
  result.orbits = std::move(orbits);
  for (int t = 0; t < n; ++t) result.roots.push_back(root_of_unity<Root>(t, n));
  return result;
}

/// Returns the strongly connected components of a matrix's rows, each ascending.
/// @param columns  columns of the nonzeros of each row, in any order, repeated or not
std::vector<std::vector<Index>> strong_components(const std::vector<std::vector<Index>>& columns);

}  // namespace sublimit
