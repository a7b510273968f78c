// SPDX-License-Identifier: Apache-2.0
#pragma once
// The Fourier blocks around an extraordinary point as functions of the valence n. With w = exp(2 pi i/n) and t = 1/n,
//
//   block 1 = L(w),   blocks k = 2 ... n - 2: M(w^k),   block 0 = Z(cos(2 pi t), t),
//
// where L and M are polynomials in w and 1/w and Z is one in both arguments, all with rational coefficients. They are
// determined at three prime valences, where the coefficients of an element of the cyclotomic field give such a
// polynomial uniquely, and then compared exactly with the blocks at other valences. L and M differ if the
// weights of an n-gon contain cosines (Doo-Sabin).
#include <array>
#include <optional>
#include <vector>

#include "sublimit/certificates/c1/c1_certificate.h"
#include "sublimit/certificates/numbers/detail/polynomial.h"

namespace sublimit {

/// Laurent polynomial in w: coefficients of w^-2 ... w^2.
using TurnPolynomial = std::array<Algebraic, 5>;
/// Polynomial in cos(2 pi t) and t: [a][b] is the coefficient of cos(2 pi t)^a t^b.
using RingPolynomial = std::array<std::array<Algebraic, 3>, 3>;

template <class T>
using MatrixRows = std::vector<std::vector<T>>;

/// Blocks as functions of the valence.
struct ValenceFamily {
  bool has_centre = false;                  ///< true if block 0 has the centre as its row and column 0
  std::vector<SectorLabel> labels;          ///< labels of sector 0 without the centre: rows of the other blocks
  MatrixRows<TurnPolynomial> first, other;  ///< block 1, and blocks 2 ... n - 2
  MatrixRows<RingPolynomial> zero;          ///< block 0
  std::optional<int> ring;                  ///< `regular_ring`, if it is the same at all valences compared
  std::vector<int> checked;                 ///< valences at which all blocks were compared
};

/// Returns the blocks of a scheme as functions of the valence.
/// @param valences  valences to compare at, each at least 7
/// @return  nothing if blocks at one of them do not have this form, the matrix is not the same for all sectors,
///          or labels depend on the valence
std::optional<ValenceFamily> valence_family(const C1Prover& prover, const std::vector<int>& valences);

/// Returns a mirror-symmetric block in a basis in which it is real, with polynomials in h = cos(phi/2) as
/// entries.
///
/// Let w = exp(i phi) and s = sin(phi/2). The unknown of a point on spoke 0 is its value. That of a point on
/// the middle of the sector is x, where its value is x exp(i phi/2). Those of a pair of points (x, y) and (y,
/// x), x > y, are a and b, where the values are a + i s b and w (a - i s b). The limit h -> 1 is thus no
/// special case. For s != 0 the real matrix is similar to the block.
/// @return  nothing if the block is not mirror-symmetric
std::optional<MatrixRows<Polynomial>> real_block(const std::vector<SectorLabel>& labels,
                                                 const MatrixRows<TurnPolynomial>& block);

}  // namespace sublimit
