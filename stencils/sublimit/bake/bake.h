// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a mesh to a table: of its level k, of that level's limit, of grids or lists of places on the limit.
#include <limits>

#include "sublimit/baked_table.h"
#include "sublimit/limit/address.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/patterns/patterns.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Methods of making a table. All make the same points, to rounding; the order of points may differ.
enum class BakeMethod {
  automatic,           ///< the first of these that is possible and pays: the second where most types would be rare
  patterns,            ///< a block for each type of neighbourhood
  rows_then_patterns,  ///< level 1 by rows, then a block for each type on it
  rows,                ///< a row for each point
};
/// "patterns", "rows then patterns", "rows".
const char* name(BakeMethod method);

/// The points that a table is to make.
struct BakeRequest {
  TableRows rows = TableRows::level;
  int level = 0;                     ///< k, of `level` (1 to 11) and `limit` (0 to 11)
  int grid = 0;                      ///< N, of `grid`, 2 to 2048
  std::vector<Sample> samples = {};  ///< of `samples`
  /// Faces between the `samples`, which the table keeps so that a mesh can be written; counter-clockwise.
  std::vector<Index> face_sizes = {}, face_vertices = {};
  int derivatives = 0;  ///< of the limit: 0, 1 or 2
  BakeMethod method = BakeMethod::automatic;
  // For `level` and `limit`, if a mesh of the points is to be written. Both refine the mesh itself, which takes the
  // time and memory that tables save, and are as large as a mesh.
  bool face_varying = false;  ///< the mesh's face-varying channels, refined, of the limit at their own limit
  std::optional<FaceVaryingInterpolation> face_varying_interpolation = {};  ///< none: that of the mesh, else all
  bool tags = false;  ///< creases and corners that level k has left
};

/// @throws InvalidParameter  a request outside these ranges, derivatives of a level
void check(const BakeRequest& request);

/// Statistics of a bake: how the faces of a mesh were treated.
struct BakeStatistics {
  BakeMethod method = BakeMethod::rows;  ///< that was taken
  Index faces = 0;                       ///< that have patterns
  Index types = 0;                       ///< of their neighbourhoods, rotations not counted
  Index blocks = 0;                      ///< matrices in the table
  Index groups = 0;                      ///< of patches that make the same rows of the same block
  std::int64_t points = 0;
  std::int64_t weights = 0;
  std::int64_t bytes = 0;          ///< of the table in double; one in float takes 4 less a weight
  std::int64_t channel_bytes = 0;  ///< of face-varying channels and tags, besides
};

/// A table and the statistics of making it.
///
/// Points of levels by patterns stand face by face, in the order of the table: those inside a face, then those of its
/// sides and corners that no other face has already, then isolated vertices; of dual schemes corner of a face by
/// corner. By rows they stand in the order of refinement. Those of grids and samples are as they were asked for.
///
/// At vertices of a level the derivatives are those of the face that has the point; at extraordinary vertices, and by
/// rows, two tangents that span the plane. Statuses tell what there is.
struct [[nodiscard]] Baked {
  BakedTable<double> table;
  BakeStatistics statistics;
};

/// Bakes a table of any linear scheme.
/// @param patterns  of the scheme; types that it does not know yet are added
/// @throws InvalidParameter     a request outside these ranges, derivatives of a level, channels or tags of other
///                              points, a place outside its address, a
///                              method that is not possible
/// @throws InvalidMesh, UnsupportedTopology  as refinement does
/// @throws ResourceError        more points than memory, predicted before it is taken
/// @note  Types on which finite sharpness matters keep the order of sums of the mesh that they were met in first; but
///        for these, and for all with a fresh dictionary, the same request gives the same bits.
Baked bake(Patterns& patterns, const ControlMesh& mesh, const BakeRequest& request,
           const SubdivisionOptions& options = {});

/// Bakes a table of classical patches: grids by patterns, a block for each type of face; places by rows; of `level` the
/// control points of the nets that halving every span k times gives, patch after patch. `TableInfo::rational` tables
/// are to be applied to homogeneous columns.
/// @throws InvalidParameter     as above; channels, tags and limits of levels, which patches do not have
/// @throws UnsupportedTopology  a level of patches that have no nets
/// @throws ResourceError        more than memory, predicted before it is taken
Baked bake(const PatchSet& patches, const BakeRequest& request);

/// What a bake will make and how much memory it takes, found by looking at every face once.
struct [[nodiscard]] BakePlan {
  /// Counted, weights and bytes of schemes with wide masks at most; but for tables by rows, whose weights and bytes are
  /// estimated, and so are all `channel_bytes`.
  BakeStatistics statistics;
  double memory = 0;  ///< bytes that the bake takes at once, about, besides the mesh as it is given
};

/// Returns the plan of a bake, without making weights or the table.
/// @param limit  bytes of memory
/// @throws ResourceError  the bake takes more than `limit`, thrown as soon as it is known; and what `bake` throws
BakePlan bake_plan(Patterns& patterns, const ControlMesh& mesh, const BakeRequest& request,
                   const SubdivisionOptions& options = {}, double limit = std::numeric_limits<double>::infinity());

/// Bakes a table of level k, from 1 to 11.
Baked bake_level(Patterns& patterns, const ControlMesh& mesh, int levels, const SubdivisionOptions& options = {});

}  // namespace sublimit
