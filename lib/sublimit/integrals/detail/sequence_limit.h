// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit of a sequence s_k = s + c_1 q_1^k + c_2 q_2^k + ... with unknown c_i and q_i, such as sums over
// successively refined meshes. The epsilon algorithm eliminates one power after another; a double one, (c + d
// k) q^k, counts as two.
// Source: Wynn, "On a device for computing the e_m(S_n) transformation", Math. Tables Aids Comput. 10 (1956).
#include <span>

namespace sublimit {

/// Returns the extrapolated limit of a sequence.
/// @param s  the first terms, at least one
/// @return  the last term if extrapolation gives nothing better: fewer than three terms, or differences of the
///          size of rounding
double sequence_limit(std::span<const double> s);

}  // namespace sublimit
