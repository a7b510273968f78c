// SPDX-License-Identifier: Apache-2.0
#pragma once
// Several patches as one linear source: faces are numbered one patch after the other, and patches may share control
// points.
//
//   const auto patch = std::make_shared<const SplineSurface>(bezier_knots<double>(1), bezier_knots<double>(1));
//   const PatchSet set({{patch, {0, 1, 3, 4}}, {patch, {1, 2, 4, 5}}}, 6);
//   const Points control{{0, 0, 0}, {1, 0, 0}, {2, 0, 1}, {0, 1, 0}, {1, 1, 0}, {2, 1, 1}};
//   const Patches patches(set, control);
#include <memory>
#include <vector>

#include "sublimit/patches/patch.h"
#include "sublimit/source/linear_source.h"

namespace sublimit {

/// Patches without control points. It never changes: threads may share it.
class PatchSet : public LinearSource {
 public:
  /// A patch, and its control points in the set.
  struct Member {
    std::shared_ptr<const Patch> patch;
    std::vector<Index> points;  ///< number in the set for each control point of the patch
  };
  /// Makes a set of patches that may share control points.
  /// @param num_points   number of control points of the set
  /// @param coordinates  whether columns are points or homogeneous, for all patches alike
  /// @throws InvalidParameter     members with points that do not exist, or not one for each control point
  /// @throws UnsupportedTopology  faces that are triangles beside squares
  /// @throws ResourceError        more faces than 32-bit indices count
  PatchSet(std::vector<Member> members, Index num_points, Coordinates coordinates = Coordinates::plain);
  /// Makes a set of patches that share no control points, which are numbered one patch after the other.
  /// @throws as the other constructor
  explicit PatchSet(const std::vector<std::shared_ptr<const Patch>>& patches,
                    Coordinates coordinates = Coordinates::plain);

  const std::vector<Member>& members() const { return members_; }
  Coordinates coordinates() const { return coordinates_; }
  Index first_face(size_t patch) const { return first_face_[patch]; }
  /// Returns the patch that a face belongs to.
  size_t patch_of(Index face) const;
  /// Returns the columns of one patch's control points.
  Points columns_of(size_t patch, const Points& columns) const;

  /// Returns the slots of a face as control points of the set; see `Patch::slots`.
  std::vector<Index> slots(Index face) const;
  /// Returns what the rows of a face depend on, as bytes; see `Patch::type`.
  std::string type(Index face) const;
  /// Returns what the statuses of a face depend on besides; see `Patch::ends`.
  std::string ends(Index face) const;

  Index num_points() const override { return num_points_; }
  FaceCount faces() const override { return {first_face_.back(), triangles_}; }
  FaceLengths lengths(Index face) const override;
  /// Returns the stencil of a place, for rational patches over homogeneous columns.
  LimitStencil stencil(const Place& place, int order = 0) const override;
  /// Returns points with derivatives and normals; in parallel.
  /// @param columns  control points, #points x 3, or x 4 if they are homogeneous
  /// @throws InvalidParameter  an array of another size, another order
  LimitSamples evaluate(const Points& columns, std::span<const Place> places, int order = 0,
                        bool normals = true) const override;
  /// Returns the patches with control points, for many evaluations. B-splines are converted to Bezier pieces, if there
  /// is memory for them.
  std::unique_ptr<BoundSource> bound(const Points& columns) const& override;
  std::unique_ptr<BoundSource> bound(const Points& columns) const&& = delete;

  /// Returns all patches with finer nets, and the matrix that makes their control points, which are no longer shared.
  /// @throws UnsupportedTopology  a patch has no net
  /// @throws ResourceError        more points or nonzeros than 32-bit indices count
  std::pair<PatchSet, SparseMatrix> refined() const;

  /// The nets of all patches as one mesh over the control points of the set.
  struct Net {
    std::vector<Place> places;           ///< a place for each control point, on a patch that has it
    std::vector<Index> sizes, vertices;  ///< polygons
  };
  /// Returns the nets of all patches.
  /// @throws UnsupportedTopology  a patch without a net, a control point of no patch
  Net net() const;

  /// Returns a hash of the patches and of the points that they share: all that stencils depend on.
  std::uint64_t hash() const;

 private:
  std::vector<Member> members_;
  Index num_points_ = 0;
  Coordinates coordinates_;
  bool triangles_ = false;
  std::vector<Index> first_face_{0};  // by patch, and the end
};

}  // namespace sublimit
