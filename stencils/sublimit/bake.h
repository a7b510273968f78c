// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a mesh to a table of its level k, without refining it.
#include "sublimit/baked_table.h"
#include "sublimit/limit/address.h"
#include "sublimit/patterns.h"
#include "sublimit/refine.h"

namespace sublimit {

/// What became of the faces of a mesh.
struct BakeStatistics {
  Index faces = 0;   ///< that have patterns
  Index types = 0;   ///< of their neighbourhoods, rotations not counted
  Index blocks = 0;  ///< matrices in the table
  Index groups = 0;  ///< of patches that make the same rows of the same block
  std::int64_t points = 0;
  std::int64_t bytes = 0;      ///< of the table
  bool first_by_rows = false;  ///< level 1 is made by rows, and has the patterns
};

/// A table with what its making told.
///
/// Points of tables by patterns stand face by face, in the order of the table: those inside a face, then those of its
/// sides and corners that no other face has already, then isolated vertices.
struct Baked {
  BakedTable<double> table;
  BakeStatistics statistics;
};

/// What points a table is to make.
struct BakeRequest {
  TableRows rows = TableRows::level;
  int level = 0;                ///< k, of `level` (1 to 11) and `limit` (0 to 11)
  int grid = 0;                 ///< N, of `grid`, 2 to 2048
  std::vector<Sample> samples;  ///< of `samples`
  int derivatives = 0;          ///< of the limit: 0, 1 or 2
};

/// A table of any linear scheme: by patterns where the scheme has them, by rows elsewhere; `statistics` tells.
/// @param patterns  of the scheme; types that it does not know yet are added
/// @throws InvalidParameter     a request outside these ranges, derivatives of a level, a place outside its address
/// @throws InvalidMesh, UnsupportedTopology  as refinement does
/// @throws ResourceError        more points than memory, predicted before it is taken
Baked bake(Patterns& patterns, const ControlMesh& mesh, const BakeRequest& request,
           const SubdivisionOptions& options = {});

/// @param patterns  of the scheme; types that it does not know yet are added
/// @param levels    k, from 1 to 11
/// @throws InvalidParameter, InvalidMesh, UnsupportedTopology  as refinement does
Baked bake_level(Patterns& patterns, const ControlMesh& mesh, int levels, const SubdivisionOptions& options = {});

}  // namespace sublimit
