// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arguments of `sample`, for surfaces (sample.cpp) and curves (sample_curves.cpp).
#include <cstdint>
#include <optional>
#include <string>

#include "support/source.h"

namespace sublimit::cli {

struct SampleJob {
  Common common;
  // Exactly one of these three gives the places.
  std::string at;                    ///< a CSV; empty: not given
  std::optional<std::int64_t> grid;  ///< samples on each side of a face, >= 2
  std::optional<std::int64_t> random_count;
  std::uint64_t seed = 0;
  int derivatives = 0;  ///< 0, 1 or 2
  bool clamp = false, curvature = false;
  bool curves = false;  ///< sample the curves of recipes instead of their surfaces
  std::string output;
};

/// Samples limits of a scheme for curves.
int sample_curves(const SampleJob& job);
/// Samples the curves of a free-form file or of recipes.
int sample_patch_curves(const SampleJob& job, const Source& source);

}  // namespace sublimit::cli
