// SPDX-License-Identifier: Apache-2.0
#pragma once
// What OpenSubdiv's evaluators make of our stencils, and its own stencils as our rows.
#include <array>
#include <vector>

#include "sublimit/eval/opensubdiv_stencils.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

/// By `Osd::CpuEvaluator::EvalStencils`: positions, or with both first derivatives if the stencils have them.
/// @param points  xyz interleaved, one for each control point
std::array<std::vector<float>, 3> osd_points(const OpenSubdivStencils<float>& stencils,
                                             const std::vector<float>& points);

/// By `Far::StencilTable::UpdateValues` of a table that has these arrays.
template <class Real>
std::vector<Real> far_points(const OpenSubdivStencils<Real>& stencils, const std::vector<Real>& points);

/// Catmull-Clark's stencils of all vertices of a level, by OpenSubdiv's factory, as rows of ours, and what
/// `UpdateValues` makes of them.
struct FarRows {
  StencilTable<double> rows;
  std::vector<double> points;
};
FarRows far_rows(const Mesh& mesh, int level, const std::vector<double>& points);

}  // namespace sublimit::testing
