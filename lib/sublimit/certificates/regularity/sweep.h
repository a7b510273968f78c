// SPDX-License-Identifier: Apache-2.0
#pragma once
// Smoothness as a function of a parameter of a scheme: continuity and bounds of the exponent for each value.
#include <string>
#include <vector>

#include "sublimit/certificates/regularity/smoothness.h"
#include "sublimit/core/scheme_options.h"

namespace sublimit {

/// Values of an option, written as `tension=0:4:0.05` (from, to, step).
struct SweepRange {
  std::string option;
  std::vector<Rational> values;  ///< exact values; both ends included if steps reach them
};

/// Returns the range of a text.
/// @throws InvalidOption  malformed text, a step that is not positive or leads away from the end, more than
///                        2001 values
SweepRange sweep_range(const std::string& text);

/// Result for one value.
struct SweepPoint {
  Rational value;
  bool in_range = true;  ///< true if the scheme accepts the value; else `smoothness` has no meaning
  std::string why = {};  ///< the scheme's message if it does not
  Smoothness smoothness = {};
};

/// Results for all values.
struct [[nodiscard]] Sweep {
  std::string scheme;
  SweepRange range;
  std::vector<SweepPoint> points = {};
  std::vector<std::string> findings = {};  ///< values at which continuity changes, in words
};

/// Returns the smoothness of a curve scheme, or of a surface scheme on regular meshes, for all values. The
/// four-point scheme, Kobbelt's scheme and the butterfly scheme are also analysed outside the range of their
/// option, where their masks are still meaningful.
/// @throws InvalidOption  no such scheme or option, a Hermite scheme, an option that is no number
Sweep sweep(const std::string& scheme, const SweepRange& range, const SchemeOptions& others = {});

}  // namespace sublimit
