// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a table knows of the mesh of its points besides these, on its way to a file.
#include "sublimit/baked_table.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit {

/// Gives a mesh whose faces are `faces_of(table)` the table's first face-varying channel, if there is one (files have
/// room for one), and the tags that are left, with the rules that they go with.
template <class Real>
void add_channels(MeshOutput& mesh, const BakedTable<Real>& table);

}  // namespace sublimit
