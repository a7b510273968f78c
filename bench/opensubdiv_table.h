// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenSubdiv's stencil tables, applied as fast as it can be done. Its evaluators use one thread; ranges of stencils are
// handed to several.
#include "opensubdiv_peer.h"

namespace sublimit::bench {

/// Level k of a mesh over its control points, in float, x y z interleaved.
class PeerTable {
 public:
  /// Create + RefineUniform + StencilTableFactory::Create.
  PeerTable(const PeerMesh& mesh, int levels);
  ~PeerTable();

  std::size_t num_points() const;
  std::size_t num_bytes() const;
  /// Osd::CpuEvaluator::EvalStencils.
  void apply_osd(std::span<const float> points, std::span<float> result) const;
  /// The loop of Far::StencilTable::UpdateValues.
  void apply_far(std::span<const float> points, std::span<float> result) const;
  /// Eigen's row-major sparse matrix by a dense one.
  void apply_eigen(std::span<const float> points, std::span<float> result) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// N x N places on each address face of the limit with both first derivatives, in float.
class PeerLimitTable {
 public:
  /// Create + RefineAdaptive (level 4, sharp patches) + LimitStencilTableFactory::Create.
  PeerLimitTable(const PeerMesh& mesh, int N);
  ~PeerLimitTable();

  std::size_t num_points() const;
  std::size_t num_bytes() const;
  /// Positions, then derivatives along u, then along v. Osd::CpuEvaluator::EvalStencils.
  void apply_osd(std::span<const float> points, std::span<float> result) const;
  /// Far::LimitStencilTable::UpdateValues and UpdateDerivs.
  void apply_far(std::span<const float> points, std::span<float> result) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sublimit::bench
