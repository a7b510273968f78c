// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fast refinement to points and faces: no matrix is made, and no half-edges of the last level.
//
//   const Refiner refiner(mesh, "catmull-clark", 3);
//   const Points fine = refiner.points(mesh.positions);  // again for each frame
//   write_mesh("fine.obj", refiner.mesh().with_points(fine));
#include <memory>

#include "sublimit/scheme/any_scheme.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Returns level `levels` as a mesh: points and faces in the order of `refine`, with the tags that remain, so that
/// refining the result continues the refinement (see `level_mesh`). Points agree with those of the matrices up to
/// rounding, and have the same bits for any number of threads.
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter     negative `levels`
/// @throws InvalidMesh          bad connectivity, a tag that points nowhere
/// @throws UnsupportedTopology  a face that the scheme cannot take
/// @throws ResourceError        more elements than 32-bit indices, or more memory than the machine has; predicted
///                              before memory is taken
/// @note  Faces have the names and values of their parents, vertices the values refined as positions are. Face-varying
///        channels are left out (primvar/face_varying.h), and so are linear values (primvar/vertex_values.h). Warnings
///        of the result say what keeps the mesh from being a manifold.
Mesh refined_mesh(const Scheme<double>& scheme, const Mesh& mesh, int levels, const SubdivisionOptions& options = {},
                  const std::function<void(int)>& progress = {});

/// Refines one connectivity for many sets of points. It never changes: threads may share it.
class Refiner {
 public:
  /// Prepares refinement to level `levels`.
  /// @param progress  called before each level with its number, if given
  /// @throws as `refined_mesh`
  Refiner(const Scheme<double>& scheme, const Mesh& mesh, int levels, const SubdivisionOptions& options = {},
          const std::function<void(int)>& progress = {});
  /// Prepares refinement by the rules of the mesh.
  /// @throws as `refined_mesh`
  Refiner(const Mesh& mesh, const AnyScheme& scheme, int levels) : Refiner(*scheme.for_mesh(mesh), mesh, levels) {}
  ~Refiner();
  Refiner(Refiner&&) noexcept;
  Refiner& operator=(Refiner&&) noexcept;

  /// Returns faces and tags of the last level with what they carry, without positions.
  const Mesh& mesh() const { return mesh_; }
  Index num_control_points() const;
  /// Returns the number of points of the last level.
  Index num_points() const;
  /// Returns the points of the last level, num_points() x columns, with the same bits as `refined_mesh`.
  /// @param control  a row for each control point, any number of columns
  /// @throws InvalidParameter  another number of rows
  Points points(const Points& control) const;

 private:
  struct Stage;
  std::vector<std::unique_ptr<const Stage>> stages_;
  Index num_control_points_ = 0;
  Mesh mesh_;
};

/// Returns a level as a mesh, whose refinement continues that of the level. The mesh has tags for the sharpness and the
/// holes that connectivity and the rule for boundaries do not imply; Boundary::none becomes edge_only with the holes
/// that it made.
/// @param points   a row for each vertex; moved into the mesh
/// @param control  the mesh of level 0, for its rules
/// @note  Two things are lost in a mesh. The middle of a non-manifold edge of two faces with the same winding is a
///        crease in the level and becomes a corner. Edges that join the same two vertices (a pillow of two
///        triangles, a degenerate edge) become one edge.
Mesh level_mesh(const Level& level, Points points, const Mesh& control, const SubdivisionOptions& options = {});

/// Sharp edges and vertices of a level that do not follow from its connectivity and the rule for boundaries.
struct RemainingTags {
  std::vector<Edge> creases;
  std::vector<Vertex> corners;
  Boundary boundary = Boundary::edge_only;  ///< never `none`, whose effect is in the holes
};
/// Returns the tags that a mesh of a level needs.
/// @param control  the mesh of level 0, for its rules
RemainingTags remaining_tags(const Level& level, const Mesh& control, const SubdivisionOptions& options);

}  // namespace sublimit
