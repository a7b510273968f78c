// SPDX-License-Identifier: Apache-2.0
#pragma once
// The patterns of a table that follows edits of its mesh (bake/editable_table.h): faces around the change are matched
// anew, everything else stays as it is. Faces that an edit concerns get points of their own at the end, made by a small
// table; what the large one still makes for them is not used.
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "sublimit/eval/pattern_evaluator.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/editable_table.h"

namespace sublimit {

/// A value: copies are edited apart from each other and share what they have in common; one that was moved from may be
/// assigned to or destroyed.
template <class Real>
class PatternEdits {
 public:
  /// Vertices of level k.
  /// @param patterns  of the scheme, which must stay
  /// @param mesh      all faces of which the scheme cuts in four of their kind; values at corners are left out
  /// @throws InvalidParameter, InvalidMesh, UnsupportedTopology, ResourceError  as `bake` does, and where it would not
  ///         make blocks of the control mesh
  /// @param limit     the limits of these vertices instead
  PatternEdits(Patterns& patterns, Mesh mesh, int level, const SubdivisionOptions& options = {}, bool limit = false);

  /// Takes time in proportion to the faces around all edits so far, not to those of the mesh.
  /// @throws InvalidMesh, UnsupportedTopology, InvalidParameter  an edit that is not possible; nothing has changed
  MeshChange edit(const MeshEdit& edit);

  std::int32_t num_control_points() const { return num_vertices_; }
  /// Unused ones included.
  std::int64_t num_points() const;
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  Index num_faces() const { return static_cast<Index>(faces_.size()); }  ///< removed ones included
  bool is_removed(Index face) const { return faces_[size_t(face)].corners.empty(); }
  const Lattice& lattice() const { return lattice_; }
  /// The point at a row of a face's lattice, whose corner (0, 0) is corner `turn` of the face.
  std::int64_t point(Index face, std::int32_t row) const;
  int turn(Index face) const { return faces_[size_t(face)].turn; }
  /// The mesh as it is: faces that are left in the order of their numbers, all vertices at the origin.
  Mesh mesh() const;

 private:
  struct FaceState {
    std::vector<Index> corners;  // empty: removed
    const Pattern* pattern = nullptr;
    const RowMatrix* weights = nullptr;  // of the pattern, once edited
    std::vector<Index> vertices;         // that it depends on, once edited
    std::int64_t first_point = 0;
    std::int8_t turn = 0;
    LatticeRanks::Share share = 0;
    bool is_edited = false;
  };
  struct Owner {
    Index face = -1;
    int corner = 0;  // of the face: where the side begins, or the corner itself
    bool reversed = false;
  };
  Owner side_owner(Index face, int corner) const;
  Owner corner_owner(Index face, int corner) const;
  std::vector<Index> faces_around(const std::set<Index>& vertices) const;
  /// Some faces with rings of others around them, as a level of their own, and the numbers of its vertices.
  Level local_level(const std::vector<Index>& faces, std::vector<Index>& vertices) const;
  void set_crease(Index a, Index b, float sharpness);
  void rebuild();

  /// A table and what applies it: at one place for as long as any copy needs it.
  struct Prepared {
    explicit Prepared(PatternTable<Real> made) : table(std::move(made)), evaluator(table) {}
    Prepared(const Prepared&) = delete;
    Prepared& operator=(const Prepared&) = delete;
    PatternTable<Real> table;
    PatternEvaluator<Real> evaluator;
  };

  Patterns* patterns_;
  SubdivisionOptions options_;
  Mesh tags_;  // boundary, creasing and triangles rules, holes
  Lattice lattice_;
  int level_ = 0;
  bool limit_ = false;
  Index num_vertices_ = 0;
  std::vector<FaceState> faces_;
  std::vector<std::vector<Index>> faces_of_;  // by vertex
  std::map<std::pair<Index, Index>, float> creases_;
  std::map<Index, float> corners_;
  LatticeRanks ranks_;
  std::set<Index> edited_;
  std::shared_ptr<const Prepared> base_, edits_;  // null: nothing has been edited
};

extern template class PatternEdits<float>;
extern template class PatternEdits<double>;

}  // namespace sublimit
