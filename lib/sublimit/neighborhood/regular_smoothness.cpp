// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/regular_smoothness.h"

#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/neighborhood/local_patch.h"

namespace sublimit {
namespace {

/// Moduli that differ by less, relatively, are the same: a Jordan block of two is known to the root of rounding.
constexpr double same_modulus = 1e-5;

/// Eigenvalues of the neighbourhood of a regular vertex, or, where vertices become faces, of a regular face.
Eigen::VectorXcd regular_spectrum(const Scheme<double>& scheme) {
  LocalType type;
  type.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex;
  type.faces = scheme.regular_valence();
  // All points that the faces around depend on: what decays slowly need not reach the centre.
  const std::optional<LocalPatch<double>> patch = local_patch(scheme, type, scheme.is_dual() ? 1 : 2);
  return patch ? eigenvalues(patch->A) : Eigen::VectorXcd();
}

}  // namespace

int regular_smoothness(const Scheme<double>& scheme) {
  Eigen::VectorXcd spectrum;
  try {
    spectrum = regular_spectrum(scheme);
  } catch (const AnalysisError&) {
    return 0;
  }
  const double dilation = scheme.dilation();
  // Of degree k and below, as many as there are polynomials, and all of them of the moduli that those have.
  int smoothness = -1;
  Eigen::Index polynomials = 0;
  for (int k = 0; k <= 2; ++k) {
    polynomials += k + 1;
    const double slowest = std::pow(dilation, -k) * (1 - same_modulus);
    if ((spectrum.array().abs() >= slowest).count() != polynomials) break;
    const double decay = std::pow(dilation, -k) * (1 + same_modulus);
    if ((spectrum.array().abs() <= decay).count() != spectrum.size() - (polynomials - k - 1)) break;
    smoothness = k;
  }
  return std::max(smoothness, 0);
}

}  // namespace sublimit
