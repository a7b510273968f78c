// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patterns: what level k of a face is in terms of the points around it, by type of neighbourhood. A face's points at
// level k are those of its children at level k - 1, so a pattern is made of its children's and the blocks of S between
// them, and no mesh is refined:
//
//   R_k(type)  =  R_{k-1}(child type) * block     on the child's share of the face
#include <map>
#include <mutex>
#include <shared_mutex>

#include "sublimit/face_lattices.h"
#include "sublimit/limit/piece_types.h"

namespace sublimit {

/// A dictionary of the types of one scheme, shared between meshes and threads. It outlives them.
class Patterns {
 public:
  /// Whether faces of this scheme are cut into four of their own kind, level by level.
  static bool is_possible(const Scheme<double>& scheme);
  /// @throws InvalidParameter  `is_possible` says no
  explicit Patterns(const Scheme<double>& scheme);

  /// The type of a face's neighbourhood, the same for all rotations of it.
  struct Match {
    const PieceType* type = nullptr;
    int turn = 0;                 ///< the face's corner that is the type's first one
    std::vector<Index> vertices;  ///< points that it depends on
  };
  /// @param level  with faces of the scheme's size only
  Match match(const Level& level, Face face);

  /// Rows of `Lattice{2^levels}` over the points of a type: weights sum to one.
  const RowMatrix& rows(const PieceType& type, int levels);

  const Scheme<double>& scheme() const { return scheme_; }
  /// Types that faces have had, rotations not counted.
  size_t num_types() const;

 private:
  struct Turned {
    const PieceType* type;
    int turn;
  };
  RowMatrix made_rows(const PieceType& type, int levels);
  const RowMatrix& differences(const PieceType& type, int levels);
  Scheme<double> scheme_;
  PieceTypes types_;
  Piece::Kind kind_;
  mutable std::shared_mutex mutex_;
  std::unordered_map<std::vector<std::uint32_t>, Turned, SignatureHash> turned_;
  size_t num_types_ = 0;
  std::mutex rows_mutex_;
  std::map<std::pair<const PieceType*, int>, std::unique_ptr<const RowMatrix>> differences_, rows_;
};

}  // namespace sublimit
