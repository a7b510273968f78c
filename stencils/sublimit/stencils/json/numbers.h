// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers in report.json. Numbers for drawings are rounded, results are not.
#include <nlohmann/json.hpp>

#include "sublimit/neighborhood/sector_labels.h"

namespace sublimit::report {

using Json = nlohmann::ordered_json;

/// Returns a number rounded to a few significant digits, which suffice for drawings; null if it is not finite.
Json drawn(double value, int digits = 5);
/// Returns a number; null if it is not finite.
Json stated(double value);
Json point(double x, double y);
Json point(double x, double y, double z);
Json to_json(const SectorLabel& label);

/// Returns the first entries of every report.
Json report_head(const std::string& kind);

/// Returns the text of a report's file, with lines for the entries that people search for, not for each number.
std::string report_text(const Json& report);

}  // namespace sublimit::report
