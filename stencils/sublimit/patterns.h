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

#include "sublimit/limit/piece_types.h"

namespace sublimit {

/// Points of level k on a face, both ends of all sides included.
///
/// Quadrilaterals: (i, j) with i, j <= n = 2^k at the parameters (i, j) / n; triangles: i + j <= n. Rows by j, then i.
struct Lattice {
  Index n = 1;
  bool triangle = false;
  Index size() const { return triangle ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1); }
  Index row(Index i, Index j) const { return triangle ? j * (n + 1) - j * (j - 1) / 2 + i : j * (n + 1) + i; }
  int num_sides() const { return triangle ? 3 : 4; }
  /// The point s steps along side k, from its first corner.
  Index on_side(int k, Index s) const;
  /// Calls body(row) for all points inside.
  template <class Body>
  void for_each_inner(const Body& body) const {
    for (Index j = 1; j < n; ++j)
      for (Index i = 1; i < (triangle ? n - j : n); ++i) body(row(i, j));
  }
  /// Calls body({a, b, c, d} or {a, b, c, -1}), counter-clockwise, for all cells.
  template <class Body>
  void for_each_cell(const Body& body) const {
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < (triangle ? n - j : n); ++i) {
        if (!triangle) {
          body(std::array{row(i, j), row(i + 1, j), row(i + 1, j + 1), row(i, j + 1)});
          continue;
        }
        body(std::array{row(i, j), row(i + 1, j), row(i, j + 1), Index{-1}});
        if (i + j < n - 1) body(std::array{row(i + 1, j), row(i + 1, j + 1), row(i, j + 1), Index{-1}});
      }
  }
};

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
