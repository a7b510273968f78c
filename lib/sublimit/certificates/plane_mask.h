// SPDX-License-Identifier: Apache-2.0
#pragma once
// The one mask that a scheme has on regular meshes, exactly. Points lie in the plane where their labels say (a centre
// of valence 4, or 6 of triangles, whose sectors are unrolled), and then every rule is
//
//   new(P) = sum over Q of weight(P - dilation*Q) old(Q).
#include <map>
#include <optional>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/neighborhood/sector_labels.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// In halves of an edge; of triangles along two edges at 60 degrees.
struct LatticePoint {
  int x2 = 0, y2 = 0;
  auto operator<=>(const LatticePoint&) const = default;
  friend LatticePoint operator+(LatticePoint a, LatticePoint b) { return {a.x2 + b.x2, a.y2 + b.y2}; }
  friend LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.x2 - b.x2, a.y2 - b.y2}; }
  friend LatticePoint operator*(int k, LatticePoint a) { return {k * a.x2, k * a.y2}; }
};

struct PlaneMask {
  bool triangular = false;
  bool dual = false;  ///< points lie at odd halves around a face
  int dilation = 2;
  std::map<LatticePoint, Algebraic> weights = {};
  const Algebraic& operator()(LatticePoint offset) const;
  /// The point Q that new point P sees with weight(offset), offset = P - dilation*Q; nothing where none lies there.
  std::optional<LatticePoint> parent(LatticePoint P, LatticePoint offset) const {
    const LatticePoint d = P - offset;
    if (d.x2 % dilation != 0 || d.y2 % dilation != 0) return std::nullopt;
    const LatticePoint Q{d.x2 / dilation, d.y2 / dilation};
    return (Q.x2 % 2 != 0) == dual && (Q.y2 % 2 != 0) == dual ? std::optional(Q) : std::nullopt;
  }
  LatticePoint low() const;   ///< least coordinates of an offset
  LatticePoint high() const;  ///< greatest
  /// Rings with modes of their own: further points are made by points nearer to the centre.
  int recurrent_rings() const;
};

/// Where a label of a regular centre lies.
LatticePoint unrolled(const SectorLabel& label, bool triangular);

/// @throws AnalysisError  the rows around a regular centre are not one mask
PlaneMask plane_mask(const Scheme<Algebraic>& scheme);

}  // namespace sublimit
