// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table that follows edits of its mesh: only the faces around a change are made anew.
//
//   EditableTable<float> table(mesh, "catmull-clark", {.levels = 3});
//   const MeshChange change = table.edit({.removed_faces = {7}, .added_faces = {{0, 1, 5, 4}}});
//   std::vector<float> result(table.num_points() * 3);
//   table.apply(points, 3, result);  // change.faces have new points, from change.first_points on
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sublimit/eval/table/face_lattices.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/any_scheme.h"

namespace sublimit {

/// A change of connectivity or tags. Faces keep their numbers, new ones get the next; so do vertices.
struct MeshEdit {
  std::vector<Index> removed_faces = {};
  std::vector<std::vector<Index>> added_faces = {};  ///< corners of each face, counter-clockwise
  Index added_vertices = 0;                          ///< number of new vertices, numbered after the existing ones
  std::vector<Mesh::Crease> creases = {};            ///< along existing edges; sharpness 0 makes an edge smooth
  std::vector<Mesh::Corner> corners = {};
};

/// Faces that an edit has changed.
struct MeshChange {
  std::vector<Index> faces;       ///< that got new points, ascending
  std::int64_t first_points = 0;  ///< points of all faces edited so far: from here to `num_points`
};

struct EditableTableOptions {
  int levels = 3;      ///< points of this level, 1 to 11; 0 to 11 if `limit` is set
  bool limit = false;  ///< the limits of these points instead
};

/// A table of the points of a level, or of their limits, for meshes that change. Points of edited faces stand behind
/// all others; what the table still makes for these faces in front is not used, so that after many edits a new table is
/// smaller. A value: copies are edited apart from each other and share what they have in common. Any number of threads
/// may apply one; an edit needs it alone.
template <class Real>
class EditableTable {
 public:
  /// @param scheme  one that cuts all faces of the mesh into four of their kind, and keeps edges: catmull-clark on
  ///                quadrilaterals, loop, butterfly, kobbelt and others
  /// @throws InvalidParameter                  levels outside their range
  /// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine so: says why
  /// @throws ResourceError                     more memory than there is
  EditableTable(Mesh mesh, const AnyScheme& scheme, const EditableTableOptions& options = {});
  // Moving copies: a moved-from object stays valid.
  EditableTable(const EditableTable&) = default;
  EditableTable& operator=(const EditableTable&) = default;

  /// Edits the mesh, in time proportional to the faces around all edits so far, not to those of the mesh.
  /// @throws InvalidMesh, UnsupportedTopology, InvalidParameter  an edit that is not possible; nothing has changed
  MeshChange edit(const MeshEdit& edit);

  std::int32_t num_control_points() const;  ///< vertices of the mesh as it is
  std::int64_t num_points() const;          ///< unused ones included
  /// Makes all points of one frame, by all threads of oneTBB.
  /// @param points  num_control_points x channels, interleaved
  /// @param result  num_points x channels, interleaved
  /// @throws InvalidParameter  spans of the wrong length, channels below 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  Index num_faces() const;            ///< removed ones included
  bool is_removed(Index face) const;  ///< true of a face that an edit took away
  /// Returns the grid of points that each face has.
  const Lattice& lattice() const;
  /// Returns the point at a row of a face's lattice, whose corner (0, 0) is corner `turn` of the face.
  /// @throws InvalidParameter  a face that does not exist or is removed, a row outside the lattice
  std::int64_t point(Index face, std::int32_t row) const;
  int turn(Index face) const;  ///< see `point`
  /// Returns the mesh as it is: faces that are left in the order of their numbers, all vertices at the origin.
  Mesh mesh() const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;  // a copy that is edited gets its own
};

extern template class EditableTable<float>;
extern template class EditableTable<double>;

}  // namespace sublimit
