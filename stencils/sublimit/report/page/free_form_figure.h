// SPDX-License-Identifier: Apache-2.0
#pragma once
// Free-form shapes: patches with isolines and control nets, seams coloured by how smooth they are, curves with combs of
// their curvature.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// One broad figure of a FREE-FORM report, with legend; empty if it has nothing to draw.
std::string free_form_figure(const Json& report);

}  // namespace sublimit::page
