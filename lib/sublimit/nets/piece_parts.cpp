// SPDX-License-Identifier: Apache-2.0
#include "sublimit/nets/piece_parts.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/surface/detail/limit_map_parts.h"

namespace sublimit {
namespace {

/// Where the corners of a child are in its parent, in halves.
std::optional<CellCorners> child_halves(const PieceMap& map) {
  CellCorners halves;
  if (map.is_triangle) {
    Eigen::Matrix3d to_child;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) to_child(r, c) = map.barycentric[size_t(r)][size_t(c)];
    const Eigen::Matrix3d found = 2 * to_child.inverse();  // columns: corners of the child
    if (!found.isApprox(found.array().round().matrix(), 1e-12)) return std::nullopt;
    for (int k = 0; k < 3; ++k)
      halves[size_t(k)] = {static_cast<std::int32_t>(std::lround(found(1, k))),
                           static_cast<std::int32_t>(std::lround(found(2, k)))};
    halves[3] = halves[0];
    return halves;
  }
  if (map.radial) return std::nullopt;
  for (size_t k = 0; k < 4; ++k) {
    std::array<int, 2> parent{-1, -1};
    for (size_t a = 0; a < 2; ++a) {
      const PieceMap::Axis& axis = map.axes[a];
      const int own = a == 0 ? square_corners[k].i : square_corners[k].j, x = axis.reversed ? 1 - own : own;
      if (axis.span == Span::whole)
        parent[axis.from] = 2 * x;
      else if ((axis.span == Span::lower || axis.span == Span::upper) && axis.scale == 2)
        parent[axis.from] = axis.span == Span::lower ? x : x + 1;
      else
        return std::nullopt;
    }
    if (parent[0] < 0 || parent[1] < 0) return std::nullopt;
    halves[k] = {parent[0], parent[1]};
  }
  return halves;
}

}  // namespace

CellCorners whole_cell(bool triangle) {
  CellCorners whole;
  for (size_t k = 0; k < 4; ++k) {
    const CellCorner c = triangle ? triangle_corners[k % 3] : square_corners[k];
    whole[k] = {c.i * cell_steps, c.j * cell_steps};
  }
  return whole;
}

bool is_smallest(const CellCorners& c) { return std::abs(c[1].i - c[0].i) + std::abs(c[1].j - c[0].j) < 2; }

CellCorner at_halves(const CellCorners& c, bool triangle, int u, int v) {
  const auto mean = [&](std::int64_t a, std::int64_t b, std::int64_t d) {
    return static_cast<std::int32_t>(a + (u * (b - a) + v * (d - a)) / 2);
  };
  const CellCorner& last = c[triangle ? 2 : 3];
  return {mean(c[0].i, c[1].i, last.i), mean(c[0].j, c[1].j, last.j)};
}

std::array<double, 2> at_place(const CellCorners& c, bool triangle, double u, double v) {
  const CellCorner& last = c[triangle ? 2 : 3];
  return {(c[0].i + u * (c[1].i - c[0].i) + v * (last.i - c[0].i)) / cell_steps,
          (c[0].j + u * (c[1].j - c[0].j) + v * (last.j - c[0].j)) / cell_steps};
}

CellCorners quarter_of(const CellCorners& corners, bool triangle, int k) {
  CellCorners own;
  for (size_t m = 0; m < 4; ++m) {
    const CellCorner c = triangle ? triangle_corners[m % 3] : square_corners[m];
    const bool turned = triangle && k == 3;  // the middle one lies upside down
    own[m] = at_halves(corners, triangle, turned ? 1 - c.i : c.i + (k & 1), turned ? 1 - c.j : c.j + (k >> 1));
  }
  return own;
}

std::optional<CellCorners> child_of(const CellCorners& corners, const PieceMap& map, bool triangle) {
  std::optional<CellCorners> child = child_halves(map);
  if (child)
    for (CellCorner& c : *child) c = at_halves(corners, triangle, c.i, c.j);
  return child;
}

void PieceParts::find(const PieceType& type, const Points& points, const CellCorners& corners, int levels,
                      std::vector<PiecePart>& out, int depth) {
  PiecePart part{corners, depth, std::nullopt, {}, &type, {}};
  if (const PiecePolynomial* const polynomial = type.polynomial()) {
    part.basis = polynomial->basis;
    part.nets = polynomial_nets(*polynomial, nets(polynomial->basis).from_basis(), points);
    out.push_back(std::move(part));
    return;
  }
  const bool triangle = type.kind() == Piece::Kind::triangle;
  std::vector<std::pair<const PieceLink*, CellCorners>> children;
  if (depth < levels)
    for (const PieceLink& link : type.children()) {
      const std::optional<CellCorners> child = child_of(corners, link.map, triangle);
      if (!child) break;
      children.push_back({&link, *child});
    }
  if (children.empty() || children.size() < type.children().size()) {
    part.points = points;
    out.push_back(std::move(part));
    return;
  }
  for (const auto& [link, own] : children)  // the only child is all of its parent
    find(*link->type, child_points(*link, points), own, levels, out, children.size() == 1 ? depth : depth + 1);
}

PiecePart PieceParts::quarter(const PiecePart& part, int k) {
  const int degree = part.basis->degree();
  const bool total = part.basis->total();
  const BernsteinQuarters& quarters = quarters_.try_emplace({degree, total}, degree, total).first->second;
  PiecePart quarter{quarter_of(part.corners, total, k), part.depth + 1, part.basis, {}, part.type, {}};
  for (size_t half = 0; half < part.nets.size(); ++half) {
    // Of a part that is cut along u = v the quarters beside that line are in one half.
    if (part.nets.size() > 1 && ((k == 1 && half == 1) || (k == 2 && half == 0))) continue;
    quarter.nets.push_back(quarters.quarter(k) * part.nets[half]);
  }
  return quarter;
}

AddressPieces::AddressPieces(const LimitMap& surface, const Points& points) : parts_(surface.parts()) {
  points_ = parts_.points_of_pieces(points, "cells");
  (void)parts_.pieces();
}

bool AddressPieces::has_no_polynomials() const { return parts_.types->pieces().has_no_polynomials(); }

void AddressPieces::visit(Index address, const VisitPiece& visit) const {
  const LimitMap::Parts::Pieces& pieces = parts_.pieces();
  const bool triangles = parts_.addresses.triangles();
  std::array<Index, 4> done{-1, -1, -1, -1};
  size_t count = 0;
  for (const double u : {0.25, 0.75})
    for (const double v : {0.25, 0.75}) {
      if (triangles && u + v > 1) continue;
      const Place s{address, u, v};
      const LimitMap::Parts::Target target = parts_.target(s);
      if (parts_.sides(target.piece) & LimitMap::Parts::hole) continue;
      const Index piece = parts_.number(s, target);
      if (std::ranges::find(done, piece) != done.end()) continue;
      done[count++] = piece;
      const CellCorners whole = whole_cell(triangles);
      const Points local = pieces.points_of(piece, points_);
      visit(*pieces.types[size_t(piece)], local, target.map ? *child_of(whole, *target.map, triangles) : whole);
    }
}

}  // namespace sublimit
