// SPDX-License-Identifier: Apache-2.0
#pragma once
// The mask of a scheme on regular meshes over a whole period of levels, in any number type. It is read off the
// local matrix of a regular centre, whose labels are coordinates in the plane.
//
//   new(i) = sum over j of weights(i - dilation j) old(j)
//
// Points are numbered by steps along two edges of a face: square grids at a right angle, triangular ones at 60 degrees
// (the edges are (1,0), (0,1) and (-1,1)). Point i lies at i, in dual schemes at i + 1/2; so weights are also the
// coefficients of the scheme's symbol.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/neighborhood/local_patch.h"

namespace sublimit {

/// Number of steps along each of the two directions.
using Offset = std::array<int, 2>;

/// A place in the plane; coordinates in half edges.
struct LatticePoint {
  int x2 = 0, y2 = 0;
  int operator[](int k) const { return k == 0 ? x2 : y2; }
  auto operator<=>(const LatticePoint&) const = default;
  friend LatticePoint operator+(LatticePoint a, LatticePoint b) { return {a.x2 + b.x2, a.y2 + b.y2}; }
  friend LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.x2 - b.x2, a.y2 - b.y2}; }
  friend LatticePoint operator*(int k, LatticePoint a) { return {k * a.x2, k * a.y2}; }
};

/// Returns the place of a label around a regular centre: sector s is sector 0 rotated s times.
inline LatticePoint unrolled(const SectorLabel& label, bool triangular) {
  LatticePoint p{label.x2, label.y2};
  for (int s = 0; s < label.sector; ++s) p = triangular ? LatticePoint{-p.y2, p.x2 + p.y2} : LatticePoint{-p.y2, p.x2};
  return p;
}

/// The mask: new(i) = sum over j of weights(i - dilation j) old(j).
template <class T>
struct RegularMask {
  bool triangular = false;
  bool dual = false;  ///< points are at odd half coordinates, the centre is a face
  int dilation = 2;
  std::map<Offset, T> weights = {};  ///< nonzero weights by i - dilation j

  bool operator==(const RegularMask&) const = default;

  /// Returns P - dilation Q for the key of a weight, where P and Q are the places of the new and the old point.
  LatticePoint doubled(const Offset& key) const { return {2 * key[0] - shift(), 2 * key[1] - shift()}; }
  /// Returns the weights by P - dilation Q.
  std::map<LatticePoint, T> plane_weights() const {
    std::map<LatticePoint, T> by_place;
    for (const auto& [key, weight] : weights) by_place.emplace(doubled(key), weight);
    return by_place;
  }
  /// Returns the least and, in `high`, the greatest coordinates of P - dilation Q.
  LatticePoint low() const {
    Offset least = weights.begin()->first;
    for (const auto& [key, weight] : weights) least = {std::min(least[0], key[0]), std::min(least[1], key[1])};
    return doubled(least);
  }
  LatticePoint high() const {
    Offset greatest = weights.begin()->first;
    for (const auto& [key, weight] : weights) greatest = {std::max(greatest[0], key[0]), std::max(greatest[1], key[1])};
    return doubled(greatest);
  }
  /// Returns the largest coordinate of P - dilation Q in modulus, in half edges.
  int reach2() const {
    const LatticePoint l = low(), h = high();
    return std::max({-l.x2, -l.y2, h.x2, h.y2});
  }

  /// Returns the place Q with P - dilation Q = offset, if an old point lies there.
  std::optional<LatticePoint> parent(LatticePoint P, LatticePoint offset) const {
    const LatticePoint d = P - offset;
    if (d.x2 % dilation != 0 || d.y2 % dilation != 0) return std::nullopt;
    const LatticePoint Q{d.x2 / dilation, d.y2 / dilation};
    return has_point(Q) ? std::optional(Q) : std::nullopt;
  }
  /// True if a point of the grid lies at a place.
  bool has_point(LatticePoint p) const { return (p.x2 % 2 != 0) == dual && (p.y2 % 2 != 0) == dual; }

  /// Returns the number of rings that determine all others. A point r rings away depends on points at most
  /// (r + reach)/dilation away, which is nearer to the centre unless r < reach/(dilation - 1).
  int recurrent_rings() const {
    const int steps = 2 * (dilation - 1);
    return (reach2() + steps - 1) / steps;
  }

 private:
  int shift() const { return dual ? dilation - 1 : 0; }
};

/// True if two weights are equal; for floating-point numbers up to 512 eps, the rounding of the masks of a few
/// steps.
template <class T>
bool is_same_weight(const T& a, const T& b) {
  if constexpr (std::numeric_limits<T>::is_specialized && !std::numeric_limits<T>::is_exact) {
    using std::abs;
    return abs(a - b) <= 512 * std::numeric_limits<T>::epsilon();
  } else {
    return a == b;
  }
}

/// Returns the regular mask of a scheme.
/// @throws AnalysisError  the rows of the local matrix do not agree on one mask: the period does not restore
///                        directions, or T cannot represent the weights
template <class T>
RegularMask<T> regular_mask(const Scheme<T>& scheme) {
  RegularMask<T> mask{.triangular = scheme.face_size() == 3,
                      .dual = scheme.is_dual(),
                      .dilation = scheme.steps[0].split == Split::sqrt3 ? 3 : 2};
  const LocalType type{.kind = mask.dual ? Centre::Kind::face : Centre::Kind::vertex, .faces = mask.triangular ? 6 : 4};
  const int rings = mask.dual ? 1 : 2;  // all residues modulo the dilation
  const std::optional<LocalPatch<T>> patch = local_patch(scheme, type, rings);
  if (!patch) throw AnalysisError(scheme.name + ": a regular centre has no child of its own type");
  std::vector<LatticePoint> places;
  for (const SectorLabel& label : patch->labels) places.push_back(unrolled(label, mask.triangular));
  const LatticePoint zero = mask.doubled({0, 0});
  for (size_t i = 0; i < places.size(); ++i)
    for (size_t j = 0; j < places.size(); ++j) {
      const LatticePoint d = places[i] - mask.dilation * places[j] - zero;
      if (d.x2 % 2 != 0 || d.y2 % 2 != 0) throw AnalysisError(scheme.name + ": labels of the regular mesh are no grid");
      const T& weight = patch->A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const auto known = mask.weights.emplace(Offset{d.x2 / 2, d.y2 / 2}, weight).first;
      if (!is_same_weight(known->second, weight))
        throw AnalysisError(scheme.name + ": weights of the regular mesh differ between places");
    }
  std::erase_if(mask.weights, [](const auto& w) { return is_same_weight(w.second, T(0)); });
  return mask;
}

}  // namespace sublimit
