// SPDX-License-Identifier: Apache-2.0
#pragma once
// An asset's report as the MESH object of report_format.md.
#include <nlohmann/json.hpp>

#include "sublimit/report/asset/asset_report.h"

namespace sublimit {

/// @param file  name to print
nlohmann::ordered_json to_json(const AssetReport& report, const std::string& file);

}  // namespace sublimit
