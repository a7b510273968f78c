// SPDX-License-Identifier: Apache-2.0
#pragma once
// A report on free-form shapes as the FREE-FORM object of report_format.md.
#include <nlohmann/json.hpp>

#include "sublimit/report/free_form/free_form_report.h"

namespace sublimit {

/// @param file  name to print
nlohmann::ordered_json to_json(const FreeFormReport& report, const std::string& file);

}  // namespace sublimit
