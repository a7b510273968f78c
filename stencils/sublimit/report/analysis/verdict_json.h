// SPDX-License-Identifier: Apache-2.0
#pragma once
// Verdicts in report.json.
#include "sublimit/certificates/spectra/verdict.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::report {

/// Returns a verdict with its hypotheses, findings and witness.
Json to_json(const Verdict& verdict);

}  // namespace sublimit::report
