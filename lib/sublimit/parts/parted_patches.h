// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classical patches for searches: each face as a polynomial or rational Bezier net.
#include "sublimit/parts/parted_surface.h"
#include "sublimit/patches/patch_set.h"

namespace sublimit {

/// Patches as a searched surface. Nets are elevated to the same degree in both directions, and quartered until
/// their weights are positive. Faces that are not polynomial or rational (screw, gregory with different twists)
/// have no parts, nor do regions near a pole. Nearest points are found there from a grid of places; if there
/// are such faces, nothing is proved for any face, and rays are refused.
class PartedPatches : public PartedSurface {
 public:
  /// @param patches  must outlive this
  /// @param columns  control columns of the set
  /// @throws InvalidParameter  columns of another size, or not finite
  PartedPatches(const PatchSet& patches, const Points& columns);
  PartedPatches(const PatchSet&&, const Points&) = delete;
  FaceCount faces() const override { return patches_.faces(); }
  const BoundSource& samples() const override { return *samples_; }
  std::vector<LimitCell> cells() const override;
  void find_parts(Index face, PieceParts&, std::vector<PiecePart>& out) const override;
  std::string without_parts() const override { return without_parts_; }
  /// Returns which face has a denominator that vanishes, or very nearly so; empty if none has.
  const std::string& with_pole() const { return with_pole_; }
  /// Returns the largest degree of the parts of a face, in either direction.
  int degree(Index face) const;
  /// Patches are closed if each side is shared with another one or collapsed, and normals are oriented consistently.
  std::string why_not_closed() const override;

 private:
  void cut(Index face, const PiecePart& part, int cells, PieceParts& cutter, std::vector<LimitCell>& out) const;
  void add_sampled(Index face, const CellCorners& corners, int cells, std::vector<LimitCell>& out) const;

  const PatchSet& patches_;
  Points columns_;
  std::unique_ptr<BoundSource> samples_;
  std::vector<std::vector<PiecePart>> parts_;      ///< parts by face
  std::vector<std::vector<CellCorners>> sampled_;  ///< cells without parts, by face
  std::string without_parts_, with_pole_;
};

}  // namespace sublimit
