// SPDX-License-Identifier: Apache-2.0
#pragma once
// Masks as diagrams: a disc at each point, with a size by its weight, and the weight as a fraction in or beside
// it.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Returns the figure of a mask on the regular grid, with weights over a common denominator if there is one.
std::string regular_mask_figure(const Json& regular, const std::string& scheme);

/// Returns the figure of the basis function's support on the control mesh; empty if the report has no outline
/// of it.
std::string support_figure(const Json& regular, const std::string& scheme);

/// Returns the position and tangent masks of a neighbourhood as diagrams, with the numbers in a closed section.
std::string neighborhood_masks(const Json& neighborhood, const std::string& name);

}  // namespace sublimit::page
