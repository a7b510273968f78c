// SPDX-License-Identifier: Apache-2.0
#pragma once
// Continuity reports of schemes (report_format.md): for each scheme its regular part, its neighbourhoods with
// their verdicts, and verdicts on its claims. Everything is computed from the masks, so schemes of other
// programs get the same report as registered ones.
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit::report {

/// A scheme instantiated for doubles and for exact numbers.
struct ReportedScheme {
  Scheme<double> scheme;
  Scheme<Algebraic> exact;
  SchemeOptions options = {};
};

/// A curve scheme of the registry, by name.
struct ReportedCurve {
  std::string name;
  SchemeOptions options = {};
};

/// Returns a registered scheme.
/// @throws InvalidOption  as find_scheme; no scheme of that name
ReportedScheme reported_scheme(const std::string& name, const SchemeOptions& options = {});

struct ReportOptions {
  std::vector<int> valences = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12};  ///< ascending, from least_valence to greatest_valence
  std::vector<ReportedCurve> curves = {};                         ///< after the surfaces
  /// If given, called by one thread at a time with the numbers of jobs done and in all.
  std::function<void(int, int)> progress = {};
};

inline constexpr int least_valence = 3, greatest_valence = 100;

/// Reads a list of valences as on a command line: `3-12`, `5`, `3-8,12`.
/// @throws InvalidOption  not such a list, or a valence outside the range
std::vector<int> parse_valences(const std::string& text);

/// Returns the report of kind "schemes".
/// @throws InvalidParameter  a valence outside the range
/// @note  Deterministic: same build and input, same bytes, for any number of threads.
nlohmann::ordered_json schemes_report(const std::vector<ReportedScheme>& schemes, const ReportOptions& options = {});

/// Replaces a claim of a scheme, to get a verdict on another one: `extraordinary=2`, `convex-hull=yes`.
/// @throws InvalidOption  no such claim or value
void set_claim(Claims& claims, const std::string& text);

/// Returns the number of claims of schemes that the report contradicts.
int contradicted_claims(const nlohmann::ordered_json& report);

}  // namespace sublimit::report
