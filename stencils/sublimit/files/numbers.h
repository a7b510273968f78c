// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers and verdicts in report.json. What is drawn is rounded; what is stated is not.
#include <nlohmann/json.hpp>

#include "sublimit/limit/verdict.h"
#include "sublimit/neighborhood/sector_labels.h"

namespace sublimit::report {

using Json = nlohmann::ordered_json;

/// Rounded to a few significant digits, which is enough to draw with; null if it is not finite.
Json drawn(double value, int digits = 5);
/// The number itself; null if it is not finite.
Json stated(double value);
Json point(double x, double y);
Json point(double x, double y, double z);
Json to_json(const SectorLabel& label);
Json to_json(const Verdict& verdict);

/// What every report begins with.
Json report_head(const std::string& kind);

/// A report as the text of its file: a line for each thing that people look for, not one for each number.
std::string report_text(const Json& report);

}  // namespace sublimit::report
