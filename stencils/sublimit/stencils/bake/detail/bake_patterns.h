// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables by patterns: a face is a block and a list of control points.
#include <limits>
#include <optional>
#include <vector>

#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/face_owners.h"

namespace sublimit {

/// The face of a patch, by its number in the level that has the patterns, and what it has of its lattice.
struct PatchPlace {
  Index face = 0;
  std::int8_t turn = 0;  ///< the face's corner that is the lattice's first one
  LatticeRanks::Share share = 0;
  Index control_face = 0;  ///< the control level's face that it is of
};

/// Lattices of points on the faces of a part of a mesh: its own faces and those around them.
struct PartLattices {
  FaceLattices::Arrays arrays;       ///< without points and addresses
  std::vector<Index> control_faces;  ///< the control level's face that each is of
};

struct PatternBake {
  bool first_by_rows = false;                                   ///< level 1 is made by rows, and has the patterns
  double most_bytes = std::numeric_limits<double>::infinity();  ///< most bytes of blocks
  bool must_pay = false;                                        ///< rows are to be taken where they are made sooner
  bool only_count = false;  ///< the table stays empty; `statistics` tell what would be in it
  OwnerRule owners = OwnerRule::balanced;
  std::vector<std::int8_t>* turns = nullptr;  ///< gets the corner of each face that its lattice begins with
  /// For a part of a mesh: 1 for each face of the control level that is its own. Other faces get no points, and the
  /// table gets no lattices, since the positions of other parts' points are not known here.
  const std::vector<char>* owned = nullptr;
  std::vector<PatchPlace>* patches = nullptr;  ///< gets, of such a table, where the points of each patch lie
  PartLattices* lattices = nullptr;            ///< gets those of such a table
  Level* spent = nullptr;  ///< the control level, if nobody needs it afterwards: it goes before the table comes
};

/// A table by patterns, its `info` left empty.
/// @return  nothing where that is not possible, where blocks would be larger than they may, or where they do not pay
std::optional<Baked> bake_by_patterns(Patterns& patterns, const Level& control, const BakeRequest& request,
                                      const PatternBake& how = {});

/// Returns the piece at an address: a whole face, or the square at one of its corners. Whole quadrilaterals serve as
/// pieces of dual schemes too: each of their corners is a piece with limits, over the same points.
Piece piece_of(const Scheme<double>& scheme, const Topology& topology, const Addresses& addresses, Index address);

// Of levels where faces become faces, of levels of dual schemes, of grids and of lists.
std::optional<Baked> bake_lattices(Patterns& patterns, const Level& control, const BakeRequest& request,
                                   const PatternBake& how);
std::optional<Baked> bake_corners(Patterns& patterns, const Level& control, const BakeRequest& request,
                                  const PatternBake& how);
std::optional<Baked> bake_grids(Patterns& patterns, const Level& control, const BakeRequest& request,
                                const PatternBake& how);
std::optional<Baked> bake_places(Patterns& patterns, const Level& control, const BakeRequest& request,
                                 const PatternBake& how);

}  // namespace sublimit
