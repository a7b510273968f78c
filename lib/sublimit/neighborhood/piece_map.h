// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parameters of pieces, and maps from the parameters of a parent to those of a child.
#include <array>
#include <cstdint>

namespace sublimit {

/// A place in a piece by its distances from all sides, so that it is as accurate near every corner as near
/// (0,0).
struct PieceCoordinates {
  double u = 0, v = 0;
  /// Quadrilaterals: 1 - u and 1 - v. Triangles: u1 = 1 - u - v.
  double u1 = 1, v1 = 1;
  bool operator==(const PieceCoordinates&) const = default;
};
/// Returns the place (u, v) of a quadrilateral.
inline PieceCoordinates quad_place(double u, double v) { return {u, v, 1 - u, 1 - v}; }
/// Returns the place (u, v) of a triangle. If u + v rounds to 1 or more, as for (2/3, 1/3), it is on the third
/// side.
inline PieceCoordinates triangle_place(double u, double v) { return {u, v, u + v >= 1 ? 0 : 1 - u - v, 0}; }

/// Returns the corner of a square whose quarter contains a place, counter-clockwise from (0,0).
inline int nearest_corner(double u, double v) { return v < 0.5 ? (u < 0.5 ? 0 : 1) : (u < 0.5 ? 3 : 2); }

/// Formula for a coordinate of the child from a coordinate x of the parent.
enum class Span : std::uint8_t {
  whole,  ///< x
  lower,  ///< scale x
  upper,  ///< 1 - scale (1 - x)
  // Across the border x = 0 of a dual scheme. Points of the border stay on it; in a step the first ones inside
  // come four times as near to it, all others twice: rows of the parent's mesh lie at 0, 1, 2, ..., those of
  // the child's at 0, 1/4, 3/4, 5/4, ... The limit of Chaikin's scheme, a segment up to 1/2 followed by uniform
  // quadratics, has this parameter: 4 t up to 1/8, then sqrt(8 t) - 1/2. In squares, whose sides are half the
  // distance of rows:
  border,  ///< 4 x
  beside,  ///< 4 sqrt(x) - 2
  beyond,  ///< 4 sqrt(x) - 3
  // Both sides are borders, and the corner is rounded: a triangle. X and Y in [0, 2] are given by the three
  // above.
  wedge,
  // Neither side is a border, but the corner is on one, with three or more faces. These become one face, with
  // the corner in the middle of a side. r = max(u, v) up to a quarter leads from the corner to the middle of
  // that face.
  spoke,  ///< (4 r, 1)
  // The corner has only two faces, which share an edge; in place of a face between them there is a line.
  fold,  ///< (1 - 2 min(u, v), 0)
};

/// Map from the parameters of a piece to those of one of its children.
struct PieceMap {
  /// An axis of a quadrilateral child: axis `from` of the parent, mapped by `span`, then reversed if
  /// `reversed`.
  struct Axis {
    std::uint8_t from = 0;
    Span span = Span::whole;
    bool reversed = false;
    double scale = 2;  ///< factor of `lower` and `upper`: 1 / length of the part, 2 for halves
  };
  std::array<Axis, 2> axes{Axis{0}, Axis{1}};
  bool radial = false;  ///< first multiply (u, v) by (2 sqrt(r) - 1) / r, for r beyond the first quarter of a spoke
  /// Triangles: the child's barycentric coordinates (1-u-v, u, v) by the parent's.
  bool is_triangle = false;
  std::array<std::array<double, 3>, 3> barycentric{};

  /// True if another child of the same parent is the same piece, whose parameters are no part of the parent's
  /// square.
  bool is_repeated() const { return !is_triangle && (axes[0].span == Span::spoke || axes[0].span == Span::fold); }
  /// True if the child contains a place of the parent.
  bool contains(const PieceCoordinates& parent) const;
  /// Returns the place in the child of a place of the parent.
  PieceCoordinates operator()(const PieceCoordinates& parent) const;

  /// Factors of the chain rule, which convert derivatives by the child's parameters to those by the parent's.
  struct Chain {
    double first[2][2] = {};   ///< (u, v) from (u, v)
    double second[3][3] = {};  ///< (uu, uv, vv) from (uu, uv, vv)
    double bend[3][2] = {};    ///< (uu, uv, vv) from (u, v)
  };
  /// Returns the chain rule at a place of the parent.
  Chain chain(const PieceCoordinates& parent) const;
};

}  // namespace sublimit
