// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patterns: weights of level k of a face, or of its limit, over the points around the face, by type of neighbourhood.
// The points of a face at level k are those of its children at level k - p, where p is the period of the scheme. A
// pattern is therefore computed from those of its children and the blocks of S between them, without refining a mesh:
//
//   R_k(type)  =  R_{k-p}(child type) * block     on the child's share of the face
#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/eval/table/face_lattices.h"
#include "sublimit/limit/detail/limit_cache.h"

namespace sublimit {

/// A type of neighbourhood.
struct Pattern {
  size_t number = 0;  ///< number in the order of first occurrence
  Piece::Kind kind = Piece::Kind::quad;
  Index num_slots = 0;  ///< points that it depends on
  bool decays = false;  ///< true if a finite sharpness is involved (`PieceType::decays`)
  size_t size = 0;      ///< words of its signature: corners of faces around it, with their tags
  /// The type; null for a pattern from a file, until rows that the file does not have are needed.
  mutable std::atomic<const PieceType*> type{nullptr};
};

/// A dictionary of the types of one scheme. Any number of meshes and threads may share it.
class Patterns {
 public:
  /// Returns true if each period of the scheme splits faces into faces of the same kind. Dual schemes make points for
  /// corners of faces instead.
  static bool is_possible(const Scheme<double>& scheme) { return !scheme.is_dual(); }
  /// Returns the lattice of the points on a face after `levels` levels.
  /// @param levels  a multiple of the scheme's period
  static Lattice lattice_of(const Scheme<double>& scheme, int levels);
  explicit Patterns(const Scheme<double>& scheme);

  /// The type of a piece's neighbourhood. Neighbourhoods that differ by a rotation of the face have the same
  /// type.
  struct Match {
    const Pattern* pattern = nullptr;
    int turn = 0;                 ///< corner of the face where the pattern starts
    std::vector<Index> vertices;  ///< points that it depends on
    size_t size = 0;              ///< words of the piece's signature; set even if its type is not in the dictionary
  };
  /// Returns the type of a piece, which is added if it is new.
  /// @throws InvalidParameter  the level was made by another scheme, here and below
  Match match(const Level& level, const Piece& piece);
  /// Finds the type of a piece if the dictionary has it, and returns true if so.
  /// @param match  the result; its memory is reused
  /// @throws FormatError  the dictionary is from a file of another scheme
  bool find(const Level& level, const Piece& piece, Match& match) const;

  /// A piece with a pattern, from which missing weights are computed.
  struct Example {
    const Level& level;
    Piece piece;
    int turn = 0;
  };
  /// Returns the weights of points of a level over the points of a pattern; each row sums to one. For a face they are
  /// the points of `lattice_of`. For a corner, from level 1 on, they are its own points: after one period its point and
  /// those of the border edges at it, later those of all corners at these, child by child in the order of `children`
  /// (piece.h).
  const RowMatrix& rows(const Pattern& pattern, const Example& example, int levels);
  /// Returns the number of such rows of a corner.
  std::int64_t num_corner_rows(const Pattern& pattern, const Example& example, int levels);
  /// Returns `rows` if they have been computed, else null.
  const RowMatrix* known_rows(const Pattern& pattern, int levels) const;
  /// Returns the weights of the limits of the points of `rows`.
  const RowMatrix& limit_rows(const Pattern& pattern, const Example& example, int levels);

  /// Limits with derivatives along u and v of the address that a lattice lies in.
  struct LimitBlock {
    RowMatrix weights;  ///< quantity by quantity (1, 3 or 6), a row for each point; zero where it does not exist
    std::vector<std::uint8_t> status;  ///< `point_status` of each point, holes not considered
  };
  /// Points of a block of limits.
  struct LimitRequest {
    Lattice lattice;
    LatticePlace place;       ///< only its turn and quarter are used
    bool by_address = false;  ///< true: points are in the order of the address; false: of the lattice
    int derivatives = 0;
  };
  /// Returns limits of the points of a lattice; null if limit masks reach beyond the points of the pattern.
  const LimitBlock* limit_block(const Pattern& pattern, const Example& example, const LimitRequest& request);

  /// Returns limits at any parameters (u, v) of an address, which are not cached; absent if limit masks reach beyond
  /// the points of the pattern.
  /// @param place  position of the pattern in the address; only its turn and quarter are used
  std::optional<LimitBlock> limits_at(const Pattern& pattern, const Example& example, const LatticePlace& place,
                                      std::span<const AddressParameters> parameters, int derivatives);

  const Scheme<double>& scheme() const { return scheme_; }
  /// Returns the control level of a mesh under this scheme; such levels are not checked again.
  /// @throws as `sublimit::control_level`
  Level control_level(const Mesh& mesh, const SubdivisionOptions& options = {}) const;
  const std::shared_ptr<LimitCache>& types() const { return types_; }
  /// Returns the number of types in the dictionary, rotations not counted.
  size_t num_types() const;
  /// Returns the number of matrices of rows and blocks of limits that were computed or read.
  size_t num_matrices() const;

  /// Kind of the last points of `rows` and `limit_rows`: points of the level, or their limits.
  enum class Ends { points, limits };
  /// Data of a pattern in a file.
  struct Stored {
    Piece::Kind kind = Piece::Kind::quad;
    Index num_slots = 0;
    bool decays = false;
    struct Signature {
      int turn = 0;
      std::vector<std::uint32_t> words;
    };
    std::vector<Signature> signatures;  ///< signatures of pieces, with their rotation
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
  /// Returns the data of all patterns.
  std::vector<Stored> stored() const;
  /// Adds the data of a pattern; data that exists already is kept.
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
  std::shared_ptr<LimitCache> types_;
  mutable std::shared_mutex mutex_;  // of the patterns and their signatures
  std::deque<Pattern> patterns_;
  std::unordered_map<std::vector<std::uint32_t>, Turned, SignatureHash> by_signature_;
  /// Rows without their first column, which is 1 minus the sum of the others. Rows of many levels are computed
  /// from those of fewer levels. Key: type, levels, ends.
  FoundByKey<std::tuple<const PieceType*, int, Ends>, RowMatrix> differences_;
  /// Key: number of the pattern, levels, ends.
  FoundByKey<std::tuple<size_t, int, Ends>, RowMatrix> rows_;
  /// Number of the pattern, cells a side, turn, quarter, order of points, derivatives.
  using LimitKey = std::tuple<size_t, std::int32_t, int, int, bool, int>;
  FoundByKey<LimitKey, std::optional<LimitBlock>> limits_;
};

}  // namespace sublimit
