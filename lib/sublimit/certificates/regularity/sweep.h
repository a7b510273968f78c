// SPDX-License-Identifier: Apache-2.0
#pragma once
// Smoothness over a parameter of a scheme: continuity and bounds of the exponent for each value.
#include <string>
#include <vector>

#include "sublimit/certificates/regularity/smoothness.h"
#include "sublimit/core/scheme_options.h"

namespace sublimit {

/// `tension=0:4:0.05`.
struct SweepRange {
  std::string option;
  std::vector<Rational> values;  ///< exact, both ends included where steps reach them
};

/// @throws InvalidOption  malformed, a step that is not positive or leads away, more than 2001 values
SweepRange sweep_range(const std::string& text);

struct SweepPoint {
  Rational value;
  bool in_range = true;  ///< the scheme takes this value; else `smoothness` has no meaning
  std::string why = {};  ///< the scheme's message where it does not
  Smoothness smoothness = {};
};

struct [[nodiscard]] Sweep {
  std::string scheme;
  SweepRange range;
  std::vector<SweepPoint> points = {};
  std::vector<std::string> findings = {};  ///< where continuity changes, in words
};

/// Curve schemes and surface schemes on regular meshes. The four-point scheme, Kobbelt's and the butterfly are analysed
/// beyond the range of their option too: their masks mean something there.
/// @throws InvalidOption  no such scheme or option, a Hermite scheme, an option that is no number
Sweep sweep(const std::string& scheme, const SweepRange& range, const SchemeOptions& others = {});

}  // namespace sublimit
