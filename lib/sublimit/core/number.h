// SPDX-License-Identifier: Apache-2.0
#pragma once
// Constants of masks in any number type: ratios of integers and cosines of 2 pi k/n. A type with a better way to make
// them (balls, algebraic numbers) specialises Number; masks need no change.
//
//   const double beta = Number<double>::ratio(5, 8) - Number<double>::ratio(1, 4) * Number<double>::cos_2pi(1, 5);
#include <cmath>

namespace sublimit {

/// Constants of the number type T.
template <class T>
struct Number {
  /// Returns p/q, q not 0.
  static T ratio(int p, int q) { return T(p) / T(q); }

  /// Returns cos(2 pi k/n), n > 0; exact if it is 0, +-1/2 or +-1.
  static T cos_2pi(int k, int n) {
    k = k % n < 0 ? k % n + n : k % n;
    if (2 * k > n) k = n - k;                          // cos is even
    if (4 * k > n) return -cos_2pi(n - 2 * k, 2 * n);  // and changes sign at a half turn
    if (k == 0) return T(1);
    if (4 * k == n) return T(0);
    if (6 * k == n) return ratio(1, 2);
    using std::acos;
    using std::cos;
    using std::sin;
    const T pi = acos(T(-1));
    if (8 * k > n) return sin(pi * T(n - 4 * k) / T(2 * n));  // near the quarter turn a sine keeps the digits
    return cos(pi * T(2 * k) / T(n));
  }
};

}  // namespace sublimit
