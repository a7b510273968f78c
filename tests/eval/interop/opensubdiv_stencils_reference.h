// SPDX-License-Identifier: Apache-2.0
#pragma once
// Our stencils applied by OpenSubdiv's evaluators, and OpenSubdiv's stencils as rows of ours.
#include <array>
#include <vector>

#include "sublimit/eval/interop/opensubdiv_stencils.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

/// Returns positions by `Osd::CpuEvaluator::EvalStencils`, and both first derivatives if the stencils have
/// them.
/// @param points  xyz interleaved, one for each control point
std::array<std::vector<float>, 3> osd_points(const OpenSubdivStencils<float>& stencils,
                                             const std::vector<float>& points);

/// Returns points by `Far::StencilTable::UpdateValues` of a table with these arrays.
template <class Real>
std::vector<Real> far_points(const OpenSubdivStencils<Real>& stencils, const std::vector<Real>& points);

/// Catmull-Clark stencils of all vertices of a level by OpenSubdiv's factory, as rows of ours, and the results
/// of `UpdateValues` with them.
struct FarRows {
  StencilTable<double> rows;
  std::vector<double> points;
};
FarRows far_rows(const Mesh& mesh, int level, const std::vector<double>& points);

}  // namespace sublimit::testing
