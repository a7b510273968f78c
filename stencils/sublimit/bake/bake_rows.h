// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables by rows: any scheme, any request.
#include "sublimit/bake/bake.h"

namespace sublimit {

/// A table by rows, its `info` left empty.
Baked bake_by_rows(Patterns& patterns, const Level& control, const BakeRequest& request);

/// Points of grids that lie on several addresses, to and from in turn.
std::vector<std::int32_t> grid_copies(const Topology& t, const Addresses& addresses, int N, bool dual);

/// A matrix as rows of a table.
StencilTable<double> as_table(const SparseMatrix& S);

}  // namespace sublimit
