// SPDX-License-Identifier: Apache-2.0
#pragma once
// The report on free-form shapes as the FREE-FORM object of report_format.md.
#include <nlohmann/json.hpp>

#include "sublimit/report/free_form/free_form_report.h"

namespace sublimit {

/// Returns a report as JSON.
/// @param file  name of the file in the report
nlohmann::ordered_json to_json(const FreeFormReport& report, const std::string& file);

}  // namespace sublimit
