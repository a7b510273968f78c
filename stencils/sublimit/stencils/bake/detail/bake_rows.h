// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables by rows: any scheme, any request.
#include "sublimit/source/linear_source.h"
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit {

/// A table by rows, its `info` left empty.
Baked bake_by_rows(Patterns& patterns, const Level& control, const BakeRequest& request);

/// Rows of places of any source, which become the table's `rest`, with their statuses; in parallel.
/// @throws ResourceError  more than memory, predicted before it is taken
void add_places(const LinearSource& surface, std::span<const Place> samples, int derivatives, Baked& baked,
                PatternTable<double>::Arrays& arrays);
/// Stores the samples of a request as the places of a table's points, with the faces between them.
void set_samples(const BakeRequest& request, Baked& baked);

/// Points of grids that lie on several addresses, to and from in turn.
std::vector<std::int32_t> grid_copies(const Topology& t, const Addresses& addresses, int N, bool dual);

/// The faces of a level, those of holes left out.
FaceList face_list(const Level& level);

/// Statistics of a table that is made.
void count_table(Baked& baked);

/// A matrix as rows of a table.
StencilTable<double> as_table(const SparseMatrix& S);

}  // namespace sublimit
