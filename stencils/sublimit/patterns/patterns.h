// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patterns: what level k of a face, or its limit, is in terms of the points around it, by type of neighbourhood. A
// face's points at level k are those of its children at level k - p, p the period of the scheme, so a pattern is made
// of its children's and the blocks of S between them, and no mesh is refined:
//
//   R_k(type)  =  R_{k-p}(child type) * block     on the child's share of the face
#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>

#include "sublimit/base/found_once.h"
#include "sublimit/face_lattices.h"
#include "sublimit/limit/limit_types.h"

namespace sublimit {

/// A type of neighbourhood, by what is known of it.
struct Pattern {
  size_t number = 0;  ///< in the order in which they were met
  Piece::Kind kind = Piece::Kind::quad;
  Index num_slots = 0;  ///< points that it depends on
  bool decays = false;  ///< some finite sharpness matters (`PieceType::decays`)
  size_t size = 0;      ///< of its signature: corners of faces around it, and what is said of them
  /// Null for one from a file, until more than the file has is asked for.
  mutable std::atomic<const PieceType*> type{nullptr};
};

/// A dictionary of the types of one scheme, shared between meshes and threads. It outlives them.
class Patterns {
 public:
  /// Whether faces of this scheme are cut into faces of their own kind, period by period. Dual ones make points of
  /// corners instead.
  static bool is_possible(const Scheme<double>& scheme) { return !scheme.is_dual(); }
  /// Points that a face has so many levels later.
  /// @param levels  a multiple of the scheme's period
  static Lattice lattice_of(const Scheme<double>& scheme, int levels);
  explicit Patterns(const Scheme<double>& scheme);

  /// The type of a piece's neighbourhood; that of a whole face is the same for all rotations of it.
  struct Match {
    const Pattern* pattern = nullptr;
    int turn = 0;                 ///< the face's corner that is the pattern's first one
    std::vector<Index> vertices;  ///< points that it depends on
    size_t size = 0;              ///< of the piece's own signature, whether its type is known or not
  };
  /// Made where it is new.
  /// @throws InvalidParameter  the level was made by another scheme, here and below
  Match match(const Level& level, const Piece& piece);
  /// The same if the type is known already.
  /// @param match  keeps its memory from call to call
  /// @return  whether it is
  /// @throws FormatError  a dictionary from a file that is not of this scheme
  bool find(const Level& level, const Piece& piece, Match& match) const;

  /// A piece that a pattern is of, for what is not known yet: as it lies, and how it is turned.
  struct Example {
    const Level& level;
    Piece piece;
    int turn = 0;
  };
  /// Over the points of a pattern: weights sum to one. Of a face rows of `lattice_of`; of a corner, from level 1 on,
  /// points that are its own: after one period its point and those of the border edges at it, later those of all
  /// corners at these, child after child in the order of `children` (piece.h).
  const RowMatrix& rows(const Pattern& pattern, const Example& example, int levels);
  /// How many there are of a corner.
  std::int64_t num_corner_rows(const Pattern& pattern, const Example& example, int levels);
  /// The same rows if they have been asked for before, else null.
  const RowMatrix* known_rows(const Pattern& pattern, int levels) const;
  /// The same of the points' limits.
  const RowMatrix& limit_rows(const Pattern& pattern, const Example& example, int levels);

  /// Limits with derivatives along u and v of the address that a lattice lies in.
  struct LimitBlock {
    RowMatrix weights;  ///< quantity after quantity (1, 3 or 6), a row a point each; what does not exist is zero
    std::vector<std::uint8_t> status;  ///< `point_status` of each point, but for holes
  };
  struct LimitRequest {
    Lattice lattice;
    LatticePlace place;       ///< turn and quarter matter
    bool by_address = false;  ///< points in the order of the address, else of the lattice
    int derivatives = 0;
  };
  /// @return  null where limit masks reach beyond the points of the pattern
  const LimitBlock* limit_block(const Pattern& pattern, const Example& example, const LimitRequest& request);

  /// The same at any places, (u, v) of an address; not kept.
  /// @param place  where the pattern lies in the address: turn and quarter matter
  std::optional<LimitBlock> limits_at(const Pattern& pattern, const Example& example, const LatticePlace& place,
                                      std::span<const AddressParameters> parameters, int derivatives);

  const Scheme<double>& scheme() const { return scheme_; }
  /// The control level of a mesh under this scheme, which is not compared with it again.
  /// @throws as `sublimit::control_level`
  Level control_level(const ControlMesh& mesh, const SubdivisionOptions& options = {}) const;
  const std::shared_ptr<LimitTypes>& types() const { return types_; }
  /// Types that faces have had, rotations not counted.
  size_t num_types() const;
  /// Matrices of rows and blocks of limits that have been made or read.
  size_t num_matrices() const;

  /// What the corners of the last level are.
  enum class Ends { points, limits };
  /// All that is known of a pattern, as files keep it.
  struct Stored {
    Piece::Kind kind = Piece::Kind::quad;
    Index num_slots = 0;
    bool decays = false;
    struct Signature {
      int turn = 0;
      std::vector<std::uint32_t> words;
    };
    std::vector<Signature> signatures;  ///< of pieces that are turned so
    struct Rows {
      int levels = 0;
      Ends ends = Ends::points;
      RowMatrix weights;
    };
    std::vector<Rows> rows;
    struct Limits {
      LimitRequest request;
      LimitBlock block;
    };
    std::vector<Limits> limits;
  };
  std::vector<Stored> stored() const;
  /// Adds what was stored; what is known already stays.
  void add(Stored stored);

 private:
  struct Turned {
    const Pattern* pattern = nullptr;
    int turn = 0;
  };
  const PieceType& type(const Pattern& pattern, const Example& example);
  RowMatrix made_rows(const PieceType& type, int levels, Ends ends);
  RowMatrix made_corner_rows(const PieceType& type, int levels, Ends ends);
  const RowMatrix& differences(const PieceType& type, int levels, Ends ends);
  const RowMatrix& whole_rows(const Pattern& pattern, const Example& example, int levels, Ends ends);
  Pattern& add_pattern(Piece::Kind kind, Index num_slots, bool decays);
  Scheme<double> scheme_;
  std::shared_ptr<LimitTypes> types_;
  mutable std::shared_mutex mutex_;  // of the patterns and their signatures
  std::deque<Pattern> patterns_;
  std::unordered_map<std::vector<std::uint32_t>, Turned, SignatureHash> turned_;
  /// Rows of fewer levels are found while those of more are.
  FoundByKey<std::tuple<const PieceType*, int, Ends>, RowMatrix> differences_;
  /// By number of the pattern, levels, ends.
  FoundByKey<std::tuple<size_t, int, Ends>, RowMatrix> rows_;
  /// By number of the pattern, cells a side, turn, quarter, order of points, derivatives.
  using LimitKey = std::tuple<size_t, std::int32_t, int, int, bool, int>;
  FoundByKey<LimitKey, std::optional<LimitBlock>> limits_;
};

}  // namespace sublimit
