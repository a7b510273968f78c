// SPDX-License-Identifier: Apache-2.0
#pragma once
// Refines a control mesh level by level, with connectivity and subdivision matrix of every level.
//
//   const AnyScheme scheme("catmull-clark");
//   const std::vector<Level> levels = refine(*scheme, mesh, 3);
//   const Points fine = refinement_matrix(levels) * mesh.positions;
//   std::cout << levels.back().topology().num_faces() << " faces\n";
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/subdivision_matrix.h"

namespace sublimit {

/// Rules for boundaries and creases. An absent rule is that of the mesh, or else edge_and_corner and uniform.
struct SubdivisionOptions {
  std::optional<Boundary> boundary;
  std::optional<Creasing> creasing;
};

/// One level of a refined mesh. Plain data: threads may read it together.
template <class T>
struct LevelOf {
  int number = 0;  ///< 0 for the control mesh
  /// Refinements from the level before to this one, one for each step of the scheme; for level 0 the topology alone.
  std::vector<Refinement> steps;
  Sharpness sharpness;
  KnotIntervals intervals;  ///< empty if all are equal
  std::vector<bool> holes;  ///< true for each face that is a hole
  /// The scheme that made the level: limits of the level are limits of this scheme. Null for a level made otherwise.
  std::shared_ptr<const Scheme<T>> made_by;
  SparseMatrixOf<T> S;  ///< from the level before (empty for level 0): x_k = S * x_{k-1}

  /// Returns the connectivity of the level.
  const Topology& topology() const { return steps.back().topology; }
  /// Returns the new knots of the step to the next level, or nothing if all intervals are equal.
  std::optional<KnotSplit> knots() const {
    return intervals.empty() ? std::nullopt : std::optional(new_knots(intervals));
  }

  LevelOf() = default;
  LevelOf(const LevelOf&) = default;
  LevelOf& operator=(const LevelOf&) = default;
  LevelOf(LevelOf&& other) noexcept
      : number(other.number),
        steps(std::move(other.steps)),
        sharpness(std::move(other.sharpness)),
        intervals(std::move(other.intervals)),
        holes(std::move(other.holes)),
        made_by(std::move(other.made_by)),
        S(moved(other.S)) {}
  LevelOf& operator=(LevelOf&& other) noexcept {
    number = other.number;
    steps = std::move(other.steps);
    sharpness = std::move(other.sharpness);
    intervals = std::move(other.intervals);
    holes = std::move(other.holes);
    made_by = std::move(other.made_by);
    S.swap(other.S);
    return *this;
  }
};
using Level = LevelOf<double>;

/// Returns level 0 of a control mesh.
/// @throws InvalidMesh           bad connectivity, a tag that points nowhere, knot intervals that contradict each other
/// @throws InvalidParameter      an incomplete scheme (`check_scheme`)
/// @note  Boundary::none makes no holes for a scheme whose faces need no neighbours (bilinear).
template <class T>
LevelOf<T> control_level(const Scheme<T>& scheme, const Mesh& mesh, const SubdivisionOptions& options = {});

/// Returns the level after `parent`.
/// @throws UnsupportedTopology  a face that the scheme cannot take
template <class T>
LevelOf<T> next_level(const Scheme<T>& scheme, const LevelOf<T>& parent);

/// Returns levels 0 to `levels`.
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter     negative `levels`
/// @throws UnsupportedTopology  a face that the scheme cannot take
/// @throws InvalidMesh          bad connectivity, a tag that points nowhere
/// @throws ResourceError        more elements than 32-bit indices, or more memory than the machine has; predicted
///                              before memory is taken
[[nodiscard]] std::vector<Level> refine(const Scheme<double>& scheme, const Mesh& mesh, int levels,
                                        const SubdivisionOptions& options = {},
                                        const std::function<void(int)>& progress = {});
/// Returns levels 0 to `levels`, starting from a given level 0.
/// @param control   level 0, as `control_level` makes it
/// @param progress  called before each level with its number, if given
/// @throws as the overload for a mesh
[[nodiscard]] std::vector<Level> refine(const Scheme<double>& scheme, Level control, int levels,
                                        const std::function<void(int)>& progress = {});

/// Returns P_k = S_{k-1} ... S_0, which makes the points of the last level k from the control points; the identity for
/// k = 0.
[[nodiscard]] SparseMatrix refinement_matrix(const std::vector<Level>& levels);

/// Returns for each face of the last level the face of the first one that it comes from: its own parent, or one at its
/// edge or vertex.
std::vector<Index> control_faces(std::span<const Level> levels);
/// Faces of a level that its descendants come from, step by step. Triangles of sqrt3 lie in two faces each after one
/// step, and have one of these; after two steps they are back in one.
class ControlFaces {
 public:
  explicit ControlFaces(Index count);
  /// Goes on to the children.
  /// @param parent  connectivity before the step
  void follow(const Topology& parent, const Refinement& step);
  /// Returns the face of the first level for each face of this one.
  const std::vector<Index>& faces() const { return faces_; }

 private:
  std::vector<Index> faces_, before_;  // of the level, of the one before
  Index from_vertices_ = 0, from_faces_ = 0;
  std::vector<Index> face_list_;  // of the last step, see `Refinement`
  bool straddles_ = false;        // a triangle lies in two faces
};

/// Returns the number of vertices of a level without refining; exact except for dual steps across borders.
double predicted_vertices(const Scheme<double>& scheme, const Topology& control, int level);

/// Returns an estimate of the bytes that `levels` levels take, matrices included.
double predicted_bytes(const Scheme<double>& scheme, const Topology& control, int levels);

/// Some faces of a level as a level of their own. Its border is treated as a boundary: refined points near it differ
/// from those of the mesh.
struct Part {
  Level level;                                 ///< the part, without a matrix
  std::vector<Index> faces, vertices, halves;  ///< numbers of its elements in the whole, ascending
};
/// Returns some faces of a level with `rings` rings of faces around them.
Part part(const Level& whole, std::span<const Index> faces, int rings);

/// A part of a mesh: selected faces with as many rings of faces around them as their next refinement needs.
struct Subset {
  Level level;                 ///< the part with its own numbers; S has a row for each vertex, over those of the origin
  std::vector<Index> faces;    ///< selected faces, in the part's numbers
  std::vector<Index> parents;  ///< number in the whole of each face of the part, ascending
};

/// Returns a part of a level. `level.S` of the result selects vertices of the whole.
/// @param rings  rings of faces around the selected ones: as many as `rings_for_refinement` returns, 1 for primal
///               schemes without wide masks
/// @throws InvalidParameter  a face that does not exist
Subset subset(const Level& level, std::span<const Index> faces, int rings = 1);
/// Returns the number of rings that a subset needs for one refinement. Takes milliseconds for wide masks and for
/// several steps, which are applied to labelled meshes.
/// @throws AnalysisError  masks reach beyond twelve rings
int rings_for_refinement(const Scheme<double>& scheme);

/// Refines the selected faces without the rest of the mesh; all their children are selected in the result. Rows of
/// `level.S` are those that refining the whole mesh would give, over the vertices of `part`.
[[nodiscard]] Subset refine(const Scheme<double>& scheme, const Subset& part);

}  // namespace sublimit
