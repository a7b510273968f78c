// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patterns: what level k of a face, or its limit, is in terms of the points around it, by type of neighbourhood. A
// face's points at level k are those of its children at level k - 1, so a pattern is made of its children's and the
// blocks of S between them, and no mesh is refined:
//
//   R_k(type)  =  R_{k-1}(child type) * block     on the child's share of the face
#include <map>
#include <mutex>
#include <optional>
#include <shared_mutex>

#include "sublimit/face_lattices.h"
#include "sublimit/limit/piece_types.h"

namespace sublimit {

/// A dictionary of the types of one scheme, shared between meshes and threads. It outlives them.
class Patterns {
 public:
  /// Whether faces of this scheme are cut into four of their own kind, level by level.
  static bool is_possible(const Scheme<double>& scheme);
  explicit Patterns(const Scheme<double>& scheme);

  /// The type of a piece's neighbourhood; that of a whole face is the same for all rotations of it.
  struct Match {
    const PieceType* type = nullptr;
    int turn = 0;                 ///< the face's corner that is the type's first one
    std::vector<Index> vertices;  ///< points that it depends on
  };
  Match match(const Level& level, const Piece& piece);
  /// The same if the type is known already.
  /// @param match  keeps its memory from call to call
  bool find(const Level& level, const Piece& piece, Match& match) const;

  /// Rows of `Lattice{2^levels}` over the points of a type: weights sum to one.
  const RowMatrix& rows(const PieceType& type, int levels);
  /// The same of the points' limits.
  const RowMatrix& limit_rows(const PieceType& type, int levels);

  /// Limits with derivatives along u and v of the address that a lattice lies in.
  struct LimitBlock {
    RowMatrix weights;  ///< quantity after quantity (1, 3 or 6), a row a point each; what does not exist is zero
    std::vector<std::uint8_t> status;  ///< LimitStatus of each point, but for holes
  };
  /// @param place  turn and quarter matter; `by_address`: points in the order of the address, else of the lattice
  /// @return  null where limit masks reach beyond the points of the type
  const LimitBlock* limit_block(const PieceType& type, const Lattice& lattice, const LatticePlace& place,
                                bool by_address, int derivatives);

  const Scheme<double>& scheme() const { return scheme_; }
  const std::shared_ptr<PieceTypes>& types() const { return types_; }
  /// Types that faces have had, rotations not counted.
  size_t num_types() const;

 private:
  struct Turned {
    const PieceType* type = nullptr;
    int turn = 0;
  };
  enum class Ends { points, limits };  // what the corners of the last level are
  RowMatrix made_rows(const PieceType& type, int levels, Ends ends);
  const RowMatrix& differences(const PieceType& type, int levels, Ends ends);
  const RowMatrix& whole_rows(const PieceType& type, int levels, Ends ends);
  Scheme<double> scheme_;
  std::shared_ptr<PieceTypes> types_;
  mutable std::shared_mutex mutex_;
  std::unordered_map<std::vector<std::uint32_t>, Turned, SignatureHash> turned_;
  size_t num_types_ = 0;
  std::mutex rows_mutex_;
  using RowsKey = std::tuple<const PieceType*, int, Ends>;
  std::map<RowsKey, std::unique_ptr<const RowMatrix>> differences_, rows_;
  /// Type, cells a side, turn, quarter, order of points, derivatives.
  using LimitKey = std::tuple<const PieceType*, std::int32_t, int, int, bool, int>;
  std::map<LimitKey, std::unique_ptr<const LimitBlock>> limits_;
};

}  // namespace sublimit
