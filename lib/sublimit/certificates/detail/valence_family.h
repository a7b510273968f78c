// SPDX-License-Identifier: Apache-2.0
#pragma once
// The Fourier blocks around an extraordinary point as functions of the valence n. With w = exp(2 pi i/n) and t = 1/n,
//
//   block 1 = L(w),   blocks k = 2 ... n - 2: M(w^k),   block 0 = Z(cos(2 pi t), t),
//
// where L and M are polynomials in w and 1/w and Z is one in both arguments, all with rational coefficients. They are
// read off at three prime valences, where such polynomials are found in the coefficients of an element of the
// cyclotomic field without a choice, and then compared with the blocks at other valences, exactly. L and M differ where
// the weights of an n-gon have cosines (Doo-Sabin).
#include <array>
#include <optional>
#include <vector>

#include "sublimit/certificates/detail/c1_certificate.h"
#include "sublimit/certificates/detail/polynomial.h"

namespace sublimit {

/// Coefficients of w^-2 ... w^2.
using TurnPolynomial = std::array<Algebraic, 5>;
/// [a][b]: coefficient of cos(2 pi t)^a t^b.
using RingPolynomial = std::array<std::array<Algebraic, 3>, 3>;

template <class T>
using MatrixRows = std::vector<std::vector<T>>;

struct ValenceFamily {
  bool has_centre = false;                  ///< it is row and column 0 of block 0
  std::vector<SectorLabel> labels;          ///< of sector 0, without the centre: rows of the other blocks
  MatrixRows<TurnPolynomial> first, other;  ///< block 1, and blocks 2 ... n - 2
  MatrixRows<RingPolynomial> zero;          ///< block 0
  std::optional<int> ring;                  ///< `regular_ring`, where it is the same at all valences compared
  std::vector<int> checked;                 ///< valences at which all blocks were compared
};

/// @param valences  to compare at; 7 and more
/// @return  nothing where blocks are not of this form at one of them, or the matrix does not look the same from all
///          sectors, or from some valence on it has other labels
std::optional<ValenceFamily> valence_family(const C1Prover& prover, const std::vector<int>& valences);

/// A block that is symmetric in a mirror, in the basis in which it is real: polynomials in h = cos(phi/2), w = exp(i
/// phi). Unknowns are, with s = sin(phi/2): of a point on spoke 0 the number itself; of one on the middle of the sector
/// x, it being x exp(i phi/2); and of (x, y), x > y, and (y, x) together a and b, they being a + i s b and its mirror
/// image w (a - i s b). So the limit h -> 1 is no other case than the rest. For s != 0 the two matrices are similar.
/// @return  nothing where it is not symmetric
std::optional<MatrixRows<Polynomial>> real_block(const std::vector<SectorLabel>& labels,
                                                 const MatrixRows<TurnPolynomial>& block);

}  // namespace sublimit
