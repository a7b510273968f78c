// SPDX-License-Identifier: Apache-2.0
#pragma once
// Laws that every curve scheme obeys, as functions: the tests run them over the registry, and over mutants, which must
// break one.
#include <string>
#include <vector>

#include "sublimit/curves/curve_scheme.h"

namespace sublimit::testing {

struct CurveLaw {
  std::string name;
  /// Returns a description of a violation; empty if the scheme obeys the law.
  std::string (*violation)(const CurveScheme<double>& scheme);
};

const std::vector<CurveLaw>& curve_laws();

/// Returns names and options: every curve scheme with its default options, and with others that change its
/// masks or ends.
std::vector<std::pair<std::string, SchemeOptions>> curve_scheme_names_and_options();

/// Returns the schemes with these names and options.
std::vector<CurveScheme<double>> curve_scheme_variants();

}  // namespace sublimit::testing
