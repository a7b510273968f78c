// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables converted to stencil tables of OpenSubdiv 3.5 and back, so that its evaluators run schemes that OpenSubdiv
// does not have. Optional: no other header includes this, and no header of OpenSubdiv is needed.
//
//   const auto stencils = opensubdiv_stencils(table);  // table: PatternTable<float>
//   Osd::CpuEvaluator::EvalStencils(source, sourceDesc, target, targetDesc, &stencils);
//   const FarStencilTable<Far::StencilTable> far(stencils);  // where a Far::StencilTable is needed
//   const StencilTable<float> rows = rows_of_opensubdiv<float>(far);
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit {

/// Stencils in the arrays of OpenSubdiv 3.5, with the functions that its evaluators call. Threads may share it as long
/// as none changes it.
template <class Real>
class OpenSubdivStencils {
 public:
  int GetNumStencils() const { return static_cast<int>(sizes.size()); }
  int GetNumControlVertices() const { return num_control_points; }
  const std::vector<int>& GetSizes() const { return sizes; }
  const std::vector<int>& GetOffsets() const { return offsets; }
  const std::vector<int>& GetControlIndices() const { return indices; }
  const std::vector<Real>& GetWeights() const { return weights[0]; }
  const std::vector<Real>& GetDuWeights() const { return weights[1]; }
  const std::vector<Real>& GetDvWeights() const { return weights[2]; }
  const std::vector<Real>& GetDuuWeights() const { return weights[3]; }
  const std::vector<Real>& GetDuvWeights() const { return weights[4]; }
  const std::vector<Real>& GetDvvWeights() const { return weights[5]; }

  int num_control_points = 0;                ///< points that stencils are applied to
  std::vector<int> sizes, offsets;           ///< number of entries and first entry of each stencil
  std::vector<int> indices;                  ///< control point of each entry
  std::array<std::vector<Real>, 6> weights;  ///< weights of each entry for position, u, v, uu, uv, vv; empty if absent
};

/// Returns the stencils of a table by rows.
/// @param rows        positions of all stencils, then their derivatives along u, ...: quantities x #stencils rows
/// @param quantities  1, 3 or 6. A stencil has the control points of all quantities, ascending if those of the rows
///                    ascend; a quantity that lacks one of them has weight 0 there
/// @throws ResourceError  more entries than 32-bit numbers count
template <class Real>
OpenSubdivStencils<Real> opensubdiv_stencils(const StencilTable<Real>& rows, int quantities = 1) {
  const std::int64_t count = rows.num_rows() / quantities;
  OpenSubdivStencils<Real> out;
  out.num_control_points = rows.num_control_points();
  std::vector<int> place(size_t(out.num_control_points), -1);  // of a control point in the stencil
  for (std::int64_t i = 0; i < count; ++i) {
    const size_t begin = out.indices.size();
    for (int q = 0; q < quantities; ++q) {
      const std::int64_t row = q * count + i;
      for (std::int64_t at = rows.offsets()[row]; at < rows.offsets()[row + 1]; ++at) {
        int& found = place[size_t(rows.columns()[at])];
        if (found < 0) {
          found = static_cast<int>(out.indices.size() - begin);
          out.indices.push_back(rows.columns()[at]);
        }
        out.weights[size_t(q)].resize(out.indices.size());
        out.weights[size_t(q)][begin + size_t(found)] += rows.weights()[at];
      }
    }
    for (int q = 0; q < quantities; ++q) out.weights[size_t(q)].resize(out.indices.size());
    if (out.indices.size() > size_t(std::numeric_limits<int>::max()))
      throw ResourceError("stencils of more than " + std::to_string(std::numeric_limits<int>::max()) +
                          " entries: OpenSubdiv counts them by 32 bits; a lower level has fewer");
    out.offsets.push_back(static_cast<int>(begin));
    out.sizes.push_back(static_cast<int>(out.indices.size() - begin));
    for (size_t k = begin; k < out.indices.size(); ++k) place[size_t(out.indices[k])] = -1;
  }
  return out;
}

/// Returns the stencils of a table by patterns.
/// @throws ResourceError  more entries than 32-bit numbers count
template <class Real>
OpenSubdivStencils<Real> opensubdiv_stencils(const PatternTable<Real>& table) {
  return opensubdiv_stencils(table.expanded(), table.quantities());
}

/// A stencil table of OpenSubdiv's Far layer, for positions only. Threads may share it as they may its base.
/// @tparam Base  Far::StencilTable or Far::StencilTableReal<double>
template <class Base>
class FarStencilTable : public Base {
 public:
  /// Moves the arrays of stencils into the table.
  template <class Real>
  explicit FarStencilTable(OpenSubdivStencils<Real> stencils) {
    this->_numControlVertices = stencils.num_control_points;
    this->_sizes = std::move(stencils.sizes);
    this->_offsets = std::move(stencils.offsets);
    this->_indices = std::move(stencils.indices);
    this->_weights = std::move(stencils.weights[0]);
  }
};

/// Returns the position weights of an OpenSubdiv stencil table, one row for each stencil. Offsets may be empty, as
/// OpenSubdiv's factories leave them; indices and weights may be longer than needed, as those of Far tables are.
/// @param num_control_points  points that the rows are applied to; -1: `GetNumControlVertices()`, which is too small in
///                            some limit tables of OpenSubdiv
/// @throws InvalidParameter  sizes beyond the arrays, indices out of range, a weight that is not finite
template <class Real, class Stencils>
StencilTable<Real> rows_of_opensubdiv(const Stencils& stencils, std::int32_t num_control_points = -1) {
  const auto& sizes = stencils.GetSizes();
  const auto& starts = stencils.GetOffsets();
  const auto& indices = stencils.GetControlIndices();
  const auto& weights = stencils.GetWeights();
  const size_t most = std::min(indices.size(), weights.size());
  if (!starts.empty() && starts.size() < sizes.size())
    throw InvalidParameter("stencils: " + std::to_string(starts.size()) + " offsets for " +
                           std::to_string(sizes.size()) + " sizes");
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  std::vector<Real> kept;
  size_t next = 0;
  for (size_t i = 0; i < sizes.size(); ++i) {
    const size_t begin = starts.empty() ? next : size_t(starts[i]), size = size_t(sizes[i]);
    if (sizes[i] < 0 || begin > most || size > most - begin)
      throw InvalidParameter("stencils: number " + std::to_string(i) + " has " + std::to_string(sizes[i]) +
                             " entries from " + std::to_string(begin) + " on; there are " + std::to_string(most));
    for (size_t at = begin; at < begin + size; ++at) {
      columns.push_back(static_cast<std::int32_t>(indices[at]));
      kept.push_back(static_cast<Real>(weights[at]));
    }
    next = begin + size;
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
  }
  return StencilTable<Real>(num_control_points < 0 ? stencils.GetNumControlVertices() : num_control_points,
                            std::move(offsets), std::move(columns), std::move(kept));
}

}  // namespace sublimit
