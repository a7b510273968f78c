// SPDX-License-Identifier: Apache-2.0
#pragma once
// The characteristic map of a neighbourhood: the limit of the net whose points are the leading right eigenvector of
// Fourier block 1, as points of the complex plane. All of it in balls that enclose the true net.
//
//   net(s; x, y) = exp(2 pi i s/n) net(0; x, y),    chi(2 p) = chi(p)/lambda
//
// The eigenvector is known on the closed set of the local matrix; further out it goes on by the regular mask, since
// lambda net = A net.
#include <map>
#include <optional>

#include "sublimit/certificates/detail/exact_schemes.h"
#include "sublimit/certificates/detail/leading_pair.h"
#include "sublimit/certificates/detail/sector_chart.h"

namespace sublimit {

struct RegularPieces;

struct CharacteristicMap {
  int n = 0;
  ComplexBall lambda;
  std::map<LatticePoint, ComplexBall> net;  ///< of sector 0, by label; further rings are added as they are asked for
  RegularMask<Algebraic> mask;              ///< of the regular part

  /// A point of the plane around sector 0. Nothing where it has no label, or the mask reaches too far.
  std::optional<ComplexBall> at(LatticePoint p);
};

/// Fourier block k of a closed neighbourhood, over the labels of sector 0 (and the centre first, in block 0).
DenseMatrix<ComplexBall> fourier_block(const LocalPatch<Algebraic>& patch, int k);
/// Those labels, in its order.
std::vector<SectorLabel> block_labels(const LocalPatch<Algebraic>& patch, int k);

/// The net of the leading pair of block 1.
CharacteristicMap characteristic_map(const LocalPatch<Algebraic>& patch, const RegularMask<Algebraic>& mask,
                                     const LeadingPair& pair);

/// Where the neighbourhood is regular: the least r >= 1 such that all pieces of cells between rings r and D r (D:
/// dilation), and all of their children, depend on points and rows of the regular mask alone. Rows outside the patch
/// are taken to be so: rules see no further than theirs inside.
/// @return  nothing up to r = 4
std::optional<int> regular_ring(const LocalPatch<Algebraic>& patch, const RegularPieces& pieces);

/// A piece of sector 0.
struct PlacedPiece {
  size_t piece;
  LatticePoint cell;
};
/// Those between rings r and D r: a fundamental domain of the punctured neighbourhood, without rotation and dilation.
std::vector<PlacedPiece> sector_pieces(const RegularPieces& pieces, int r);

}  // namespace sublimit
