// SPDX-License-Identifier: Apache-2.0
#pragma once
// The characteristic map of a neighbourhood: the limit of the net whose points are the leading right eigenvector of
// Fourier block 1, as points of the complex plane. All numbers are balls that enclose the true net.
//
//   net(s; x, y) = exp(2 pi i s/n) net(0; x, y),    chi(2 p) = chi(p)/lambda
//
// The eigenvector is computed on the closed set of the local matrix, and extended outwards by the regular mask,
// since lambda net = A net.
#include <map>
#include <optional>

#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/certificates/spectra/leading_pair.h"
#include "sublimit/certificates/spectra/sector_chart.h"
#include "sublimit/core/detail/sector_rows.h"

namespace sublimit {

struct RegularPieces;

/// The net of a characteristic map.
struct CharacteristicMap {
  int n = 0;
  ComplexBall lambda;
  std::map<LatticePoint, ComplexBall> net;  ///< points of sector 0, by label; `at` adds further rings on demand
  RegularMask<Algebraic> mask;              ///< mask in regular regions

  /// Returns the point at a place of the plane around sector 0; nothing if the place has no label, or the mask
  /// reaches too far.
  std::optional<ComplexBall> at(LatticePoint p);
};

/// Returns Fourier block k of a closed neighbourhood, over the labels of sector 0 (in block 0 after the
/// centre), whether or not the matrix commutes with the rotation.
DenseMatrix<ComplexBall> fourier_block(const LocalPatch<Algebraic>& patch, int k);
/// Returns the labels of the rows of `fourier_block`.
std::vector<SectorLabel> block_labels(const LocalPatch<Algebraic>& patch, int k);
/// Returns the positions in the patch of the points of each row of `fourier_block`, from sector 0 on.
Orbits block_orbits(const LocalPatch<Algebraic>& patch, int k);

/// Returns the characteristic map from the leading pair of block 1.
CharacteristicMap characteristic_map(const LocalPatch<Algebraic>& patch, const RegularMask<Algebraic>& mask,
                                     const LeadingPair& pair);

/// Returns the ring from which on the neighbourhood is regular: the least r >= 1 such that all pieces of cells
/// between rings r and D r (D: dilation), and all their children, depend only on rows of the regular mask. Rows
/// outside the patch are assumed to be regular.
/// @return  nothing if no r <= 4 is sufficient
std::optional<int> regular_ring(const LocalPatch<Algebraic>& patch, const RegularPieces& pieces);

/// A piece of sector 0: number of its kind, and its cell.
struct PlacedPiece {
  size_t piece;
  LatticePoint cell;
};
/// Returns the pieces of sector 0 between rings r and D r. Rotated and dilated, they cover the neighbourhood
/// without its centre.
std::vector<PlacedPiece> sector_pieces(const RegularPieces& pieces, int r);

}  // namespace sublimit
