// SPDX-License-Identifier: Apache-2.0
#pragma once
// The linear system of interpolation by the limit surface, with a row for each control vertex.
#include <string>

#include "sublimit/core/types.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

/// Returns L of level 0: x_inf = L x.
SparseMatrix limit_system(const std::string& scheme, const Mesh& mesh);

}  // namespace sublimit::testing
