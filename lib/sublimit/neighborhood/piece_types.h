// SPDX-License-Identifier: Apache-2.0
#pragma once
// Types of pieces: what a piece of the limit is by its neighbourhood alone. A type knows its children and the block of
// S that makes their points, or the polynomial that it is. Each is computed when it is first needed, once.
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

struct PieceLink {
  const PieceType* type = nullptr;
  PieceMap map;
  PieceBlock block;
  /// True if the child has its parent's type and orientation.
  bool repeats = false;
  /// No child before it begins at the same point.
  bool begins_new = false;
  RepeatedBlock repeated{block};
};

class PieceType {
 public:
  Piece::Kind kind() const { return kind_; }
  const PieceTypes& types() const { return *types_; }
  /// Points that it depends on.
  Index num_slots() const { return num_slots_; }
  /// True if a finite crease sharpness is involved. Sharpness sums then follow the vertex order of the first mesh seen.
  bool decays() const { return decays_; }
  /// The piece among the points around it, the rim of which means nothing, and the vertices that are its slots.
  const Level& level() const { return surroundings().level; }
  const Piece& piece() const { return surroundings().piece; }
  std::span<const Index> slots() const { return surroundings().slots; }
  /// Its children, whether or not it is a polynomial.
  const std::deque<PieceLink>& children() const {
    return children_.get([this] { return found_children(); });
  }
  /// Corners of its children over its own slots, child after child and counter-clockwise: rows of S, without looking at
  /// what types the children are.
  struct ChildCorners {
    std::vector<PieceMap> maps;  ///< of the children
    RowMatrix rows;              ///< as many a child as it has corners
  };
  /// Returns the corners of the children as rows over the own slots; for quadrilaterals and triangles.
  ChildCorners child_corners() const;
  /// The child that a place is in.
  const PieceLink& child(const PieceCoordinates& place) const;
  /// Null where it is no polynomial.
  const PiecePolynomial* polynomial() const;
  /// Returns the polynomial if it has been computed already, else null.
  const PiecePolynomial* known_polynomial() const {
    return polynomial_state_.load(std::memory_order_acquire) == 2 ? &*candidate_ : nullptr;
  }

  /// Rows of the limit at a corner without polynomials. Corners count counter-clockwise from (0,0).
  struct CornerRows {
    RowMatrix rows;  ///< the position, then u and v, then uu, uv and vv, as often as the limit is differentiable
    /// Differences of points whose limits are u and v on all of the piece, by columns; none where these are not known.
    Eigen::MatrixXd linear;
    int order() const { return rows.rows() == 6 ? 2 : rows.rows() == 3 ? 1 : 0; }
  };
  /// @throws AnalysisError  no limit
  const CornerRows& corner(int corner) const {
    return corners_[corner].get([&] { return found_corner(corner); });
  }
  const Eigen::RowVectorXd& corner_limit(int corner) const {
    return corner_limits_[corner].get([&] { return found_corner_limit(corner); });
  }
  /// How far the limit leaves the points, relative to their extent: 0 where no weight of its refinement is negative,
  /// now or later; else as seen at the corners of its children, and doubled for what lies between.
  double reach() const {
    return reach_.get([this] { return found_reach(); });
  }

 private:
  struct CornerPath;
  /// Where blocks D to a corner repeat and scale, derivatives are left eigenvectors of scale^-degree: by their values
  /// on the right ones, whose limits are homogeneous polynomials.
  struct Modes {
    Eigen::MatrixXd derivatives, functions;  ///< by rows; by columns, those whose only derivative is 1
  };
  struct Surroundings {
    Level level;
    Piece piece;
    std::vector<Index> slots;  ///< vertex of each
  };
  /// Taken out of the level that the type was met in when first needed: most children lie beside the ways to places.
  const Surroundings& surroundings() const {
    return surroundings_.get([this] { return found_surroundings(); });
  }
  Surroundings found_surroundings() const;
  std::deque<PieceLink> found_children() const;
  CornerRows found_corner(int corner) const;
  Eigen::RowVectorXd found_corner_limit(int corner) const;
  double found_reach() const;
  /// The level after its own, and the children on it.
  struct Refined {
    std::vector<std::shared_ptr<const Level>> levels;  ///< of one period
    std::vector<PieceChild> children;
    std::vector<Index> slot_of;  ///< of its own vertices, -1 beyond
  };
  Refined refined() const;
  /// S from its own level to the last one: the rows of these vertices, and perhaps others.
  SparseMatrix rows_of(const Refined& refined, std::vector<Index> vertices) const;
  /// Returns the rows over the slots of the piece.
  SparseMatrix rows_over_slots(const Refined& refined, const SparseMatrix& S, std::span<const Index> vertices) const;
  /// Nothing where the limits are not so.
  std::optional<Modes> modes(int corner, const Eigen::MatrixXd& D, double scale, int degree) const;
  /// Inside, of another valence than regular meshes have: no parameter is natural there.
  bool is_extraordinary(int corner) const;
  /// No weight of its block is negative, nor of any descendant's.
  bool has_only_means() const;
  friend class PieceTypes;
  friend class PolynomialSearch;
  PieceTypes* types_ = nullptr;
  Piece::Kind kind_ = Piece::Kind::quad;
  int rings_ = 1;        // of faces around it that it depends on
  bool decays_ = false;  // finite sharpness: its children are others, and it is no polynomial
  bool apart_ = false;   // around it are the sheets that its walk has met
  Index num_slots_ = 0;
  /// Where the type was met first, until its surroundings are taken out.
  struct Met {
    std::shared_ptr<const Level> level;
    Piece piece;
    std::vector<Index> slots;
  };
  mutable Met met_;  // read and dropped by `found_surroundings` alone
  FoundOnce<Surroundings> surroundings_;
  FoundOnce<std::deque<PieceLink>> children_;
  mutable std::atomic<int> polynomial_state_{0};  // 0: not known, 1: none, 2: there is one
  // By the search alone, of which there is one at a time.
  mutable std::optional<PiecePolynomial> candidate_;
  mutable bool has_candidate_ = false;
  std::array<FoundOnce<Eigen::RowVectorXd>, 4> corner_limits_;
  std::array<FoundOnce<CornerRows>, 4> corners_;
  mutable std::atomic<int> only_means_{0};  // 0: not known, 1: no, 2: yes
  FoundOnce<double> reach_;
};

/// The types of one scheme, shared between surfaces and threads.
class PieceTypes {
 public:
  /// @param max_types  a surface that needs more, when there are so many, keeps them for itself
  explicit PieceTypes(const Scheme<double>& scheme, size_t max_types = size_t(1) << 16);
  ~PieceTypes();

  const Scheme<double>& scheme() const { return scheme_; }
  /// Rings of faces around a piece that it depends on, where intervals between knots are equal.
  int rings(const Sharpness& sharpness) const;
  size_t size() const;
  bool is_full() const { return size() >= max_types_; }
  /// No piece is a polynomial, as is known once a regular one has been looked at.
  bool has_no_polynomials() const { return has_none_.load(std::memory_order_relaxed); }
  /// `sublimit::regular_smoothness` of the scheme, found when it is first asked for.
  int regular_smoothness() const;

  /// Returns the type of a piece, which is made if it is new.
  /// @param walk  of the piece; a walker of the calling thread may keep it, for this thread takes up no other work in
  ///              here
  const PieceType* type(const Level& level, const Piece& piece, const PieceWalk& walk);
  /// Returns the type of a piece of a shared level, which the type may keep until it looks at its surroundings.
  const PieceType* type(const std::shared_ptr<const Level>& level, const Piece& piece, const PieceWalk& walk);
  /// Returns the type with this signature, or null.
  const PieceType* find(const std::vector<std::uint32_t>& signature) const;
  /// Returns about how many bytes the types and their blocks take.
  double memory() const { return memory_.load(std::memory_order_relaxed); }

 private:
  friend class PieceType;
  friend class PolynomialSearch;
  Scheme<double> scheme_;
  /// Counts what will be taken for a type of so many points, before it is.
  /// @throws ResourceError  all types together take more than there is
  void take(double bytes, Index slots);
  std::unique_ptr<PieceType> made(std::shared_ptr<const Level> level, const Piece& piece, const PieceWalk& walk);
  const PieceType* kept(const PieceWalk& walk, std::unique_ptr<PieceType> type);
  size_t max_types_;
  std::atomic<double> memory_{0};
  mutable std::shared_mutex mutex_;
  std::unordered_map<std::vector<std::uint32_t>, std::unique_ptr<PieceType>, SignatureHash> types_;
  mutable std::mutex polynomials_;          // one search at a time
  std::optional<PolynomialBasis> basis_;    // of the first regular piece's polynomial
  bool halves_ = false, searched_ = false;  // regular pieces are cut along u = v; have been looked at
  std::atomic<bool> has_none_{false};       // regular pieces are no polynomials
  FoundOnce<int> smoothness_;
};

/// True if a place is where polynomials meet: on a side of its piece, or on the line that cuts the piece in two.
/// @param dual  pieces are corners of faces, whose polynomials go on beyond the corner's own sides
inline bool is_on_knot(const PieceCoordinates& p, bool triangle, bool dual, bool halves) {
  if (triangle) return p.u == 0 || p.v == 0 || p.u1 == 0;
  return p.u1 == 0 || p.v1 == 0 || (!dual && (p.u == 0 || p.v == 0)) || (halves && p.u == p.v);
}

/// Derivative rows of a child become those of its parent.
void apply_chain(const PieceMap::Chain& chain, RowMatrix& rows);

/// Rotates tangent rows as the chain of maps rotates u and v; both may be scaled by a common factor.
void turn_tangents(const PieceMap::Chain& chain, RowMatrix& tangents);

/// Rows of a place over the slots of a piece, in differences.
struct PieceRows {
  RowMatrix rows;          ///< position, then u, v, then uu, uv, vv
  RowMatrix tangents;      ///< of order >= 1: two rows along the tangent plane, u and v but for factors that cancel
  int order = 0;           ///< derivatives that exist: 0, 1 or 2
  bool at_corner = false;  ///< a corner where there is no polynomial: tangents come from elsewhere
  bool on_knot = false;    ///< where polynomials of low smoothness meet
};
/// @param search  whether to find out if pieces are polynomials; else only what is known is used
PieceRows piece_rows(const PieceType& type, PieceCoordinates place, int order, bool search = true);

}  // namespace sublimit
