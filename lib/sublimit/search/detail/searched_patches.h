// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classical patches as searches see them: each face a Bezier net, polynomial or rational.
#include "sublimit/patches/patch_set.h"
#include "sublimit/search/detail/searched_surface.h"

namespace sublimit {

/// Nets are raised to one degree in both directions, and cut in quarters until their weights are positive. Faces that
/// are no polynomials (screw, gregory with twists that differ) have no parts, nor has what is near to a pole: nearest
/// points are found there from a grid of places, nothing is proved of any face, and rays are refused.
class SearchedPatches : public SearchedSurface {
 public:
  /// @param patches  which must stay
  /// @param columns  of the set
  /// @throws InvalidParameter  columns of another size, or not finite
  SearchedPatches(const PatchSet& patches, const Points& columns);
  SearchedPatches(const PatchSet&&, const Points&) = delete;
  FaceCount faces() const override { return patches_.faces(); }
  const BoundSource& samples() const override { return *samples_; }
  std::vector<LimitCell> cells() const override;
  void find_parts(Index face, PieceParts&, std::vector<PiecePart>& out) const override;
  std::string without_parts() const override { return without_parts_; }
  /// Closed are B-splines each of whose sides is another one's, or is a point; all their normals look to one side.
  std::string why_not_closed() const override;

 private:
  void cut(Index face, const PiecePart& part, int cells, PieceParts& cutter, std::vector<LimitCell>& out) const;
  void add_sampled(Index face, const CellCorners& corners, int cells, std::vector<LimitCell>& out) const;

  const PatchSet& patches_;
  Points columns_;
  std::unique_ptr<BoundSource> samples_;
  std::vector<std::vector<PiecePart>> parts_;      ///< by faces
  std::vector<std::vector<CellCorners>> sampled_;  ///< of faces, what is no part
  std::string without_parts_;
};

}  // namespace sublimit
