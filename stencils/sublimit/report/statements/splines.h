// SPDX-License-Identifier: Apache-2.0
#pragma once
// Experiments on B-splines over knots, by the recurrence of Cox and de Boor in exact ratios.
#include "sublimit/report/statements/finding.h"

namespace sublimit::report {

/// "Pieces of splines of degree n are polynomials of degree n + `more`", n = 1 ... 4.
Finding pieces_have_degree(int more);

/// "In the recurrence the first factor rises from 0 to 1 on its support and the second one falls", or the other way
/// around.
Finding first_factor(bool rises);

/// "A basis function of degree n is given by n + `more` knots", n = 1 ... 4.
Finding one_function_has_knots(int more);

/// "The basis functions sum to 1", on all of the knots or where `all` are not zero.
Finding functions_sum_to_one(bool everywhere);

/// "Splines of degree 3 are C^(3 - `minus`) at a knot of these multiplicities."
Finding continuous_at_knots(const std::vector<int>& multiplicities, int minus = 1);

/// "A segment with the blends of the Coons cubic goes through its first and last inner point", and whether those blends
/// are the uniform cubic B-spline's.
Finding coons_cubic_interpolates();

}  // namespace sublimit::report
