// SPDX-License-Identifier: Apache-2.0
#pragma once
// 256-bit floats, the reference for results in double.
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>

namespace sublimit::testing {

/// 77 decimal digits, 256 bits.
using Precise =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<77, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

}  // namespace sublimit::testing
