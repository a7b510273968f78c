// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables by patterns: each face has a block of weights, which faces with equal neighbourhoods share, and a list
// of control points.
#include <limits>
#include <optional>
#include <vector>

#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/face_owners.h"

namespace sublimit {

/// The face of a patch, numbered in the level that has the patterns, and the points of its lattice that it
/// owns.
struct PatchPlace {
  Index face = 0;
  std::int8_t turn = 0;  ///< corner of the face where its lattice starts
  LatticeRanks::Share share = 0;
  Index control_face = 0;  ///< face of the control level that it is part of
};

/// Lattices of points on the faces of a part of a mesh, both owned ones and those around them.
struct PartLattices {
  FaceLattices::Arrays arrays;       ///< without points and addresses
  std::vector<Index> control_faces;  ///< face of the control level for each lattice
};

/// Options of bakes by patterns.
struct PatternBake {
  bool first_by_rows = false;                                   ///< make level 1 by rows, and use patterns on it
  double most_bytes = std::numeric_limits<double>::infinity();  ///< most bytes of blocks
  bool must_pay = false;                                        ///< give up if rows would be faster to make
  bool only_count = false;                                      ///< set `statistics` only; the table stays empty
  OwnerRule owners = OwnerRule::balanced;
  std::vector<std::int8_t>* turns = nullptr;  ///< set to the corner where the lattice of each face starts
  /// For a part of a mesh: for each face of the control level, 1 if the part owns it. Other faces get no
  /// points, and the table gets no lattices, since the numbers of the points of other parts are not known here.
  const std::vector<char>* owned = nullptr;
  std::vector<PatchPlace>* patches = nullptr;  ///< for parts: set to the places of the patches' points
  PartLattices* lattices = nullptr;            ///< for parts: set to their lattices
  Level* spent = nullptr;                      ///< the control level if it may be emptied, to save memory
};

/// Bakes a table by patterns, without `info`.
/// @return  absent if patterns are not possible, if blocks exceed `most_bytes`, or if rows are faster and
///          `must_pay`
std::optional<Baked> bake_by_patterns(Patterns& patterns, const Level& control, const BakeRequest& request,
                                      const PatternBake& how = {});

/// Returns the piece at an address: a whole face, or the square at one of its corners. Whole quadrilaterals serve as
/// pieces of dual schemes too: each of their corners is a piece with limits, over the same points.
Piece piece_of(const Scheme<double>& scheme, const Topology& topology, const Addresses& addresses, Index address);

// The cases of `bake_by_patterns`: levels of schemes that split faces into faces, levels of dual schemes,
// grids, lists of places.
std::optional<Baked> bake_lattices(Patterns& patterns, const Level& control, const BakeRequest& request,
                                   const PatternBake& how);
std::optional<Baked> bake_corners(Patterns& patterns, const Level& control, const BakeRequest& request,
                                  const PatternBake& how);
std::optional<Baked> bake_grids(Patterns& patterns, const Level& control, const BakeRequest& request,
                                const PatternBake& how);
std::optional<Baked> bake_places(Patterns& patterns, const Level& control, const BakeRequest& request,
                                 const PatternBake& how);

}  // namespace sublimit
