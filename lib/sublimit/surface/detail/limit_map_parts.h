// SPDX-License-Identifier: Apache-2.0
#pragma once
// Implementation of LimitMap: from addresses to pieces of a level, and from pieces to their types.
#include <optional>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/neighborhood/piece_rows.h"
#include "sublimit/neighborhood/regular_faces.h"
#include "sublimit/surface/detail/corner_limits.h"
#include "sublimit/surface/detail/patch_tree.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// True if the cross product of two tangents is accurate enough for a normal. Else `normal_of` decides.
/// @param cross2     square of the length of the cross product
/// @param tangents2  product of the squares of the lengths of the tangents
inline bool is_sound_normal(double cross2, double tangents2) {
  return cross2 > 1e-12 * tangents2 && tangents2 > 1e-280 && tangents2 < 1e280;
}

/// Returns the map from the square of a quadrilateral to its quarter at a corner, which is (0, 0) of the
/// quarter.
const PieceMap& quarter_map(int corner);

struct LimitMap::Parts {
  using Kind = Piece::Kind;
  Scheme<double> scheme;  ///< the scheme with its preparation removed
  Level level;
  /// The level that has the pieces, if a preparation step refines `level` first; its S is over the vertices of
  /// `level`.
  std::optional<Level> prepared;
  std::optional<Scheme<double>> preparing;  ///< the scheme with its preparation, if that has made `prepared`
  /// Returns the level that has the pieces.
  const Level& base() const { return prepared ? *prepared : level; }
  Addresses addresses;
  std::shared_ptr<LimitCache> types;
  CornerLimits corners;

  Parts(const Scheme<double>& scheme, Level level, std::shared_ptr<LimitCache> shared);

  /// A place as a piece and the coordinates in it.
  struct Target {
    Piece piece;
    PieceCoordinates place;
    const PieceMap* map = nullptr;  ///< from coordinates in the address to those in the piece; null: identity
    PieceCoordinates outer = {};    ///< coordinates in the address; set if there is a map
  };
  Target target(const Place& place) const;
  bool is_inside(const Place& s) const { return sublimit::is_inside(addresses, s); }
  /// True if the surface is cut, or only continuous, across an edge.
  bool cuts(HalfEdge h) const {
    return is_cut(base().topology(), base().sharpness, h) || types->pieces().regular_smoothness() == 0;
  }
  /// True if the tail of h is on a crease, border or corner, even if no edge of the face of h is cut.
  bool is_on_cut(HalfEdge h) const;
  /// Returns the sides and corners of a piece at which the surface is cut, as bits: bit k for side k (from
  /// corner k to the next), bit 5 + k for corner k; `hole` for a piece in a hole.
  unsigned sides(const Piece& piece) const;
  static constexpr unsigned hole = 16, first_corner = 32;
  /// Returns the sides and corners that a place is on, as the bits of `sides`.
  static unsigned sides_at(const PieceCoordinates& p, bool triangle) {
    const unsigned sides = (p.v == 0 ? 1u : 0u) | (p.u1 == 0 ? 2u : 0u) |
                           ((triangle ? p.u == 0 : p.v1 == 0) ? 4u : 0u) | (!triangle && p.u == 0 ? 8u : 0u);
    const unsigned before = (sides << 1 | sides >> (triangle ? 2 : 3)) & (triangle ? 7u : 15u);
    return sides | (sides & before) * first_corner;
  }
  /// Returns the centre at a place: a vertex of the level, the middle of a face, or (dual schemes) the middle
  /// of a border edge. Nothing elsewhere.
  std::optional<Centre> centre(const Target& target) const;

  /// Returns the weights of the limit position of the control vertex that a place is, over the vertices of `level`: the
  /// same bits as in `limit_matrices`, whichever face has the place. Nothing at other places, and where there is no
  /// limit.
  std::optional<LimitRows::Row> vertex_position(const Target& target) const;

  /// Returns the type of a piece, and in `vertices` the points it depends on, by slot.
  /// @throws AnalysisError  no limit
  const PieceType* type_of(const Piece& piece, std::vector<Index>& vertices) const;
  /// Stencil and status of a place, over the vertices of its piece.
  struct Found {
    std::vector<Index> vertices;
    PieceRows rows;       ///< over differences of the points; derivatives by the parameters of the address
    SparseRows tangents;  ///< tangents of the limit masks, over vertices, if the piece has no derivatives here
    LimitStatus status = LimitStatus::regular;
  };
  struct Pieces;
  /// Cache of the rows of the last place and type. A caller that evaluates the same place on many faces of one
  /// type, one after the other, computes the rows once. At a vertex of hundreds of faces they cost as much as a
  /// small mesh.
  struct KnownRows {
    const Pieces* pieces = nullptr;  ///< pieces of the surface; null: the cache is not used
    const PieceType* type = nullptr;
    PieceCoordinates place = {};
    int order = 0;
    PieceRows rows = {};
    std::optional<RowMatrix> on_side = {};  ///< `tangents_on_side`, if computed
    std::int64_t made = 0;                  ///< number of times that rows were computed
  };
  /// Returns stencil and status of a place, with derivatives up to `order` where they exist.
  /// @throws NoLimit  names the face of the mesh
  Found find(const Target& at, int order) const;
  /// Returns the same for a place of an address.
  /// @param known  cache of rows; with its pieces no walk around the piece is needed
  /// @throws NoLimit  names the face of the mesh
  Found find(const Place& place, int order, KnownRows* known = nullptr) const;
  /// Returns the tangents on a side where the limit has a tangent plane but no derivatives by u and v: those at
  /// a place 2^-50 further inside. No rows if derivatives do not exist there either.
  RowMatrix tangents_on_side(const PieceType& type, const PieceCoordinates& place) const;
  /// Returns stencil and status of a place in a piece of a given type.
  /// @param vertices  points of the piece, by slot
  Found find(const Target& at, int order, const PieceType& type, std::vector<Index> vertices,
             KnownRows* known = nullptr) const;
  /// Converts to a stencil over the vertices of `level`, ascending, without zero weights.
  /// @param position  weights of the position over the vertices of `level`, if they are known (`vertex_position`)
  LimitStencil stencil(Found found, std::optional<LimitRows::Row> position = {}) const;
  /// Computes row i of `out` from the stencil of a place.
  void evaluate_row(const Points& points, const Place& place, int order, bool normals, LimitSamples& out,
                    std::int64_t i, KnownRows* known = nullptr) const;

  /// Returns the normal at a place: the cross product of the tangents or, if these are degenerate, that of the
  /// plane they span with the next terms of the limit. Zero if undecided.
  /// @param local  points of the stencil
  Eigen::Vector3d normal_of(const LimitStencil& stencil, const Points& local, const Place& place,
                            const Points& points) const;

  /// Types and points of all pieces. Pieces are numbered like the faces of `prepared`, in dual schemes like
  /// half-edges (corners of faces), else like addresses.
  struct Pieces {
    std::vector<const PieceType*> types;
    std::vector<std::int64_t> first;  ///< start of each piece in `vertices`, and the end
    std::vector<Index> vertices;      ///< points of the pieces, by slot
    std::vector<const PatchTree*> trees;
    std::unordered_map<const PieceType*, std::unique_ptr<const PatchTree>> tree_of;

    /// Returns the points of a piece from all points `x`, by slot.
    Points points_of(Index piece, const Points& x) const {
      const std::int64_t begin = first[size_t(piece)];
      Points local(first[size_t(piece) + 1] - begin, x.cols());
      for (Eigen::Index j = 0; j < local.rows(); ++j) local.row(j) = x.row(vertices[size_t(begin + j)]);
      return local;
    }
  };
  /// Throws unless points are in space, one for each vertex of `level`.
  /// @param what  needs them, in the message: "boxes"
  /// @throws InvalidParameter  an array of another shape
  void check_points(const Points& points, const char* what) const;
  /// Returns the points of the level that has the pieces: those of `level`, prepared if it is.
  /// @throws as check_points
  Points points_of_pieces(const Points& points, const char* what) const;

  /// Returns types and points of all pieces, computed on first use.
  const Pieces& pieces() const;
  Index num_pieces() const {
    return prepared           ? prepared->topology().num_faces()
           : scheme.is_dual() ? level.topology().num_half_edges()
                              : addresses.size();
  }
  Piece piece(Index number) const;
  /// Returns the number of the piece of a place.
  Index number(const Place& place, const Target& target) const {
    return prepared           ? index(prepared->topology().face(target.piece.start))
           : scheme.is_dual() ? index(target.piece.start)
                              : place.face;
  }

 private:
  /// Fast path for places without special cases. Returns false, and leaves `out` unchanged, if the general path is
  /// needed.
  bool evaluate_plain_row(const Points& points, const Found& found, int order, bool normals, LimitSamples& out,
                          std::int64_t i) const;
  Pieces found_pieces() const;
  /// Regular faces and their common type, which save a walk around each of them. The type is null if the scheme
  /// depends on more than one ring, or if walks find the points in another order than RegularFaces.
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
  /// Returns the limit positions of all vertices of `level`, with preparation; empty if one of them has no limit.
  std::vector<LimitRows> found_control_limits() const;
  ComputedOnce<std::vector<LimitRows>> control_limits_;  // used only with a preparation
  ComputedOnce<Regular> regular_;
  ComputedOnce<Pieces> pieces_;
};

}  // namespace sublimit
