// SPDX-License-Identifier: Apache-2.0
#pragma once
// Types of pieces. Pieces of the limit whose neighbourhoods have the same signature share a type, which
// provides their children with the blocks of S that make the children's points, their polynomial if there is
// one, and their limits at corners. Each is computed once, on first use.
#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>
#include <unordered_map>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/core/detail/signature_hash.h"
#include "sublimit/neighborhood/piece_walk.h"
#include "sublimit/neighborhood/repeated_block.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

class PieceType;
class PieceTypes;

/// A child of a type.
struct PieceLink {
  const PieceType* type = nullptr;
  PieceMap map;
  PieceBlock block;
  /// True if the child has its parent's type and orientation.
  bool repeats = false;
  /// True if no earlier child has the same first point.
  bool begins_new = false;
  RepeatedBlock repeated{block};  ///< powers of the block, for links that repeat
};

/// A type of piece. Threads may share it; it lives as long as its PieceTypes.
class PieceType {
 public:
  Piece::Kind kind() const { return kind_; }
  const PieceTypes& types() const { return *types_; }
  /// Returns the number of points that a piece of this type depends on.
  Index num_slots() const { return num_slots_; }
  /// True if a finite crease sharpness is involved. Sharpness sums then follow the vertex order of the first mesh seen.
  bool decays() const { return decays_; }
  /// A level that contains a piece of this type with its surroundings (its border is arbitrary), the piece in
  /// it, and the vertex of each slot.
  const Level& level() const { return surroundings().level; }
  const Piece& piece() const { return surroundings().piece; }
  std::span<const Index> slots() const { return surroundings().slots; }
  /// Returns the children, whether or not the piece is a polynomial.
  const std::deque<PieceLink>& children() const {
    return children_.get([this] { return found_children(); });
  }
  /// Corners of the children as rows of S over the own slots. They need no types of children.
  struct ChildCorners {
    std::vector<PieceMap> maps;  ///< map of each child
    RowMatrix rows;              ///< a row per corner, child by child, counter-clockwise
  };
  /// Returns the corners of the children as rows over the own slots; for quadrilaterals and triangles.
  ChildCorners child_corners() const;
  /// Returns the child that contains a place.
  const PieceLink& child(const PieceCoordinates& place) const;
  /// Returns the polynomial of the piece, or null if it is none.
  const PiecePolynomial* polynomial() const;
  /// Returns the polynomial if it has been computed already, else null.
  const PiecePolynomial* known_polynomial() const {
    return polynomial_state_.load(std::memory_order_acquire) == 2 ? &*candidate_ : nullptr;
  }

  /// Rows of the limit at a corner of a piece without polynomials. Corners count counter-clockwise from (0,0).
  struct CornerRows {
    RowMatrix rows;  ///< position; u and v; uu, uv and vv: as far as the limit is differentiable
    /// Differences of points whose limits on the piece are u and v, as columns; empty if not known.
    Eigen::MatrixXd linear;
    /// Returns the number of times that the limit is differentiable: 0, 1 or 2 (or more).
    int order() const { return rows.rows() == 6 ? 2 : rows.rows() == 3 ? 1 : 0; }
  };
  /// Returns the rows at a corner, over differences.
  /// @throws AnalysisError  no limit
  const CornerRows& corner(int corner) const {
    return corners_[corner].get([&] { return found_corner(corner); });
  }
  /// Returns the row of the position at a corner, over differences.
  /// @throws AnalysisError  no limit
  const Eigen::RowVectorXd& corner_limit(int corner) const {
    return corner_limits_[corner].get([&] { return found_corner_limit(corner); });
  }
  /// Returns how far the limit can leave the extent of the points, relative to it. 0 if no weight of the piece
  /// and its descendants is negative. Else an estimate, not a bound: twice the sum of negative weights at a
  /// corner of a child.
  double reach() const {
    return reach_.get([this] { return found_reach(); });
  }

 private:
  struct CornerPath;
  /// Derivatives of one degree at a corner where the same block D repeats and scales parameters. They are left
  /// eigenvectors of D for scale^-degree, normalised by their values on the right ones, whose limits are
  /// homogeneous polynomials.
  struct Modes {
    /// A row per derivative; a column per function, whose limit has one derivative 1 and the others 0.
    Eigen::MatrixXd derivatives, functions;
  };
  struct Surroundings {
    Level level;
    Piece piece;
    std::vector<Index> slots;  ///< vertex of each slot
  };
  /// Returns the surroundings, cut out of the level of the first piece of the type on first use. Most children
  /// never need theirs, since no requested place is in them.
  const Surroundings& surroundings() const {
    return surroundings_.get([this] { return found_surroundings(); });
  }
  Surroundings found_surroundings() const;
  std::deque<PieceLink> found_children() const;
  CornerRows found_corner(int corner) const;
  Eigen::RowVectorXd found_corner_limit(int corner) const;
  double found_reach() const;
  /// The surroundings after one period.
  struct Refined {
    std::vector<std::shared_ptr<const Level>> levels;  ///< levels of the period, without that of the surroundings
    std::vector<PieceChild> children;                  ///< children, on the last level
    std::vector<Index> slot_of;                        ///< slot of each vertex of the surroundings; -1: none
  };
  Refined refined() const;
  /// Returns the product of the S of one period; only rows of these vertices of the last level are sure to be
  /// filled.
  SparseMatrix rows_of(const Refined& refined, std::vector<Index> vertices) const;
  /// Returns rows of S, by vertex, as rows over the slots of the piece.
  /// @throws AnalysisError  a row uses points without a slot
  SparseMatrix rows_over_slots(const Refined& refined, const SparseMatrix& S, std::span<const Index> vertices) const;
  /// Returns the modes of a degree at a corner; nothing if the eigenvalue has another multiplicity than there
  /// are derivatives, or limits are no such polynomials.
  std::optional<Modes> modes(int corner, const Eigen::MatrixXd& D, double scale, int degree) const;
  /// True for an interior corner of irregular valence, where the limit has no natural parameters.
  bool is_extraordinary(int corner) const;
  /// True if no weight of the blocks of this type and of its descendants is negative.
  bool has_only_means() const;
  friend class PieceTypes;
  friend class PolynomialSearch;
  PieceTypes* types_ = nullptr;
  Piece::Kind kind_ = Piece::Kind::quad;
  int rings_ = 1;        // rings of faces around it that it depends on
  bool decays_ = false;  // finite sharpness: children have other types, and it is no polynomial
  bool apart_ = false;   // `PieceWalk::apart` of its walk
  Index num_slots_ = 0;
  /// The first piece of this type, until its surroundings are cut out.
  struct Met {
    std::shared_ptr<const Level> level;
    Piece piece;
    std::vector<Index> slots;
  };
  mutable Met met_;  // only used, then cleared, by `found_surroundings`
  ComputedOnce<Surroundings> surroundings_;
  ComputedOnce<std::deque<PieceLink>> children_;
  mutable std::atomic<int> polynomial_state_{0};  // 0: undecided, 1: none, 2: there is one
  // Used only by PolynomialSearch, of which one runs at a time.
  mutable std::optional<PiecePolynomial> candidate_;
  mutable bool has_candidate_ = false;
  std::array<ComputedOnce<Eigen::RowVectorXd>, 4> corner_limits_;
  std::array<ComputedOnce<CornerRows>, 4> corners_;
  mutable std::atomic<int> only_means_{0};  // 0: undecided, 1: no, 2: yes
  ComputedOnce<double> reach_;
};

/// The types of one scheme, shared between surfaces and threads.
class PieceTypes {
 public:
  /// @param max_types  number of types from which on surfaces store further types themselves
  explicit PieceTypes(const Scheme<double>& scheme, size_t max_types = size_t(1) << 16);
  ~PieceTypes();

  const Scheme<double>& scheme() const { return scheme_; }
  /// Returns the number of rings of faces that a piece depends on, between equal knot intervals (`piece_rings`).
  /// @throws AnalysisError  masks reach too far
  int rings(const Sharpness& sharpness) const;
  /// Returns the number of rings beyond these whose masks must be those of the mesh.
  int rings_beyond(const Level& level) const;
  /// Returns the number of rings of faces around a face that decide the limit at its corners.
  /// @throws AnalysisError  masks reach too far
  int rings_around_corner(const Level& level) const;
  /// Returns the number of types.
  size_t size() const;
  bool is_full() const { return size() >= max_types_; }
  /// Returns true if it is known that no piece is a polynomial; decided when the first regular piece is
  /// examined.
  bool has_no_polynomials() const { return has_none_.load(std::memory_order_relaxed); }
  /// Returns `sublimit::regular_smoothness` of the scheme, computed on first use.
  int regular_smoothness() const;

  /// Returns the type of a piece, which is made if it is new.
  /// @param walk  walk around the piece. It may belong to a walker of the calling thread, which executes no
  ///              other task during this call
  const PieceType* type(const Level& level, const Piece& piece, const PieceWalk& walk);
  /// Returns the type of a piece of a shared level. A new type keeps the level until its surroundings are
  /// needed, which saves cutting them out.
  const PieceType* type(const std::shared_ptr<const Level>& level, const Piece& piece, const PieceWalk& walk);
  /// Returns the type with this signature, or null.
  const PieceType* find(const std::vector<std::uint32_t>& signature) const;
  /// Returns about how many bytes the types and their blocks take.
  double memory() const { return memory_.load(std::memory_order_relaxed); }

 private:
  friend class PieceType;
  friend class PolynomialSearch;
  Scheme<double> scheme_;
  /// Counts memory that is about to be allocated for a type of `slots` points.
  /// @throws ResourceError  all types together would take more memory than there is
  void take(double bytes, Index slots);
  std::unique_ptr<PieceType> made(std::shared_ptr<const Level> level, const Piece& piece, const PieceWalk& walk);
  const PieceType* kept(const PieceWalk& walk, std::unique_ptr<PieceType> type);
  size_t max_types_;
  std::atomic<double> memory_{0};
  mutable std::shared_mutex mutex_;
  std::unordered_map<std::vector<std::uint32_t>, std::unique_ptr<PieceType>, SignatureHash> types_;
  mutable std::mutex polynomials_;          // one search at a time
  std::optional<PolynomialBasis> basis_;    // basis of the polynomial of the first regular piece
  bool halves_ = false, searched_ = false;  // regular pieces are cut along u = v; have been examined
  std::atomic<bool> has_none_{false};       // regular pieces are no polynomials
  ComputedOnce<int> smoothness_, rings_, rings_for_refinement_;
};

}  // namespace sublimit
