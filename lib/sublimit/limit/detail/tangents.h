// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tangent masks from local matrices: for closed rings from their Fourier blocks, for borders from the border
// curve, which has a curve scheme of its own.
#include <optional>
#include <vector>

#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/limit/detail/limit_masks.h"

namespace sublimit {

using Slots = std::vector<Index>;

/// True if a mode of eigenvalue modulus `modulus` decays as slowly as `lambda`, or more slowly, up to 1e-9
/// relative.
bool decays_like(double modulus, double lambda);

/// Returns weights on some slots as a mask over all `size` slots.
Eigen::VectorXd embedded(const Eigen::VectorXd& weights, const Slots& slots, Index size);

/// Returns the real vector that a complex one is up to a phase.
Eigen::VectorXd made_real(const Eigen::VectorXcd& v);

/// Returns the mask of the limit position: the left eigenvector of eigenvalue 1, over the slots that those of
/// the centre depend on.
/// @param ring  sector rows of A, if the neighbourhood is the same in every sector
Eigen::VectorXd position_mask(const SparseMatrix& A, const Slots& centre, const std::optional<SectorRows>& ring);

/// Adds tangents, second order and plane for a closed ring that is the same in every sector: the tangents are
/// the cosine and the sine mask of block 1.
void add_ring_tangents(LimitMasks::Side& side, const SectorRows& ring);

/// Returns whether a closed ring has a tangent plane. It does if the leading modes of block 1 dominate all
/// other modes except the constant, in modulus or, among equal moduli, by the length of their Jordan chains.
LimitMasks::Plane ring_plane(const SectorRows& ring);

/// Border curve of a side.
struct Outline {
  Slots curve, inner;           ///< slots on the border curve, and slots inside
  Slots centre{0}, inner_ring;  ///< slots of the centre, and the inner ones next to it
  Index first = 0, last = 0;    ///< neighbours of the centre on the curve; the side is left of centre -> `first`
};
/// Adds tangents, second order and plane for a side between two sharp edges. The border curve gives the tangent
/// along a crease, or both tangents of a corner at slot 0; the leading mode of the interior gives the tangent
/// across a crease.
void add_border_tangents(LimitMasks::Side& side, const SparseMatrix& A, const Outline& outline, bool is_corner);

/// Adds tangents for a neighbourhood without symmetry: the two leading modes, oriented such that `ring`, the
/// slots counter-clockwise around slot 0, is counter-clockwise in the characteristic map.
void add_free_tangents(LimitMasks::Side& side, const SparseMatrix& A, const Slots& ring);

}  // namespace sublimit
