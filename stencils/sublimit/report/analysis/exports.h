// SPDX-License-Identifier: Apache-2.0
#pragma once
// Export of local matrices and characteristic maps to files.
#include <filesystem>
#include <vector>

#include "sublimit/report/analysis/scheme_report.h"

namespace sublimit::report {

/// Writes SCHEME-KIND-N.matrix.txt (a line for each label, then a line "row column weight" for each entry, exact
/// numbers as text) and SCHEME-KIND-N.map.obj (the control net of the characteristic map in the plane z = 0) for every
/// neighbourhood.
/// @param directory  must exist
/// @throws IoError, ResourceError  it cannot be written
void write_exports(const std::filesystem::path& directory, const std::vector<ReportedScheme>& schemes,
                   const std::vector<int>& valences);

}  // namespace sublimit::report
