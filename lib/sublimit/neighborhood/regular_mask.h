// SPDX-License-Identifier: Apache-2.0
#pragma once
// The one mask that a scheme has on regular meshes, over a whole period of levels: read off the local matrix of a
// regular centre, whose labels are coordinates of the plane. In any number type.
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

/// Whole steps along the two directions.
using Offset = std::array<int, 2>;

/// A place of the plane, in halves of an edge.
struct LatticePoint {
  int x2 = 0, y2 = 0;
  int operator[](int k) const { return k == 0 ? x2 : y2; }
  auto operator<=>(const LatticePoint&) const = default;
  friend LatticePoint operator+(LatticePoint a, LatticePoint b) { return {a.x2 + b.x2, a.y2 + b.y2}; }
  friend LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.x2 - b.x2, a.y2 - b.y2}; }
  friend LatticePoint operator*(int k, LatticePoint a) { return {k * a.x2, k * a.y2}; }
};

/// Where a label of a regular centre lies: sector s is sector 0 rotated s times.
inline LatticePoint unrolled(const SectorLabel& label, bool triangular) {
  LatticePoint p{label.x2, label.y2};
  for (int s = 0; s < label.sector; ++s) p = triangular ? LatticePoint{-p.y2, p.x2 + p.y2} : LatticePoint{-p.y2, p.x2};
  return p;
}

template <class T>
struct RegularMask {
  bool triangular = false;
  bool dual = false;  ///< points lie around a face, at odd halves
  int dilation = 2;
  std::map<Offset, T> weights = {};  ///< by i - dilation j; none is zero

  bool operator==(const RegularMask&) const = default;

  /// P - dilation Q of a weight's key, P and Q being places.
  LatticePoint doubled(const Offset& key) const { return {2 * key[0] - shift(), 2 * key[1] - shift()}; }
  /// The weights by that.
  std::map<LatticePoint, T> plane_weights() const {
    std::map<LatticePoint, T> by_place;
    for (const auto& [key, weight] : weights) by_place.emplace(doubled(key), weight);
    return by_place;
  }
  /// Least and greatest coordinates of these.
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
  /// How far new points are from the old ones that they see, at most, along an axis; in halves.
  int reach2() const {
    const LatticePoint l = low(), h = high();
    return std::max({-l.x2, -l.y2, h.x2, h.y2});
  }

  /// The place Q of the old point that a new point at P is P - dilation Q = offset from; nothing where none lies there.
  std::optional<LatticePoint> parent(LatticePoint P, LatticePoint offset) const {
    const LatticePoint d = P - offset;
    if (d.x2 % dilation != 0 || d.y2 % dilation != 0) return std::nullopt;
    const LatticePoint Q{d.x2 / dilation, d.y2 / dilation};
    return has_point(Q) ? std::optional(Q) : std::nullopt;
  }
  /// A point of the grid lies there.
  bool has_point(LatticePoint p) const { return (p.x2 % 2 != 0) == dual && (p.y2 % 2 != 0) == dual; }

  /// Rings with modes of their own: further points are made by points nearer to the centre. A point r rings away sees
  /// points (r + reach)/dilation away, which are further out only for r < reach/(dilation - 1).
  int recurrent_rings() const {
    const int steps = 2 * (dilation - 1);
    return (reach2() + steps - 1) / steps;
  }

 private:
  int shift() const { return dual ? dilation - 1 : 0; }
};

/// Equal; of floating numbers: up to the rounding of a few steps' masks, whose weights are about 1.
template <class T>
bool is_same_weight(const T& a, const T& b) {
  if constexpr (std::numeric_limits<T>::is_specialized && !std::numeric_limits<T>::is_exact) {
    using std::abs;
    return abs(a - b) <= 512 * std::numeric_limits<T>::epsilon();
  } else {
    return a == b;
  }
}

/// @throws AnalysisError  rows of the local matrix are not one mask: a period that does not bring labels back, or
///                        weights that T cannot hold
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
