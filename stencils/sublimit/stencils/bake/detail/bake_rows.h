// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables by rows, which are possible for any scheme and request.
#include "sublimit/source/linear_source.h"
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit {

/// Bakes a table by rows, without `info`.
Baked bake_by_rows(Patterns& patterns, const Level& control, const BakeRequest& request);

/// Adds the rows of places of any source to a table, as its `rest`, with their statuses. Runs in parallel.
/// @throws ResourceError  not enough memory, predicted before it is taken
void add_places(const LinearSource& surface, std::span<const Place> samples, int derivatives, Baked& baked,
                PatternTable<double>::Arrays& arrays);
/// Stores the samples of a request as the places of a table's points, with the faces between them.
void set_samples(const BakeRequest& request, Baked& baked);

/// Returns the points of grids that lie on several addresses, as pairs: the copy, then the point that it is
/// copied from.
std::vector<std::int32_t> grid_copies(const Topology& t, const Addresses& addresses, int N, bool dual);

/// Returns the faces of a level without those of holes.
FaceList face_list(const Level& level);

/// Sets the statistics that follow from a finished table: blocks, groups, points, weights, bytes.
void count_table(Baked& baked);

/// Returns a matrix as rows of a table.
StencilTable<double> as_table(const SparseMatrix& S);

}  // namespace sublimit
