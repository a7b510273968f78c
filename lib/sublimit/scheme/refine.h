// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels: a control mesh, refined step by step, with the matrix of every level.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/core/moved_sparse.h"
#include "sublimit/mesh/control_mesh.h"
#include "sublimit/scheme/subdivision_matrix.h"

namespace sublimit {

/// Rules for boundaries and creases; what is absent follows the mesh's tags, else edge_and_corner and uniform.
struct SubdivisionOptions {
  std::optional<Boundary> boundary;
  std::optional<Creasing> creasing;
};

/// One level of a refined mesh.
template <class T>
struct LevelOf {
  int number = 0;
  /// The refinements that led here from the level before, one per step of the scheme; for level 0 a topology without
  /// provenance.
  std::vector<Refinement> steps;
  Sharpness sharpness;
  KnotIntervals intervals;  ///< empty where all are equal
  std::vector<bool> holes;  ///< per face
  /// The scheme that made it, which a dictionary of limits must be of; null where a level was put together otherwise.
  std::shared_ptr<const Scheme<T>> made_by;
  SparseMatrixOf<T> S;  ///< from the level before (empty for level 0): x_k = S * x_{k-1}

  const Topology& topology() const { return steps.back().topology; }
  /// New knots of the step to the next level; none where all intervals are equal.
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
/// @note  Boundary::none makes no holes for a scheme whose faces need no neighbours (bilinear).
template <class T>
LevelOf<T> control_level(const Scheme<T>& scheme, const ControlMesh& mesh, const SubdivisionOptions& options = {});

/// Returns the level after `parent`.
/// @throws UnsupportedTopology  a face that the scheme cannot take
template <class T>
LevelOf<T> next_level(const Scheme<T>& scheme, const LevelOf<T>& parent);

/// Returns levels 0 to `levels`.
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter     negative `levels`
/// @throws UnsupportedTopology  a face that the scheme cannot take
/// @throws ResourceError     more elements than 32-bit indices, or more memory than the machine has; predicted before
///                           memory is taken
[[nodiscard]] std::vector<Level> refine(const Scheme<double>& scheme, const ControlMesh& mesh, int levels,
                                        const SubdivisionOptions& options = {},
                                        const std::function<void(int)>& progress = {});
/// Returns levels 0 to `levels`, from a level 0 that was made before.
[[nodiscard]] std::vector<Level> refine(const Scheme<double>& scheme, Level control, int levels,
                                        const std::function<void(int)>& progress = {});

/// Returns P_k = S_{k-1} ... S_0, which makes the points of level k from the control points. The identity for k = 0.
[[nodiscard]] SparseMatrix refinement_matrix(const std::vector<Level>& levels);

/// Returns the number of vertices of a level; exact but for dual steps across borders.
double predicted_vertices(const Scheme<double>& scheme, const Topology& control, int level);

/// Returns how many bytes `levels` levels take, matrices included; an estimate.
double predicted_bytes(const Scheme<double>& scheme, const Topology& control, int levels);

/// Some faces of a level as a level of their own. Its rim is treated as a boundary: points near it are not those of the
/// mesh.
struct Part {
  Level level;                                 ///< without a matrix
  std::vector<Index> faces, vertices, halves;  ///< their numbers in the whole, ascending
};
/// Returns some faces with `rings` rings of faces around them.
Part part(const Level& whole, std::span<const Index> faces, int rings);

/// A part of a mesh: chosen faces with as many rings of faces around them as their next refinement needs.
struct Subset {
  Level level;  ///< the part, numbered on its own; S has a row per vertex, over those of where it came from
  std::vector<Index> faces;    ///< the chosen faces, in the part's numbers
  std::vector<Index> parents;  ///< of every face of the part: its number in the whole, ascending
};

/// Returns a part of a level. `level.S` of the result selects vertices of the whole.
/// @param rings  of faces around them; `rings_for_refinement` says how many the scheme needs, 1 is enough for narrow
/// primal ones
/// @throws InvalidParameter  a face that does not exist
Subset subset(const Level& level, std::span<const Index> faces, int rings = 1);
int rings_for_refinement(const Scheme<double>& scheme);

/// Refines the chosen faces without the rest of the mesh; all their children are chosen again. Rows of `level.S` are
/// those that refining the whole mesh would give, over the vertices of `part`.
[[nodiscard]] Subset refine(const Scheme<double>& scheme, const Subset& part);

}  // namespace sublimit
