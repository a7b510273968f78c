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

/// Masks by slot of a canonical neighbourhood.
struct [[nodiscard]] LimitMasks {
  using Mask = Eigen::VectorXd;

  /// Answers to the question if the surface has a tangent plane at the vertex, on this side, for generic control
  /// points.
  enum class Plane {
    yes,
    slow,  ///< yes, but at a Jordan block: normals around the vertex converge like 1/steps only
    tied,  ///< only for control points that take all of `second_order`, which decays like tangent2, in its direction
    no,    ///< other modes do not decay faster than the tangents': a cone, a fold, or normals that differ for ever
  };
  struct Side {
    Index fan = 0, first_corner = 0, num_corners = 0;  ///< corners of the neighbourhood's fan, counter-clockwise
    Mask tangent1, tangent2;  ///< tangent1 x tangent2 is along the normal, per unit of the characteristic parameter
    /// The next modes, for control points that make the tangents degenerate. Where more than some decay alike, sums of
    /// them that span the same.
    std::vector<Mask> second_order;
    Plane plane = Plane::yes;
    double lambda1 = 0, lambda2 = 0;  ///< moduli that the tangents shrink by in a step
  };

  Rule rule = Rule::smooth;  ///< once all finite sharpness is gone
  int steps = 0;             ///< until the neighbourhood is stationary
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
  int depth = 0;  ///< of the walk on a mesh that must have this signature
  std::vector<std::uint32_t> signature;
  std::vector<Index> slots;  ///< of that walk; the masks are over these
  LimitMasks masks;          ///< of one side
};

/// Limit masks of a type, or nothing where it does not have a child of its own type.
/// @throws AnalysisError  no limit, as above
std::optional<IsolatedLimit> isolated_limit(const Scheme<double>& scheme, const LocalType& type);

}  // namespace sublimit
