// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parameters of pieces, and how those of a parent become those of a child.
#include <array>
#include <cstdint>

namespace sublimit {

/// A place in a piece, by its distances from all sides: near every corner they are as exact as near (0,0).
struct PieceCoordinates {
  double u = 0, v = 0;
  /// Quadrilaterals: 1 - u and 1 - v. Triangles: u1 = 1 - u - v.
  double u1 = 1, v1 = 1;
  bool operator==(const PieceCoordinates&) const = default;
};
inline PieceCoordinates quad_place(double u, double v) { return {u, v, 1 - u, 1 - v}; }
/// A place whose u + v is 1 but for rounding, as of (2/3, 1/3), is on the third side.
inline PieceCoordinates triangle_place(double u, double v) { return {u, v, u + v >= 1 ? 0 : 1 - u - v, 0}; }

/// The corner of a square whose quarter a place is in, counter-clockwise from (0,0).
inline int nearest_corner(double u, double v) { return v < 0.5 ? (u < 0.5 ? 0 : 1) : (u < 0.5 ? 3 : 2); }

/// How a coordinate x of the parent becomes one of its child.
enum class Span : std::uint8_t {
  whole,  ///< x
  lower,  ///< scale x
  upper,  ///< 1 - scale (1 - x)
  // Across the border x = 0 of a dual scheme. The border's points stay on it and the first ones inside come four times
  // as near, while all others come twice as near: rows of the parent's mesh lie at 0, 1, 2, ..., of the child's at 0,
  // 1/4, 3/4, 5/4, ... Chaikin's limit, a straight edge up to 1/2 and then uniform quadratics, has this parameter: 4 t
  // up to 1/8, then sqrt(8 t) - 1/2. In squares, half as wide as the rows are apart:
  border,  ///< 4 x
  beside,  ///< 4 sqrt(x) - 2
  beyond,  ///< 4 sqrt(x) - 3
  // Both sides are borders, and the corner is rounded: a triangle. X and Y as the three above give, in [0, 2].
  wedge,
  // Neither side is a border, but the corner is on one, among three faces and more. These become one face, with the
  // corner in the middle of a side: r = max(u, v) goes from there to the middle of that face first, up to a quarter.
  spoke,  ///< (4 r, 1)
  // The corner has two faces only, which are glued: what would be a face between them is a line.
  fold,  ///< (1 - 2 min(u, v), 0)
};

/// From the parameters of a piece to those of one of its children.
struct PieceMap {
  /// For each axis of a quadrilateral child: which one of the parent's, how, and whether it then runs backwards.
  struct Axis {
    std::uint8_t from = 0;
    Span span = Span::whole;
    bool reversed = false;
    double scale = 2;  ///< of `lower` and `upper`: 2 in the middle, else 1 / length of the part
  };
  std::array<Axis, 2> axes{Axis{0}, Axis{1}};
  bool radial = false;  ///< of (u, v) (2 sqrt(r) - 1) / r instead of (u, v): beyond the first quarter of a spoke
  /// Triangles: the child's barycentric coordinates (1-u-v, u, v) by the parent's.
  bool is_triangle = false;
  std::array<std::array<double, 3>, 3> barycentric{};

  /// Another child of the same level is this one as well: its parameters are no part of the parent's square.
  bool is_repeated() const { return !is_triangle && (axes[0].span == Span::spoke || axes[0].span == Span::fold); }
  bool contains(const PieceCoordinates& parent) const;
  PieceCoordinates operator()(const PieceCoordinates& parent) const;

  /// Factors that make derivatives by the parent's parameters from those by the child's.
  struct Chain {
    double first[2][2] = {};   ///< (u, v) from (u, v)
    double second[3][3] = {};  ///< (uu, uv, vv) from (uu, uv, vv)
    double bend[3][2] = {};    ///< (uu, uv, vv) from (u, v)
  };
  Chain chain(const PieceCoordinates& parent) const;
};

}  // namespace sublimit
