// SPDX-License-Identifier: Apache-2.0
#pragma once
// The one mask that a scheme has on regular meshes, over a whole period of levels: read off the local matrix of a
// regular centre, whose labels are coordinates of the plane. new(p') = sum over p of mask(p' - dilation p) old(p).
//
// Coordinates are steps along two edges of a face: square grids at a right angle, triangular ones at 60 degrees (the
// edges are (1,0), (0,1) and (-1,1)). The points of dual schemes lie at halves, those of primal ones at whole numbers.
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/certificates/regularity/rational.h"
#include "sublimit/neighborhood/local_patch.h"

namespace sublimit {

enum class RegularGrid { square, triangular };

/// Steps along the two directions.
using Offset = std::array<int, 2>;

template <class T>
struct RegularMask {
  RegularGrid grid = RegularGrid::square;
  int dilation = 2;
  bool dual =
      false;  ///< points lie at halves; then `weights` has p' - dilation p + (dilation - 1)/2, whole numbers too
  std::map<Offset, T> weights;  ///< none is zero

  /// p' - dilation p of a weight's key, doubled.
  Offset doubled(const Offset& key) const {
    const int shift = dual ? dilation - 1 : 0;
    return {2 * key[0] - shift, 2 * key[1] - shift};
  }
};

/// Doubled coordinates in the plane of a label around a regular centre.
inline Offset plane_position(const SectorLabel& label, RegularGrid grid) {
  constexpr Offset square[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  constexpr Offset triangular[] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
  const bool is_square = grid == RegularGrid::square;
  const int n = is_square ? 4 : 6, s = label.sector % n, t = (s + 1) % n;
  const Offset& a = is_square ? square[s] : triangular[s];
  const Offset& b = is_square ? square[t] : triangular[t];
  return {label.x2 * a[0] + label.y2 * b[0], label.x2 * a[1] + label.y2 * b[1]};
}

/// Equal, up to rounding of doubles; other number types decide by themselves.
template <class T>
bool same_weight(const T& a, const T& b) {
  return a == b;
}
inline bool same_weight(const Rational& a, const Rational& b) { return a.is_ratio() && a == b; }
inline bool same_weight(double a, double b) { return std::abs(a - b) <= 1e-13; }

/// @throws AnalysisError  rows of the local matrix are not one mask: a period that does not bring labels back
template <class T>
RegularMask<T> regular_mask(const Scheme<T>& scheme) {
  RegularMask<T> mask;
  mask.grid = scheme.face_size() == 3 ? RegularGrid::triangular : RegularGrid::square;
  mask.dilation = scheme.steps[0].split == Split::sqrt3 ? 3 : 2;
  mask.dual = scheme.is_dual();
  LocalType type;
  type.kind = mask.dual ? Centre::Kind::face : Centre::Kind::vertex;
  type.faces = mask.grid == RegularGrid::triangular ? 6 : 4;
  const int rings = mask.dual ? 1 : 2;  // all residues modulo the dilation
  const std::optional<LocalPatch<T>> patch = local_patch(scheme, type, rings);
  if (!patch) throw AnalysisError(scheme.name + ": a regular centre has no child of its own type");
  const int shift = mask.dual ? mask.dilation - 1 : 0;
  std::vector<Offset> places;
  for (const SectorLabel& label : patch->labels) places.push_back(plane_position(label, mask.grid));
  std::map<Offset, T> all;  // zeros too
  for (size_t i = 0; i < places.size(); ++i)
    for (size_t j = 0; j < places.size(); ++j) {
      Offset key;
      for (const int k : {0, 1}) {
        const int twice = places[i][k] - mask.dilation * places[j][k] + shift;
        if (twice % 2 != 0) throw AnalysisError(scheme.name + ": labels of the regular mesh are not a grid");
        key[k] = twice / 2;
      }
      const T weight = patch->A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const auto known = all.emplace(key, weight).first;
      if (!same_weight(known->second, weight))
        throw AnalysisError(scheme.name + ": weights of the regular mesh differ between places");
    }
  for (const auto& [key, weight] : all)
    if (!(weight == T(0))) mask.weights.emplace(key, weight);
  return mask;
}

}  // namespace sublimit
