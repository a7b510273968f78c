// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a mesh to a table of its level k, without refining it.
#include "sublimit/pattern_table.h"
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

/// A table of level k with the faces that its points make.
///
/// Points stand face by face, in the order of the table: those inside a face, then those of its sides and corners that
/// no other face has already, then isolated vertices.
struct BakedLevel {
  PatternTable<double> table;
  BakeStatistics statistics;
  Level level;     ///< that has the patterns: 0, or 1
  int levels = 0;  ///< from there to level k
  LatticePoints points;
  /// Point of the table at a point of a face's lattice.
  std::int64_t point(Face face, Index row) const { return points.point(level.topology(), face, row); }
};

/// @param patterns  of the scheme; types that it does not know yet are added
/// @param levels    k, from 1 to 11
/// @throws InvalidParameter, InvalidMesh, UnsupportedTopology  as refinement does
BakedLevel bake_level(Patterns& patterns, const ControlMesh& mesh, int levels, const SubdivisionOptions& options = {});

}  // namespace sublimit
