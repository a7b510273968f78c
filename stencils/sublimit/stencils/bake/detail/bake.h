// SPDX-License-Identifier: Apache-2.0
#pragma once
// Baking tables of meshes: of level k, of the limits of its vertices, of grids or lists of places on the limit.
#include <limits>

#include "sublimit/eval/table/baked_table.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/source/address.h"
#include "sublimit/stencils/patterns/patterns.h"

namespace sublimit {

/// Methods of making a table. All make the same points, to rounding; the order of points may differ.
enum class BakeMethod {
  automatic,           ///< the first of those below that is possible and efficient
  patterns,            ///< a block for each type of neighbourhood
  rows_then_patterns,  ///< level 1 by rows, then a block for each type on it
  rows,                ///< a row for each point
};
/// Returns "patterns", "rows then patterns" or "rows".
const char* name(BakeMethod method);

/// The points that a table is to make.
struct BakeRequest {
  TableRows rows = TableRows::level;
  int level = 0;                    ///< k of `TableRows::level` (1 to 11) and `limit` (0 to 11)
  int grid = 0;                     ///< N of `TableRows::grid`, 2 to 2048
  std::vector<Place> samples = {};  ///< places of `TableRows::samples`
  /// Faces between the `samples`, counter-clockwise, which the table stores so that a mesh can be written.
  std::vector<Index> face_sizes = {}, face_vertices = {};
  int derivatives = 0;  ///< order of derivatives of the limit: 0, 1 or 2
  BakeMethod method = BakeMethod::automatic;
  // With `level` and `limit`, for writing a mesh of the points. All of these refine the mesh, which takes the time and
  // memory that tables save, and are as large as a mesh.
  bool face_varying = false;  ///< store face-varying channels, refined, with `limit` at their limit
  std::optional<FaceVaryingInterpolation> face_varying_interpolation = {};  ///< absent: that of the mesh, else all
  bool tags = false;   ///< store creases and corners that are left on level k
  bool order = false;  ///< keep `BakedTable::refined_points`
};

/// Returns true if a request is for data that only a refined mesh has: face-varying values, tags, its order.
inline bool needs_refined_mesh(const BakeRequest& request) {
  return request.face_varying || request.tags || request.order;
}

/// Checks a request.
/// @throws InvalidParameter  a request outside these ranges, derivatives of a level
void check(const BakeRequest& request);

/// Statistics of a bake: how the faces of a mesh were treated.
struct BakeStatistics {
  BakeMethod method = BakeMethod::rows;  ///< method that was used
  Index faces = 0;                       ///< number of faces with patterns
  Index types = 0;                       ///< number of types of neighbourhoods, rotations not counted
  Index blocks = 0;                      ///< number of blocks of weights
  Index groups = 0;                      ///< number of groups of patches
  std::int64_t points = 0;
  std::int64_t weights = 0;
  std::int64_t bytes = 0;          ///< size of the table in double; in float 4 bytes less for each weight
  std::int64_t channel_bytes = 0;  ///< size of face-varying channels and tags, not counted in `bytes`
};

/// A table and the statistics of making it.
///
/// Points of levels by patterns are ordered face by face: those inside a face, then those of its sides and corners that
/// no previous face owns; isolated vertices are last. In dual schemes they are ordered by the corners of faces. Points
/// of levels by rows have the order of refinement, those of grids and samples the order of the request.
///
/// Derivatives at vertices of a level are those of the face that owns the point; at extraordinary vertices, and by
/// rows, they are two tangents that span the tangent plane. Statuses say which ones exist.
struct [[nodiscard]] Baked {
  BakedTable<double> table;
  BakeStatistics statistics;
};

/// Bakes a table of any linear scheme.
/// @param patterns  dictionary of the scheme; new types are added
/// @throws InvalidParameter     a request outside its ranges, derivatives of a level, channels or tags of other
///                              points, a place outside its face, a method that is not possible
/// @throws InvalidMesh, UnsupportedTopology  as refinement does
/// @throws ResourceError        not enough memory, predicted before it is taken
/// @note  The same request gives the same bits, with one exception: types with a finite sharpness have the sums' order
///        of the mesh that they first occurred in, so their bits depend on the contents of the dictionary.
Baked bake(Patterns& patterns, const Mesh& mesh, const BakeRequest& request, const SubdivisionOptions& options = {});

/// Bakes a table of classical patches: grids by patterns, with a block for each type of face; places by rows; `level`:
/// the control nets after halving every knot span k times, patch by patch. `TableInfo::rational` tables are applied to
/// homogeneous columns.
/// @throws InvalidParameter     as above; channels, tags and limits of levels, which patches do not have
/// @throws UnsupportedTopology  a level of patches that have no nets
/// @throws ResourceError        not enough memory, predicted before it is taken
Baked bake(const PatchSet& patches, const BakeRequest& request);

/// Predicted size and memory of a bake, from the types of all faces.
struct [[nodiscard]] BakePlan {
  /// Statistics of the table: exact; upper bounds of weights and bytes for schemes with wide masks; estimates of
  /// weights and bytes for tables by rows, and of `channel_bytes`.
  BakeStatistics statistics;
  double memory = 0;  ///< estimated peak memory in bytes, besides the given mesh
};

/// Returns the plan of a bake, without making weights or the table.
/// @param limit  bytes of memory
/// @throws ResourceError  the bake takes more than `limit`, thrown as soon as it is known; and what `bake` throws
BakePlan bake_plan(Patterns& patterns, const Mesh& mesh, const BakeRequest& request,
                   const SubdivisionOptions& options = {}, double limit = std::numeric_limits<double>::infinity());

/// Bakes a table of level k, from 1 to 11.
Baked bake_level(Patterns& patterns, const Mesh& mesh, int levels, const SubdivisionOptions& options = {});

}  // namespace sublimit
