// SPDX-License-Identifier: Apache-2.0
#pragma once
// The patterns of a table that follows edits of its mesh (bake/editable_table.h). Only faces around an edit are
// matched anew. They get new points, after all others, which a second, small table makes; the points that the
// first table still makes for them are unused.
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/editable_table.h"

namespace sublimit {

/// A table of level k, or of its limits, that can be edited. Copies are independent, and share unchanged data.
/// An object that was moved from may only be assigned to or destroyed.
template <class Real>
class PatternEdits {
 public:
  /// @param patterns  dictionary of the scheme; must outlive this
  /// @param mesh      a mesh whose faces the scheme all cuts into four of their kind; face-varying values are
  ///                  ignored
  /// @param level     k, the level whose vertices are the points
  /// @param limit     true: the limits of these vertices instead
  /// @throws InvalidParameter, InvalidMesh, UnsupportedTopology, ResourceError  as `bake`; and if a table by
  ///                                                                            patterns of
  ///         the control mesh is not possible
  PatternEdits(Patterns& patterns, Mesh mesh, int level, const SubdivisionOptions& options = {}, bool limit = false);

  /// Edits the mesh. Takes time in proportion to the faces around all edits so far, not to those of the mesh.
  /// @throws InvalidMesh, UnsupportedTopology, InvalidParameter  an edit that is not possible; nothing is
  ///                                                             changed
  MeshChange edit(const MeshEdit& edit);

  std::int32_t num_control_points() const { return num_vertices_; }
  /// Returns the number of points, including unused ones.
  std::int64_t num_points() const;
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  Index num_faces() const { return static_cast<Index>(faces_.size()); }  ///< removed ones included
  bool is_removed(Index face) const { return faces_[size_t(face)].corners.empty(); }
  const Lattice& lattice() const { return lattice_; }
  /// Returns the point at a row of a face's lattice, which starts at corner `turn` of the face.
  std::int64_t point(Index face, std::int32_t row) const;
  int turn(Index face) const { return faces_[size_t(face)].turn; }
  /// Returns the mesh after all edits: remaining faces in the order of their numbers, all vertices at the
  /// origin.
  Mesh mesh() const;

 private:
  struct FaceState {
    std::vector<Index> corners;  // empty: removed
    const Pattern* pattern = nullptr;
    const RowMatrix* weights = nullptr;  // weights of the pattern, if edited
    std::vector<Index> vertices;         // vertices that it depends on, if edited
    std::int64_t first_point = 0;
    std::int8_t turn = 0;
    LatticeRanks::Share share = 0;
    bool is_edited = false;
  };
  struct Owner {
    Index face = -1;
    int corner = 0;  // corner of the face: start of the side, or the corner itself
    bool reversed = false;
  };
  Owner side_owner(Index face, int corner) const;
  Owner corner_owner(Index face, int corner) const;
  std::vector<Index> faces_around(const std::set<Index>& vertices) const;
  /// Returns some faces as a level of their own, and the vertex of the mesh for each of its vertices.
  Level local_level(const std::vector<Index>& faces, std::vector<Index>& vertices) const;
  void set_crease(Index a, Index b, float sharpness);
  void rebuild();

  /// A table with its evaluator, which refers to it, so that it cannot be moved. Shared between copies.
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
  std::shared_ptr<const Prepared> base_, edits_;  // edits_ is null if nothing was edited
};

extern template class PatternEdits<float>;
extern template class PatternEdits<double>;

}  // namespace sublimit
