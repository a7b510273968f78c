// SPDX-License-Identifier: Apache-2.0
#pragma once
// The mesh of a table's points, without positions, for writing to a file.
#include "sublimit/eval/baked_table.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit {

/// Gives a mesh whose faces are `faces_of(table)` the table's first face-varying channel, if there is one (files have
/// room for one), and the tags that are left, with the rules that they go with.
template <class Real>
void add_channels(Mesh& mesh, const BakedTable<Real>& table);

}  // namespace sublimit
