// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tangent masks from local matrices: closed rings by Fourier blocks, borders by their outline, which is a curve scheme
// of its own.
#include <optional>
#include <vector>

#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/limit/detail/limit_masks.h"

namespace sublimit {

using Slots = std::vector<Index>;

bool decays_like(double modulus, double lambda);

/// Weights on some slots as a mask over `size` of them.
Eigen::VectorXd embedded(const Eigen::VectorXd& weights, const Slots& slots, Index size);

/// Returns a complex vector that is real up to a phase as a real one.
Eigen::VectorXd made_real(const Eigen::VectorXcd& v);

/// Mask of the limit position: the left eigenvector of eigenvalue 1, over what the centre's own slots depend on.
/// @param ring  of a neighbourhood that looks the same from every sector
Eigen::VectorXd position_mask(const SparseMatrix& A, const Slots& centre, const std::optional<SectorRows>& ring);

/// A closed ring that looks the same from every sector: the tangents are the cosine and the sine mask of block 1.
void add_ring_tangents(LimitMasks::Side& side, const SectorRows& ring);

/// Returns whether there is a tangent plane, by all modes of a closed ring. The modes of block 1 with the largest
/// modulus, and among these the longest Jordan chains, must be alone.
LimitMasks::Plane ring_plane(const SectorRows& ring);

/// Where a side ends: the slots of the border curve and those inside; `first` and `last` are the centre's neighbours on
/// the curve, with the side on the left of the way from the centre to `first`.
struct Outline {
  Slots curve, inner;
  Slots centre{0}, inner_ring;  ///< the centre's own points, and the inner ones next to it
  Index first = 0, last = 0;
};
/// One side between two sharp edges. Its outline gives the tangent along a crease, or the two tangents of a corner
/// (slot 0); the leading mode of the interior crosses a crease.
void add_border_tangents(LimitMasks::Side& side, const SparseMatrix& A, const Outline& outline, bool is_corner);

/// Any neighbourhood: the two leading modes, rotated so that `ring`, counter-clockwise around slot 0, is so in the
/// characteristic map.
void add_free_tangents(LimitMasks::Side& side, const SparseMatrix& A, const Slots& ring);

}  // namespace sublimit
