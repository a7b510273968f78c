// SPDX-License-Identifier: Apache-2.0
#pragma once
// `spectrum` and what follows from it: lambda, mu, their ratio, and the blocks that have mu.
#include "sublimit/certificates/spectra/exact_spectrum.h"
#include "sublimit/stencils/files/numbers.h"

namespace sublimit::report {

/// Adds `spectrum`, `lambda`, `mu`, `ratio` and `mu_blocks` to a neighbourhood.
void add_spectrum(Json& neighborhood, const ExactSpectrum& spectrum);

/// The subdominant eigenvalue, if it comes from block 1 alone, is real, and lies in the field of the masks.
std::optional<Algebraic> subdominant_in_field(const ExactSpectrum& spectrum);

}  // namespace sublimit::report
