// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pieces of a limit with their points, as polynomials: the Bernstein coefficients of a piece that is one, or of those
// of its descendants that are, and where these lie in their address. What bounds, searches and cuts need.
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sublimit/limit/detail/piece_hull.h"
#include "sublimit/limit/limit_map.h"

namespace sublimit {

/// A corner of a cell, in steps of an address's sides.
struct CellCorner {
  std::int32_t i = 0, j = 0;
  bool operator==(const CellCorner&) const = default;
  /// The address's parameters, exact.
  std::array<double, 2> uv() const;
  Place in(Index address) const { return {address, uv()[0], uv()[1]}; }
};
/// Steps along a side of an address.
inline constexpr std::int32_t cell_steps = 1 << 24;
inline std::array<double, 2> CellCorner::uv() const { return {double(i) / cell_steps, double(j) / cell_steps}; }

/// Corners of a cell, counter-clockwise from its own (0, 0); of triangles the last one means nothing.
using CellCorners = std::array<CellCorner, 4>;
/// In steps of one.
inline constexpr std::array<CellCorner, 4> square_corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
inline constexpr std::array<CellCorner, 3> triangle_corners{{{0, 0}, {1, 0}, {0, 1}}};
CellCorners whole_cell(bool triangle);
/// A cell of one step is cut no further.
bool is_smallest(const CellCorners& corners);

/// A place of a cell by its own parameters in halves: 0, 1 or 2.
CellCorner at_halves(const CellCorners& corners, bool triangle, int u, int v);
/// The address's parameters of a place of a cell.
std::array<double, 2> at_place(const CellCorners& corners, bool triangle, double u, double v);
/// Corners of a quarter, as `BernsteinNets::quarter` has it.
CellCorners quarter_of(const CellCorners& corners, bool triangle, int k);
/// Corners of a child; nothing if it is neither a quarter nor all of the cell, as next to the borders of dual schemes
/// and between knot intervals.
std::optional<CellCorners> child_of(const CellCorners& corners, const PieceMap& map, bool triangle);

/// A polynomial part of a piece, or one that is looked into no further.
struct PiecePart {
  CellCorners corners;
  int depth = 0;                         ///< quarterings below the piece
  std::optional<PolynomialBasis> basis;  ///< whose degree it has; none: it is no polynomial
  /// Bernstein coefficients, x 3; of a rational part (w x, w) with all w > 0, x 4. Two of a part that is cut along u =
  /// v, on all of it.
  std::vector<Points> nets;
  const PieceType* type = nullptr;  ///< of a part that is no polynomial
  Points points;                    ///< that it depends on
  /// True if it is a triangle.
  bool is_triangle() const { return basis ? basis->total() : type->kind() == Piece::Kind::triangle; }
};

/// A point of a net as parts have them: of a rational one divided by its weight.
inline Eigen::Vector3d net_point(const Points& net, Eigen::Index row) {
  const Eigen::Vector3d x = net.row(row).head<3>();
  return net.cols() == 4 ? Eigen::Vector3d(x / net(row, 3)) : x;
}

/// Finds parts of pieces. Not to be shared between threads.
class PieceParts {
 public:
  /// @param levels  quarterings that are looked into below a piece that is no polynomial
  void find(const PieceType& type, const Points& points, const CellCorners& corners, int levels,
            std::vector<PiecePart>& out, int depth = 0);
  const BernsteinNets& nets(const PolynomialBasis& basis) {
    return nets_.try_emplace({basis.degree(), basis.total()}, basis).first->second;
  }
  /// A quarter of a polynomial or rational part, as `quarter_of` has it.
  PiecePart quarter(const PiecePart& part, int k);

 private:
  std::map<std::pair<int, bool>, BernsteinNets> nets_;
  std::map<std::pair<int, bool>, BernsteinQuarters> quarters_;
};

/// Row of a Bernstein coefficient in its net.
inline Eigen::Index net_row(const PolynomialBasis& basis, int i, int j) {
  const int d = basis.degree();
  return basis.total() ? i * (d + 1) - i * (i - 1) / 2 + j : i * (d + 1) + j;
}
/// Calls visit(i, j, row) for all of them.
template <class Visit>
void for_each_net_row(const PolynomialBasis& basis, const Visit& visit) {
  const int d = basis.degree();
  Eigen::Index row = 0;
  for (int i = 0; i <= d; ++i)
    for (int j = 0; j <= (basis.total() ? d - i : d); ++j, ++row) visit(i, j, row);
}

/// Calls visit(type, points, corners) for the pieces of an address that are in no hole.
/// @param points  of the level that has the pieces
using VisitPiece = std::function<void(const PieceType&, const Points&, const CellCorners&)>;
/// Pieces of addresses, for given points.
class AddressPieces {
 public:
  /// @param surface  which must stay
  /// @throws InvalidParameter  points that do not fit
  AddressPieces(const LimitMap& surface, const Points& points);
  AddressPieces(const LimitMap&&, const Points&) = delete;
  void visit(Index address, const VisitPiece& visit) const;
  bool has_no_polynomials() const;

 private:
  const LimitMap::Parts& parts_;
  Points points_;
};

}  // namespace sublimit
