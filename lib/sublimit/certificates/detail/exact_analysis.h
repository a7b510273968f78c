// SPDX-License-Identifier: Apache-2.0
#pragma once
// A centre of one kind under one scheme with all that is exactly known of it: local matrix, spectrum, and whether its
// modes can be seen in the limit.
#include <array>
#include <optional>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/certificates/detail/exact_kernel.h"
#include "sublimit/certificates/detail/exact_spectrum.h"
#include "sublimit/neighborhood/local_type.h"

namespace sublimit {

struct ExactAnalysis {
  Scheme<Algebraic> scheme = {};
  LocalPatch<Algebraic> patch = {};
  ExactSpectrum spectrum = {};
  /// A regular centre and the weights of its limit position, by point; nothing where they could not be had.
  std::optional<LocalPatch<Algebraic>> regular = {};
  std::vector<Algebraic> regular_position = {};

  /// Cached results of `is_seen`, by rank, block and place of the eigenvalue: several verdicts need them, and exact
  /// eigenvectors are expensive.
  FoundByKey<std::array<double, 4>, std::optional<bool>> seen = {};

  int n() const { return spectrum.blocks.sectors; }
};

/// @param rings  as `local_patch` has them. For verdicts: all that influence the surface next to the point, 2 or 3
/// @return  nothing where a centre of this type does not have a child of its own type
/// @throws AnalysisError  no small closed set, no symmetry
std::optional<ExactAnalysis> exact_analysis(const Scheme<Algebraic>& scheme, const LocalType& type, int rings);

/// The mode of an eigenvector of a closed neighbourhood, by position in the patch: x_i w^(k s) on sector s of orbit i.
std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const ExactKernel& kernel, int vector,
                              long bits = 128);
std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const std::vector<ComplexBall>& eigenvector,
                              long bits = 128);

/// The longest chains of this eigenvalue end in an eigenvector whose limit is not zero everywhere near the centre: it
/// is not zero at the centre of a regular place next to it, whose limit is that of regular meshes: the rows of all
/// points around its child are those of regular meshes, which is looked at where the patch has them. (There are modes
/// that no surface shows: translates of the box spline of mid-edge surfaces are linearly dependent.) Nothing: not
/// decided.
std::optional<bool> is_seen(const ExactAnalysis& analysis, const ExactEigenvalue& value);

}  // namespace sublimit
