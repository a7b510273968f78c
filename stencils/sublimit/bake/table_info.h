// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a table says of itself: everything that decides its points, so that two tables of the same words are of the same
// job.
#include "sublimit/bake/bake.h"

namespace sublimit {

/// All of `TableInfo`.
///
/// `options` has every option of the scheme, with its default where none is given, and
///
///     boundary  none, edge-only, edge-and-corner      the rules in effect, of the mesh where `rules` says nothing
///     creasing  uniform, chaikin
///     face-varying, face-varying-values   of tables with channels: their interpolation, 64 bits of what was given
///     tags-left   written                 of tables with the tags that are left
///     tags      none, or 64 bits of the creases, corners and holes, as 16 hexadecimal digits
///
/// @param mesh  as it is refined: cut into triangles, if that was asked for
TableInfo table_info(const Scheme<double>& scheme, const ControlMesh& mesh, const BakeRequest& request,
                     const SubdivisionOptions& rules = {});

/// Of patches: `scheme` is `free_form_scheme`, there are no rules, and `topology_hash` is that of the patches.
TableInfo table_info(const PatchSet& patches, const BakeRequest& request);
inline constexpr const char* free_form_scheme = "free-form";

/// Of the cage, as `topology_hash` of its arrays.
std::uint64_t topology_hash(const ControlMesh& mesh);

/// Whether a table is that of a request: it says the same of itself, and has as many derivatives and the same places,
/// with the same faces between them.
template <class Real>
bool is_table_of(const BakedTable<Real>& table, const TableInfo& info, const BakeRequest& request);

}  // namespace sublimit
