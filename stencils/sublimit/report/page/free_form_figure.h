// SPDX-License-Identifier: Apache-2.0
#pragma once
// The figure of free-form shapes: patches with isolines and control nets, seams coloured by their smoothness,
// curves with curvature combs.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Returns a broad figure of a FREE-FORM report with a legend; empty if there is nothing to draw.
std::string free_form_figure(const Json& report);

}  // namespace sublimit::page
