// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables as OpenSubdiv keeps stencils, and back, so that Osd's evaluators run schemes that OpenSubdiv does not have.
// Optional: nothing else includes this, and no header of OpenSubdiv is needed.
//
//   const auto stencils = opensubdiv_stencils(table);                                   // of a PatternTable<float>
//   Osd::CpuEvaluator::EvalStencils(source, sourceDesc, target, targetDesc, &stencils);
//   const FarStencilTable<Far::StencilTable> far(stencils);                             // where a Far table is asked
//   for
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/pattern_table.h"

namespace sublimit {

/// Stencils in the arrays of OpenSubdiv 3.5, under its names: what its evaluators ask of a table.
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

  int num_control_points = 0;
  std::vector<int> sizes, offsets;           ///< a stencil each
  std::vector<int> indices;                  ///< control points, stencil by stencil
  std::array<std::vector<Real>, 6> weights;  ///< as many as indices, or none: position, u, v, uu, uv, vv
};

/// @param rows        rows.num_rows() / quantities stencils; all positions first, then all derivatives along u, ...
/// @param quantities  1, 3 or 6. A stencil has the control points of all of them, in ascending order if the rows'
///                    are; weights that a quantity has not are 0
/// @throws ResourceError  more entries than 32-bit numbers
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

template <class Real>
OpenSubdivStencils<Real> opensubdiv_stencils(const PatternTable<Real>& table) {
  return opensubdiv_stencils(table.expanded(), table.quantities());
}

/// The same as a table of Far, by its own arrays: Base is Far::StencilTable or Far::StencilTableReal<double>. For
/// positions only.
template <class Base>
class FarStencilTable : public Base {
 public:
  template <class Real>
  explicit FarStencilTable(OpenSubdivStencils<Real> stencils) {
    this->_numControlVertices = stencils.num_control_points;
    this->_sizes = std::move(stencils.sizes);
    this->_offsets = std::move(stencils.offsets);
    this->_indices = std::move(stencils.indices);
    this->_weights = std::move(stencils.weights[0]);
  }
};

/// Rows from stencils of OpenSubdiv: a row each. Offsets may be empty, as factories leave them; arrays may be longer
/// than the stencils are, as `GetWeights()` of Far's tables is.
/// @param num_control_points  -1: what the table says, which for tables of limits can be fewer than its indices name
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
