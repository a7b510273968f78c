// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit masks. At a stationary neighbourhood with local subdivision matrix A the limit position of the centre is l0^T
// x, where l0^T A = l0^T and l0^T 1 = 1; the tangents are the left eigenvectors of the subdominant pair. Where the
// neighbourhood is not stationary yet (irregular faces, decaying sharpness) the masks of a later level are pulled back
// through the steps.
//
// Infinitely sharp edges and boundaries cut the neighbourhood into sides, each with tangents of its own.
// Sources: Halstead, Kass, DeRose 1993; Reif 1995; Biermann, Levin, Zorin 2000 (boundaries, creases, corners).
#include <optional>
#include <vector>

#include "sublimit/neighborhood/canonical_neighborhood.h"
#include "sublimit/neighborhood/local_type.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Limit masks of a vertex, by slot of its canonical neighbourhood.
struct [[nodiscard]] LimitMasks {
  using Mask = Eigen::VectorXd;

  /// Whether one side of the surface has a tangent plane at the vertex, for generic control points.
  enum class Plane {
    yes,
    slow,  ///< yes, but with a Jordan block: normals around the vertex converge only like 1/steps
    tied,  ///< only if all vectors of `second_order`, which decay like tangent2, are parallel to it
    no,    ///< other modes decay no faster than those of the tangents: a cone, a fold, or normals without a limit
  };
  /// A side of the vertex: a closed fan, or a part of a fan between sharp edges or borders.
  struct Side {
    Index fan = 0, first_corner = 0, num_corners = 0;  ///< range of corners in a fan, counter-clockwise
    Mask tangent1, tangent2;  ///< tangent1 x tangent2 is along the normal, per unit of the characteristic parameter
    /// Masks of the next modes, for control points that make the tangents degenerate. If many modes decay at
    /// the same rate: a few random sums of them, which span the same line or plane.
    std::vector<Mask> second_order;
    Plane plane = Plane::yes;
    double lambda1 = 0, lambda2 = 0;  ///< factors by which tangent1 and tangent2 shrink in a step
  };

  Rule rule = Rule::smooth;  ///< rule of the vertex after finite sharpness has decayed
  int steps = 0;             ///< steps until the neighbourhood is stationary
  Mask position;
  std::vector<Side> sides;
};

/// Returns the limit masks of a neighbourhood.
/// @throws AnalysisError  no limit: the neighbourhood never becomes stationary, is not closed, or its matrix has not
///                        the simple dominant eigenvalue 1
LimitMasks limit_masks(const Scheme<double>& scheme, const CanonicalNeighborhood& type);

/// The limit of an isolated extraordinary centre.
struct IsolatedLimit {
  LocalType type;
  int depth = 0;                         ///< depth of the walk to compare on a mesh
  std::vector<std::uint32_t> signature;  ///< signature that this walk must have
  std::vector<Index> slots;              ///< slots of the walk that the masks are over
  LimitMasks masks;                      ///< masks of one side
};

/// Returns the limit of an isolated centre of a type; nothing if such a centre has no child of its own type.
/// @throws AnalysisError  no limit, as above
std::optional<IsolatedLimit> isolated_limit(const Scheme<double>& scheme, const LocalType& type);

}  // namespace sublimit
