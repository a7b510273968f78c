// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a sequence tends to that converges by sums of powers, s_k = s + c_1 q_1^k + c_2 q_2^k + ..., with none of them
// known: as what is summed over refined meshes does. The epsilon algorithm drops one power after another, a double one
// (c + d k) q^k as two.
// Source: Wynn, "On a device for computing the e_m(S_n) transformation", Math. Tables Aids Comput. 10 (1956).
#include <span>

namespace sublimit {

/// @param s  one number at least
/// @return  the last number where nothing better is known: of two, or where differences are rounding
double sequence_limit(std::span<const double> s);

}  // namespace sublimit
