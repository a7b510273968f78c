// SPDX-License-Identifier: Apache-2.0
#pragma once
// The report on a mesh as the MESH object of report_format.md.
#include <nlohmann/json.hpp>

#include "sublimit/report/asset/asset_report.h"

namespace sublimit {

/// Returns a report as JSON.
/// @param file  name of the mesh in the report
nlohmann::ordered_json to_json(const AssetReport& report, const std::string& file);

/// Returns "surface" of a report, with coordinates rounded to the precision that pictures need.
/// @param diagonal  diagonal of the bounding box of the positions
nlohmann::ordered_json surface_json(const AssetSurface& surface, double diagonal);

}  // namespace sublimit
