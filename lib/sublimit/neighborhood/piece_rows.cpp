// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_rows.h"

#include <algorithm>
#include <cmath>

namespace sublimit {

void apply_chain(const PieceMap::Chain& c, RowMatrix& rows) {
  if (rows.rows() < 3) return;
  const RowMatrix old = rows;
  for (int i = 0; i < 2; ++i) rows.row(1 + i) = c.first[i][0] * old.row(1) + c.first[i][1] * old.row(2);
  if (rows.rows() < 6) return;
  for (int i = 0; i < 3; ++i)
    rows.row(3 + i) = c.second[i][0] * old.row(3) + c.second[i][1] * old.row(4) + c.second[i][2] * old.row(5) +
                      c.bend[i][0] * old.row(1) + c.bend[i][1] * old.row(2);
}

void turn_tangents(const PieceMap::Chain& c, RowMatrix& tangents) {
  if (tangents.rows() < 2) return;
  const RowMatrix old = tangents;
  for (int i = 0; i < 2; ++i) tangents.row(i) = c.first[i][0] * old.row(0) + c.first[i][1] * old.row(1);
}

namespace {

/// So near to a corner, but not there, that more than a few digits of tangents would go.
bool is_beside_corner(Piece::Kind kind, const PieceCoordinates& place) {
  constexpr double near = 0x1p-12;
  const PieceCoordinates c = corner_place(kind, nearest_corner(kind, place));
  return std::abs(place.u - c.u) <= near && std::abs(place.v - c.v) <= near && corner_at(kind, place) < 0;
}

/// Along the tangent plane of a polynomial at a place next to a corner. Where both derivatives are parallel at the
/// corner, as beside a crease that leaves one face, all that the plane is known by is a difference of the size of the
/// distance: the way to the corner keeps it apart.
RowMatrix polynomial_tangents(const PieceType& type, const PiecePolynomial& polynomial, PieceCoordinates place) {
  const PieceLink* const child = is_beside_corner(type.kind(), place) ? &type.child(place) : nullptr;
  const PiecePolynomial* const next = child ? child->type->known_polynomial() : nullptr;
  if (!next) return polynomial.rows(place, 1).middleRows(1, 2);
  const PieceLink& link = *child;
  if (!link.repeats) {
    RowMatrix tangents = link.block.derivatives_pulled_back(polynomial_tangents(*link.type, *next, link.map(place)));
    turn_tangents(link.map.chain(place), tangents);
    return tangents;
  }
  int times = 0;
  for (; times < 4095 && link.map.contains(place); ++times) place = link.map(place);
  return link.repeated.tangents_pulled_back(polynomial.rows(place, 1).middleRows(1, 2), times);
}

}  // namespace

PieceDescent descend(const PieceType& root, PieceCoordinates place, bool search) {
  // Below this many levels the rest of a cell is less than the rounding of its place.
  constexpr int enough_halves = 54, enough_thirds = 35;
  PieceDescent way;
  const PieceType* type = &root;
  for (int levels = 0;; ++levels) {
    way.type = type;
    way.place = place;
    way.polynomial = search ? type->polynomial() : type->known_polynomial();
    if (way.polynomial) return way;
    int corner = corner_at(type->kind(), place);
    if (corner >= 0 && type->child(place).type != type) corner = -1;  // it may become a polynomial yet
    if (corner >= 0 || levels >= (type->children().size() == 9 ? enough_thirds : enough_halves)) {
      way.at_corner = corner >= 0;
      way.corner = corner >= 0 ? corner : nearest_corner(type->kind(), place);
      return way;
    }
    const PieceLink& link = type->child(place);
    way.steps.push_back({type, &link, place, 1});
    PieceCoordinates before = place;
    place = link.map(place);
    if (link.repeats) {
      int& times = way.steps.back().times;
      while (times < 4095 && corner_at(type->kind(), place) < 0 && link.map.contains(place)) {
        if (place.u == before.u && place.v == before.v) {  // it stays where it is, between corners
          times = levels = enough_halves;
          break;
        }
        before = place;
        place = link.map(place);
        ++times;
      }
    }
    type = link.type;
  }
}

PieceRows piece_rows(const PieceType& root, PieceCoordinates place, int order, bool search) {
  const PieceDescent way = descend(root, place, search);
  const PieceType* const type = way.type;
  const PieceType::CornerRows* last = nullptr;
  PieceRows result;
  if (way.polynomial) {
    result.rows = way.polynomial->rows(way.place, order);
    result.order = order;
    result.on_knot = is_on_knot(way.place, type->kind() == Piece::Kind::triangle, type->kind() == Piece::Kind::corner,
                                way.polynomial->coefficients.size() > 1);
    if (order > 0 && is_beside_corner(type->kind(), way.place))
      result.tangents = polynomial_tangents(*type, *way.polynomial, way.place);
  } else {
    result.at_corner = way.at_corner;
    if (order == 0) {
      result.rows = type->corner_limit(way.corner);
    } else {
      last = &type->corner(way.corner);
      result.order = std::min(order, last->order());
      result.rows = last->rows.topRows(result.order == 0 ? 1 : result.order == 1 ? 3 : 6);
    }
  }
  if (result.order > 0 && result.tangents.rows() == 0) result.tangents = result.rows.middleRows(1, 2);
  // Second derivatives of linear functions vanish. What rounding leaves of them would grow by the scale with every step
  // back. The functions are known of the type where the path ends, which is that of all regular pieces on it.
  const auto without_linear = [&](const PieceType* of) {
    if (of != type || !last || last->linear.size() == 0 || result.order < 2) return;
    result.rows.bottomRows(3) -= result.rows.bottomRows(3) * last->linear * last->rows.middleRows(1, 2);
  };
  for (auto step = way.steps.rbegin(); step != way.steps.rend(); ++step) {
    const PieceLink& link = *step->link;
    const PieceMap::Chain chain = result.order > 0 ? link.map.chain(step->place) : PieceMap::Chain{};
    if (step->times == 1) {
      result.rows = link.block.pulled_back(result.rows);
      if (result.order == 0) continue;
      result.tangents = link.block.derivatives_pulled_back(result.tangents);
      turn_tangents(chain, result.tangents);
      apply_chain(chain, result.rows);
      without_linear(step->from);
      continue;
    }
    result.rows = link.repeated.pulled_back(result.rows, step->times);
    if (result.order == 0) continue;
    result.tangents = link.repeated.tangents_pulled_back(std::move(result.tangents), step->times);
    const double factor = std::pow(chain.first[0][0], step->times);
    result.rows.middleRows(1, 2) *= factor;
    if (result.rows.rows() < 6) continue;
    result.rows.bottomRows(3) *= factor;
    result.rows.bottomRows(3) *= factor;
    without_linear(step->from);
  }
  return result;
}

}  // namespace sublimit
