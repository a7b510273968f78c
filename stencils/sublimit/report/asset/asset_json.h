// SPDX-License-Identifier: Apache-2.0
#pragma once
// An asset's report as the MESH object of report_format.md.
#include <nlohmann/json.hpp>

#include "sublimit/report/asset/asset_report.h"

namespace sublimit {

/// @param file  name to print
nlohmann::ordered_json to_json(const AssetReport& report, const std::string& file);

/// "surface" of a report: coordinates rounded to what pictures need.
/// @param diagonal  of the box that positions are in
nlohmann::ordered_json surface_json(const AssetSurface& surface, double diagonal);

}  // namespace sublimit
