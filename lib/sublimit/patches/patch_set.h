// SPDX-License-Identifier: Apache-2.0
#pragma once
// Several patches as one linear source: their faces one patch after the other, over control points that they may share.
#include <memory>
#include <vector>

#include "sublimit/limit/linear_source.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

class PatchSet : public LinearSource {
 public:
  struct Member {
    std::shared_ptr<const Patch> patch;
    std::vector<Index> points;  ///< of the set, one for each control point of the patch
  };
  /// @param num_points   control points of the set
  /// @param coordinates  of the columns of all of them
  /// @throws InvalidParameter     members that name points which are not there, or not one for each of their own
  /// @throws UnsupportedTopology  faces that are triangles beside squares
  /// @throws ResourceError        more faces than 32-bit indices count
  PatchSet(std::vector<Member> members, Index num_points, Coordinates coordinates = Coordinates::plain);
  /// Patches that share nothing, their control points one patch after the other.
  explicit PatchSet(const std::vector<std::shared_ptr<const Patch>>& patches,
                    Coordinates coordinates = Coordinates::plain);

  const std::vector<Member>& members() const { return members_; }
  Coordinates coordinates() const { return coordinates_; }
  Index first_face(size_t patch) const { return first_face_[patch]; }
  /// The patch of a face.
  size_t patch_of(Index face) const;
  /// Columns of a patch's own control points.
  Points columns_of(size_t patch, const Points& columns) const;

  /// Control points that the rows of a face are over, and what these depend on: see Patch.
  std::vector<Index> slots(Index face) const;
  std::string type(Index face) const;
  std::string ends(Index face) const;

  Index num_points() const override { return num_points_; }
  FaceCount faces() const override { return {first_face_.back(), triangles_}; }
  FaceLengths lengths(Index face) const override;
  /// Returns the stencil of a place; of rational patches over homogeneous columns.
  LimitStencil stencil(const Sample& sample, int order = 0) const override;
  /// @param columns  #points x 3, or x 4 if they are homogeneous
  LimitSamples evaluate(const Points& columns, std::span<const Sample> samples, int order = 0,
                        bool normals = true) const override;
  /// B-splines become Bezier pieces, if there is memory for them.
  std::unique_ptr<BoundSource> bound(const Points& columns) const& override;
  std::unique_ptr<BoundSource> bound(const Points& columns) const&& = delete;

  /// All patches with finer nets, and S; points are no longer shared.
  /// @throws UnsupportedTopology  a patch has no net
  /// @throws ResourceError        more points or nonzeros than 32-bit indices count
  std::pair<PatchSet, SparseMatrix> refined() const;

  /// The nets of all patches as one mesh over the points of the set, and the place of each of its points on a patch
  /// that has it.
  struct Net {
    std::vector<Sample> places;
    std::vector<Index> sizes, vertices;
  };
  /// @throws UnsupportedTopology  a patch has no net, a point is of no patch
  Net net() const;

  /// 64 bits of all that decides which rows faces have and over which points: patches and how they share points.
  std::uint64_t hash() const;

 private:
  std::vector<Member> members_;
  Index num_points_ = 0;
  Coordinates coordinates_;
  bool triangles_ = false;
  std::vector<Index> first_face_{0};  // by patch, and the end
};

}  // namespace sublimit
