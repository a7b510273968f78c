// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact analysis of a centre under a scheme: local matrix, spectrum, and whether modes are visible in the
// limit.
#include <array>
#include <optional>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/certificates/numbers/detail/exact_kernel.h"
#include "sublimit/certificates/spectra/exact_spectrum.h"

namespace sublimit {

/// Exact data of a centre.
struct ExactAnalysis {
  Scheme<Algebraic> scheme = {};
  LocalPatch<Algebraic> patch = {};
  ExactSpectrum spectrum = {};
  /// A regular centre, and the weights of its limit position by point; nothing if they could not be computed.
  std::optional<LocalPatch<Algebraic>> regular = {};
  std::vector<Algebraic> regular_position = {};

  /// Cached results of `is_seen`, by rank, block and value of the eigenvalue: several verdicts need them, and
  /// exact eigenvectors are expensive.
  FoundByKey<std::array<double, 4>, std::optional<bool>> seen = {};

  /// Returns the number of sectors.
  int n() const { return spectrum.blocks.sectors; }
};

/// Returns the analysis of a centre.
/// @param rings  rings of the closed set, see `local_patch`. Verdicts need all rings that influence the surface
///               next to the point, 2 or 3
/// @return  nothing if a centre of this type has no child of its own type
/// @throws AnalysisError  no small closed set, no symmetry
std::optional<ExactAnalysis> exact_analysis(const Scheme<Algebraic>& scheme, const LocalType& type, int rings);

/// Returns the mode of an eigenvector of block k of a closed neighbourhood, by position in the patch: x_i w^(k
/// s) in sector s of orbit i.
std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const ExactKernel& kernel, int vector,
                              long bits = 128);
std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const std::vector<ComplexBall>& eigenvector,
                              long bits = 128);

/// Returns whether an eigenvalue is visible: the longest Jordan chains end in an eigenvector whose limit does
/// not vanish near the centre. It is evaluated at a regular vertex next to the centre with the regular limit
/// weights; that the rows around the child of this vertex are regular is checked as far as the patch has them.
/// (Invisible modes exist: the translates of the box spline of mid-edge surfaces are linearly dependent.)
/// @return  nothing if undecided
std::optional<bool> is_seen(const ExactAnalysis& analysis, const ExactEigenvalue& value);

}  // namespace sublimit
