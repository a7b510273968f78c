// SPDX-License-Identifier: Apache-2.0
#pragma once
// `spectrum` of a neighbourhood, and the entries that follow from it: lambda, mu, their ratio, and the blocks
// with mu.
#include "sublimit/certificates/spectra/exact_spectrum.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::report {

/// Adds `spectrum`, `lambda`, `mu`, `ratio` and `mu_blocks` to a neighbourhood.
void add_spectrum(Json& neighborhood, const ExactSpectrum& spectrum);

/// Returns the subdominant eigenvalue if it belongs to block 1 only, is real, and lies in the field of the
/// masks.
std::optional<Algebraic> subdominant_in_field(const ExactSpectrum& spectrum);

}  // namespace sublimit::report
