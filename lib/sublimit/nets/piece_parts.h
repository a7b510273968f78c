// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pieces of a limit with given points as polynomials: Bernstein coefficients of a polynomial piece, or of its
// polynomial descendants, and their cells in the parameters of the address. Used by bounds, searches and cuts.
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sublimit/core/detail/bernstein.h"
#include "sublimit/nets/piece_hull.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// A corner of a cell in integer coordinates: `cell_steps` steps make the side of an address.
struct CellCorner {
  std::int32_t i = 0, j = 0;
  bool operator==(const CellCorner&) const = default;
  /// Returns the parameters in the address, exact.
  std::array<double, 2> uv() const;
  /// Returns the corner as a place.
  Place in(Index address) const { return {address, uv()[0], uv()[1]}; }
};
/// Number of steps along a side of an address.
inline constexpr std::int32_t cell_steps = 1 << 24;
inline std::array<double, 2> CellCorner::uv() const { return {double(i) / cell_steps, double(j) / cell_steps}; }

/// Returns true if a corner is on a side of its address; sides are counter-clockwise from (0, 0).
inline bool is_on_side(const CellCorner& c, size_t side, bool triangle) {
  if (side == 0) return c.j == 0;
  if (side == 1) return (triangle ? c.i + c.j : c.i) == cell_steps;
  return side == 2 && !triangle ? c.j == cell_steps : c.i == 0;
}

/// Corners of a cell, counter-clockwise from its own (0, 0). The last one of a triangle is unused.
using CellCorners = std::array<CellCorner, 4>;
/// Corners of the unit square and triangle.
inline constexpr std::array<CellCorner, 4> square_corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
inline constexpr std::array<CellCorner, 3> triangle_corners{{{0, 0}, {1, 0}, {0, 1}}};
/// Returns the corners of a whole address.
CellCorners whole_cell(bool triangle);
/// Returns true if the sides of a cell are one step long, so that it has no quarters.
bool is_smallest(const CellCorners& corners);

/// Returns a corner, midpoint or centre of a cell.
/// @param u, v  its parameters in the cell, in halves: 0, 1 or 2
CellCorner at_halves(const CellCorners& corners, bool triangle, int u, int v);
/// Returns the parameters in the address of a place (u, v) of a cell.
std::array<double, 2> at_place(const CellCorners& corners, bool triangle, double u, double v);
/// Returns the corners of quarter k of a cell, numbered as in `BernsteinQuarters`.
CellCorners quarter_of(const CellCorners& corners, bool triangle, int k);
/// Returns the corners of a child in the cell of its parent. Nothing if the child is neither a quarter nor the
/// whole parent, as at borders in dual schemes and between unequal knot intervals.
std::optional<CellCorners> child_of(const CellCorners& corners, const PieceMap& map, bool triangle);

/// A polynomial part of a piece, or a part without a polynomial that is not divided further.
struct PiecePart {
  CellCorners corners;
  int depth = 0;                         ///< number of quarterings from the piece to the part
  std::optional<PolynomialBasis> basis;  ///< gives degree and shape; nothing for a part without a polynomial
  /// Bernstein coefficients, #coefficients x 3; for a rational part (w x, w) with all w > 0, x 4. A part that
  /// is cut along u = v has two nets, each over the whole part: for u >= v and for u < v.
  std::vector<Points> nets;
  const PieceType* type = nullptr;  ///< type of a part without a polynomial
  Points points;                    ///< points that such a part depends on, by slot
  /// True if it is a triangle.
  bool is_triangle() const { return basis ? basis->total() : type->kind() == Piece::Kind::triangle; }
};

/// Returns a control point of a part's net; for rational nets divided by its weight.
inline Eigen::Vector3d net_point(const Points& net, Eigen::Index row) {
  const Eigen::Vector3d x = net.row(row).head<3>();
  return net.cols() == 4 ? Eigen::Vector3d(x / net(row, 3)) : x;
}

/// Divides pieces into parts. Caches matrices: use one object per thread.
class PieceParts {
 public:
  /// Appends the parts of a piece to `out`.
  /// @param points   points of the piece, by slot
  /// @param corners  cell of the piece
  /// @param levels   largest number of quarterings of a piece that is no polynomial
  /// @param depth    quarterings so far
  void find(const PieceType& type, const Points& points, const CellCorners& corners, int levels,
            std::vector<PiecePart>& out, int depth = 0);
  const BernsteinNets& nets(const PolynomialBasis& basis) {
    return nets_.try_emplace({basis.degree(), basis.total()}, basis).first->second;
  }
  /// Returns quarter k of a polynomial or rational part, numbered as in `quarter_of`.
  PiecePart quarter(const PiecePart& part, int k);

 private:
  std::map<std::pair<int, bool>, BernsteinNets> nets_;
  std::map<std::pair<int, bool>, BernsteinQuarters> quarters_;
};

/// Returns the domain of a net.
inline PieceShape net_shape(const PolynomialBasis& basis) {
  return basis.total() ? PieceShape::triangle : PieceShape::square;
}
/// Returns the row of Bernstein coefficient (i, j) in its net.
inline Eigen::Index net_row(const PolynomialBasis& basis, int i, int j) {
  return coefficient_number(net_shape(basis), basis.degree(), i, j);
}
/// Calls visit(i, j, row) for all Bernstein coefficients of a net.
template <class Visit>
void for_each_net_row(const PolynomialBasis& basis, const Visit& visit) {
  const int d = basis.degree();
  Eigen::Index row = 0;
  for (int i = 0; i <= d; ++i)
    for (int j = 0; j <= (basis.total() ? d - i : d); ++j, ++row) visit(i, j, row);
}

/// Function called as visit(type, points, corners) for a piece, with its points by slot and its cell.
using VisitPiece = std::function<void(const PieceType&, const Points&, const CellCorners&)>;
/// The pieces of each address of a surface with given points.
class AddressPieces {
 public:
  /// @param surface  must outlive this
  /// @param points   points of the surface's level, #V x 3
  /// @throws InvalidParameter  points of another shape
  AddressPieces(const LimitMap& surface, const Points& points);
  AddressPieces(const LimitMap&&, const Points&) = delete;
  /// Calls visit(...) for the pieces of an address that are in no hole.
  void visit(Index address, const VisitPiece& visit) const;
  /// Returns true if it is known that no piece of the scheme is a polynomial.
  bool has_no_polynomials() const;

 private:
  const LimitMap::Parts& parts_;
  Points points_;
};

}  // namespace sublimit
