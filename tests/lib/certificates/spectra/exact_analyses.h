// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact analyses for tests, by name.
#include <stdexcept>
#include <string>

#include "sublimit/certificates/spectra/exact_analysis.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

namespace sublimit::testing {

inline ExactAnalysis analyzed(const Scheme<Algebraic>& scheme, LocalType type, int rings) {
  std::optional<ExactAnalysis> analysis = exact_analysis(scheme, type, rings);
  if (!analysis) throw std::runtime_error(scheme.name + ": no local matrix");
  return std::move(*analysis);
}

/// Returns the exact analysis around a vertex of valence n, or a face of n corners if the scheme is dual.
inline ExactAnalysis analyzed(const Scheme<Algebraic>& scheme, int n, int rings) {
  return analyzed(scheme, {.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = n}, rings);
}

inline ExactAnalysis analyzed(const std::string& name, int n, int rings = 2) {
  return analyzed(find_scheme<Algebraic>(name).value(), n, rings);
}

}  // namespace sublimit::testing
