// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenSubdiv's stencil tables, applied in the fastest way. Its evaluators use one thread; here several threads
// apply ranges of stencils.
#include "opensubdiv_peer.h"

namespace sublimit::bench {

/// The table of level k of a mesh over its control points, in float, x y z interleaved.
class PeerTable {
 public:
  /// Makes the table by Create, RefineUniform and StencilTableFactory::Create.
  PeerTable(const PeerMesh& mesh, int levels);
  ~PeerTable();

  std::size_t num_points() const;
  std::size_t num_bytes() const;
  /// Applies the table by Osd::CpuEvaluator::EvalStencils.
  void apply_osd(std::span<const float> points, std::span<float> result) const;
  /// Applies the table by the loop of Far::StencilTable::UpdateValues.
  void apply_far(std::span<const float> points, std::span<float> result) const;
  /// Applies the table as a row-major sparse matrix of Eigen, times a dense one.
  void apply_eigen(std::span<const float> points, std::span<float> result) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The table of N x N places on each address of the limit with both first derivatives, in float.
class PeerLimitTable {
 public:
  /// Makes the table by Create, RefineAdaptive (level 4, sharp patches) and LimitStencilTableFactory::Create.
  PeerLimitTable(const PeerMesh& mesh, int N);
  ~PeerLimitTable();

  std::size_t num_points() const;
  std::size_t num_bytes() const;
  /// Sets positions, then derivatives along u, then along v, by Osd::CpuEvaluator::EvalStencils.
  void apply_osd(std::span<const float> points, std::span<float> result) const;
  /// Sets them by Far::LimitStencilTable::UpdateValues and UpdateDerivs.
  void apply_far(std::span<const float> points, std::span<float> result) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sublimit::bench
