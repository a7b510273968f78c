// SPDX-License-Identifier: Apache-2.0
#pragma once
// The description of a table: everything that determines its points, so that tables with equal descriptions are equal.
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit {

/// Returns the description of a table of a mesh.
///
/// `options` has every option of the scheme, with its default where none is given, and
///
///     boundary  none, edge-only, edge-and-corner      the rules in effect: those of `rules`, else of the mesh
///     creasing  uniform, chaikin
///     face-varying, face-varying-values   tables with channels: their interpolation, a hash of the given values
///     tags-left   written                 tables with remaining tags
///     tags      none, or a hash of the creases, corners and holes, as 16 hexadecimal digits
///
/// @param mesh  the mesh that is refined, after cutting into triangles if that was asked for
TableInfo table_info(const Scheme<double>& scheme, const Mesh& mesh, const BakeRequest& request,
                     const SubdivisionOptions& rules = {});

/// Returns the description of a table of patches: `scheme` is `free_form_scheme`, there are no rules, and
/// `topology_hash` is that of the patches.
TableInfo table_info(const PatchSet& patches, const BakeRequest& request);
inline constexpr const char* free_form_scheme = "free-form";

/// Returns the `topology_hash` of a mesh.
std::uint64_t topology_hash(const Mesh& mesh);

/// Returns true if a table is the result of a request: it has the same description, number of derivatives and places,
/// with the same faces between them.
template <class Real>
bool is_table_of(const BakedTable<Real>& table, const TableInfo& info, const BakeRequest& request);

}  // namespace sublimit
