// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fast refinement to points and faces: no matrix is made, and the last level has no connectivity but the corners of its
// faces.
#include <memory>

#include "sublimit/scheme/any_scheme.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Returns the last of `levels` levels as a mesh: points and faces in the order of `refine`, with the tags that are
/// left, so that refining it goes on where this stopped (`level_mesh`). Points are those of the matrices, to rounding,
/// and have the same bits for any number of threads.
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter     negative `levels`
/// @throws UnsupportedTopology  a face that the scheme cannot take
/// @throws ResourceError        more elements than 32-bit indices, or more memory than the machine has; predicted
///                              before memory is taken
/// @note  Face-varying channels are left out (primvar/face_varying.h).
ControlMesh refined_mesh(const Scheme<double>& scheme, const ControlMesh& mesh, int levels,
                         const SubdivisionOptions& options = {}, const std::function<void(int)>& progress = {});

/// Refines one connectivity for many sets of points: what does not depend on them is made once.
class Refiner {
 public:
  /// @throws as `refined_mesh`
  Refiner(const Scheme<double>& scheme, const ControlMesh& mesh, int levels, const SubdivisionOptions& options = {},
          const std::function<void(int)>& progress = {});
  /// Uses the rules of the mesh.
  /// @throws as `refined_mesh`
  Refiner(const ControlMesh& mesh, const AnyScheme& scheme, int levels)
      : Refiner(*scheme.for_mesh(mesh), mesh, levels) {}
  ~Refiner();
  Refiner(Refiner&&) noexcept;
  Refiner& operator=(Refiner&&) noexcept;

  /// Returns faces and tags of the last level, without positions.
  const ControlMesh& mesh() const { return mesh_; }
  Index num_control_points() const;
  Index num_points() const;
  /// Returns the points of the last level, num_points() x columns; with the same bits as `refined_mesh`.
  /// @param control  a row for each control point, any number of columns
  /// @throws InvalidParameter  another number of rows
  Points points(const Points& control) const;

 private:
  struct Stage;
  std::vector<std::unique_ptr<const Stage>> stages_;
  Index num_control_points_ = 0;
  ControlMesh mesh_;
};

/// Returns a level as a mesh, whose refinement continues that of the level. Sharpness and holes are told where
/// connectivity and the rule for borders do not imply them; Boundary::none becomes edge-only with the holes that it
/// made.
/// @param points   a row for each vertex; moved into the mesh
/// @param control  the mesh of level 0, for its options
/// @note  The middle of a non-manifold edge of two faces wound alike is a crease here and a corner to a reader, which
///        cannot know better. Nor can it tell apart two edges that join the same two vertices: children of such meshes
///        (a pillow of two triangles, a degenerate edge) are joined otherwise when read back.
ControlMesh level_mesh(const Level& level, Points points, const ControlMesh& control,
                       const SubdivisionOptions& options = {});

/// Sharp edges and vertices of a level that do not follow from its connectivity and the rule for borders.
struct RemainingTags {
  std::vector<Edge> creases;
  std::vector<Vertex> corners;
  Boundary boundary = Boundary::edge_only;  ///< never none: what that made are holes
};
RemainingTags remaining_tags(const Level& level, const ControlMesh& control, const SubdivisionOptions& options);

}  // namespace sublimit
