// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact rational numbers, for identities that hold without rounding.
#include <boost/multiprecision/gmp.hpp>

namespace sublimit::testing {

using Fraction = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

}  // namespace sublimit::testing
