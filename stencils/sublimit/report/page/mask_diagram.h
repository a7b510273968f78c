// SPDX-License-Identifier: Apache-2.0
#pragma once
// Masks as diagrams: discs at the points, as large as their weights, with the weights as fractions in or beside them.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// The mask on the regular grid, over its common denominator where it has one; with caption.
std::string regular_mask_figure(const Json& regular, const std::string& scheme);

/// The support of the basis function on the control mesh; empty without outline.
std::string support_figure(const Json& regular, const std::string& scheme);

/// The position and tangent masks of a neighbourhood: diagrams, and folded away the numbers.
std::string neighborhood_masks(const Json& neighborhood, const std::string& name);

}  // namespace sublimit::page
