// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a limit surface consists of: from addresses to pieces of a level, and their types.
#include <optional>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/limit/detail/corner_limits.h"
#include "sublimit/limit/detail/patch_tree.h"
#include "sublimit/limit/limit_map.h"
#include "sublimit/neighborhood/regular_faces.h"

namespace sublimit {

/// True if the cross product of two tangents is a normal without a closer look (`normal_of`).
/// @param cross2    square of its length
/// @param tangents2  product of the squares of theirs
inline bool is_sound_normal(double cross2, double tangents2) {
  return cross2 > 1e-12 * tangents2 && tangents2 > 1e-280 && tangents2 < 1e280;
}

/// From the square of a quadrilateral to the quarter at one corner, (0, 0) there.
const PieceMap& quarter_map(int corner);

struct LimitMap::Parts {
  using Kind = Piece::Kind;
  Scheme<double> scheme;  ///< without preparation
  Level level;
  /// The level that has the pieces, where a preparation comes first (its S is over the vertices of `level`).
  std::optional<Level> prepared;
  const Level& base() const { return prepared ? *prepared : level; }
  Addresses addresses;
  std::shared_ptr<LimitCache> types;
  CornerLimits corners;

  Parts(const Scheme<double>& scheme, Level level, std::shared_ptr<LimitCache> shared);

  /// A piece, the place in it, and how the parameters of the address become those of the piece.
  struct Target {
    Piece piece;
    PieceCoordinates place;
    const PieceMap* map = nullptr;  ///< null: they are the same
    PieceCoordinates outer = {};    ///< in the address, if there is a map
  };
  Target target(const Place& sample) const;
  bool is_inside(const Place& s) const { return sublimit::is_inside(addresses, s); }
  bool cuts(HalfEdge h) const {
    return is_cut(base().topology(), base().sharpness, h) || types->pieces().regular_smoothness() == 0;
  }
  /// True if the tail of h is on a crease, border or corner, which the faces at h need not be beside.
  bool is_on_cut(HalfEdge h) const;
  /// Returns the sides and corners of a piece at which the surface is cut: bit k for side k, from corner k on, bit 5 +
  /// k for corner k; `hole` for a piece in a hole.
  unsigned sides(const Piece& piece) const;
  static constexpr unsigned hole = 16, first_corner = 32;
  /// Sides and corners that a place is on, as these bits.
  static unsigned sides_at(const PieceCoordinates& p, bool triangle) {
    const unsigned sides = (p.v == 0 ? 1u : 0u) | (p.u1 == 0 ? 2u : 0u) |
                           ((triangle ? p.u == 0 : p.v1 == 0) ? 4u : 0u) | (!triangle && p.u == 0 ? 8u : 0u);
    const unsigned before = (sides << 1 | sides >> (triangle ? 2 : 3)) & (triangle ? 7u : 15u);
    return sides | (sides & before) * first_corner;
  }
  /// The corner of a face of the level that a place is at, or its middle, or that of a border edge of dual schemes.
  std::optional<Centre> centre(const Target& target) const;

  const PieceType* type_of(const Piece& piece, std::vector<Index>& vertices) const;
  /// Stencil and status of a place, over the vertices of its piece.
  struct Found {
    std::vector<Index> vertices;
    PieceRows rows;       ///< in differences, by the parameters of the address
    SparseRows tangents;  ///< by masks, where the piece has none: over vertices
    LimitStatus status = LimitStatus::regular;
  };
  struct Pieces;
  /// Rows of the last place, by its type. If many faces have the same type, a caller that evaluates the same place on
  /// one face after the other has them computed once. At a vertex of hundreds of faces they cost as much as a small
  /// mesh.
  struct KnownRows {
    const Pieces* pieces = nullptr;  ///< of the surface, once they have been found
    const PieceType* type = nullptr;
    PieceCoordinates place = {};
    int order = 0;
    PieceRows rows = {};
    std::optional<RowMatrix> on_side = {};  ///< `tangents_on_side`, once they have been asked for
    std::int64_t made = 0;                  ///< how often rows were not known
  };
  /// @throws NoLimit  naming the face of the mesh
  Found find(const Target& at, int order) const;
  /// @param known  and its pieces: no walk is made then
  Found find(const Place& sample, int order, KnownRows* known = nullptr) const;
  /// Tangents on a side where the limit has no derivatives by u and v, though there is a tangent plane; none if there
  /// are none inside either.
  RowMatrix tangents_on_side(const PieceType& type, const PieceCoordinates& place) const;
  /// Finds what there is at a place whose type is known.
  /// @param vertices  its points, by slot
  Found find(const Target& at, int order, const PieceType& type, std::vector<Index> vertices,
             KnownRows* known = nullptr) const;
  LimitStencil stencil(Found found) const;
  /// Row i of `out`, by its stencil.
  void evaluate_row(const Points& points, const Place& sample, int order, bool normals, LimitSamples& out,
                    std::int64_t i, KnownRows* known = nullptr) const;

  /// By the tangents, then by what the next terms add to degenerate ones; zero if they do not settle it.
  /// @param local  the points of the stencil
  Eigen::Vector3d normal_of(const LimitStencil& stencil, const Points& local, const Place& sample,
                            const Points& points) const;

  /// Types and points of all pieces, once they are asked for. Pieces are numbered like addresses, or, where they are
  /// corners of faces, like half-edges.
  struct Pieces {
    std::vector<const PieceType*> types;
    std::vector<std::int64_t> first;  ///< into `vertices`, and the end
    std::vector<Index> vertices;
    std::vector<const PatchTree*> trees;
    std::unordered_map<const PieceType*, std::unique_ptr<const PatchTree>> tree_of;

    /// Rows of `x`, by the slots of a piece's type.
    Points points_of(Index piece, const Points& x) const {
      const std::int64_t begin = first[size_t(piece)];
      Points local(first[size_t(piece) + 1] - begin, x.cols());
      for (Eigen::Index j = 0; j < local.rows(); ++j) local.row(j) = x.row(vertices[size_t(begin + j)]);
      return local;
    }
  };
  const Pieces& pieces() const;
  Index num_pieces() const {
    return prepared           ? prepared->topology().num_faces()
           : scheme.is_dual() ? level.topology().num_half_edges()
                              : addresses.size();
  }
  Piece piece(Index number) const;
  Index number(const Place& sample, const Target& target) const {
    return prepared           ? index(prepared->topology().face(target.piece.start))
           : scheme.is_dual() ? index(target.piece.start)
                              : sample.face;
  }

 private:
  /// Fast path for places without special cases. Returns false, and leaves `out` unchanged, if the general path is
  /// needed.
  bool evaluate_plain_row(const Points& points, const Found& found, int order, bool normals, LimitSamples& out,
                          std::int64_t i) const;
  Pieces found_pieces() const;
  /// Faces that need no walk, and the type that all of them have; null where the scheme looks further, or walks find
  /// the points in another order.
  struct Regular {
    std::optional<RegularFaces> faces;
    const PieceType* type = nullptr;
  };
  const Regular& regular() const {
    return regular_.get([this] { return found_regular(); });
  }
  Regular found_regular() const;
  bool is_regular(const Piece& piece) const {
    return (piece.kind == Kind::quad || piece.kind == Kind::triangle) && regular().faces &&
           regular().faces->is_regular(base().topology().face(piece.start));
  }
  /// Returns the error for a piece without a limit.
  NoLimit without_limit(const Piece& piece, const std::string& why) const;
  FoundOnce<Regular> regular_;
  FoundOnce<Pieces> pieces_;
};

}  // namespace sublimit
