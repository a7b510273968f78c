// SPDX-License-Identifier: Apache-2.0
#pragma once
// The mesh of a table's points, without positions, for writing to a file.
#include <functional>
#include <optional>
#include <span>

#include "sublimit/eval/table/baked_table.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit {

/// Adds to a mesh whose faces are `faces_of(table)` the table's first face-varying channel (files hold only
/// one), and its remaining tags with their rules, if it has any.
template <class Real>
void add_channels(Mesh& mesh, const BakedTable<Real>& table);

/// Returns the face of the control mesh for each of `faces_of(table)`; nothing if the table does not know (tables by
/// rows).
/// @param control  the mesh that the table was baked from, of triangles if it was cut into these
template <class Real>
std::vector<Index> control_faces(const BakedTable<Real>& table, const Mesh& control);

/// Returns a cage as a table was baked from it: itself, with consistent winding, cut into triangles, or both; nothing
/// if its faces are none of these.
std::optional<Mesh> baked_cage(const Mesh& cage, const TableInfo& info);

/// Applies a table to points of any number of channels: all quantities, quantity after quantity.
template <class Real>
using ApplyTable = std::function<void(std::span<const Real> points, int channels, std::span<Real> values)>;

/// Gives a mesh of the table's points what their cage carries: faces names and values of the faces that they come from,
/// points the table's sums of values at vertices.
/// @param cage  the mesh that the table was baked from, before it was cut into triangles
template <class Real>
void carry_attributes(const BakedTable<Real>& table, const Mesh& cage, const ApplyTable<Real>& apply, Mesh& out);

}  // namespace sublimit
