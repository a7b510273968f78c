// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_map.h"

#include <cmath>
#include <utility>

namespace sublimit {
namespace {

/// A function of two parameters with its derivatives.
struct Jet {
  double value = 0, d[2] = {0, 0}, dd[3] = {0, 0, 0};

  static Jet constant(double c) { return {c, {0, 0}, {0, 0, 0}}; }
  friend Jet operator-(const Jet& a, const Jet& b) {
    Jet r;
    r.value = a.value - b.value;
    for (int i = 0; i < 2; ++i) r.d[i] = a.d[i] - b.d[i];
    for (int i = 0; i < 3; ++i) r.dd[i] = a.dd[i] - b.dd[i];
    return r;
  }
  /// f(a), by f and its derivatives at a.
  Jet under(double f, double df, double ddf) const {
    return {f,
            {df * d[0], df * d[1]},
            {df * dd[0] + ddf * d[0] * d[0], df * dd[1] + ddf * d[0] * d[1], df * dd[2] + ddf * d[1] * d[1]}};
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value,
            {a.d[0] * b.value + a.value * b.d[0], a.d[1] * b.value + a.value * b.d[1]},
            {a.dd[0] * b.value + 2 * a.d[0] * b.d[0] + a.value * b.dd[0],
             a.dd[1] * b.value + a.d[0] * b.d[1] + a.d[1] * b.d[0] + a.value * b.dd[1],
             a.dd[2] * b.value + 2 * a.d[1] * b.d[1] + a.value * b.dd[2]}};
  }
};

/// A coordinate and its distance from 1, with derivatives.
struct Coordinate {
  Jet x, rest;
};

Coordinate parent_axis(const PieceCoordinates& p, int axis) {
  Jet x, rest;
  x.value = axis == 0 ? p.u : p.v;
  rest.value = axis == 0 ? p.u1 : p.v1;
  x.d[axis] = 1;
  rest.d[axis] = -1;
  return {x, rest};
}

Coordinate spanned(const Coordinate& c, Span span, double scale) {
  const double x = c.x.value, rest = c.rest.value, root = std::sqrt(x);
  const auto made = [&](double value, double from_one, double d, double dd) {
    return Coordinate{c.x.under(value, d, dd), c.x.under(from_one, -d, -dd)};
  };
  switch (span) {
    case Span::lower:
      return made(scale * x, 1 - scale * x, scale, 0);
    case Span::upper:
      return made(1 - scale * rest, scale * rest, scale, 0);
    case Span::border:
      return made(4 * x, 1 - 4 * x, 4, 0);
    case Span::beside:
      return made(4 * root - 2, 3 - 4 * root, 2 / root, -1 / (x * root));
    case Span::beyond: {
      const double from_one = 4 * rest / (1 + root);
      return made(1 - from_one, from_one, 2 / root, -1 / (x * root));
    }
    default:
      return c;
  }
}

/// Rows across a border, from 0 at the border to 2 at the first points inside.
Jet row_from_border(const Coordinate& c) {
  const double x = c.x.value, root = std::sqrt(x);
  return x <= 0.25 ? c.x.under(4 * x, 4, 0) : c.x.under(4 * root - 1, 2 / root, -1 / (x * root));
}

/// The piece of a rounded corner's triangle at a border point: `along` from the border point inwards, `fraction` of the
/// way from the other side. (With X and Y exchanged for the other border point.)
std::pair<Coordinate, Coordinate> wedge(const PieceCoordinates& p, int along) {
  const Jet Y = row_from_border(parent_axis(p, along)), X = row_from_border(parent_axis(p, 1 - along));
  const Jet two = Jet::constant(2), one = Jet::constant(1), up = two - X, width = two - Y;
  const double w = width.value;
  const Jet fraction = up * width.under(1 / w, -1 / (w * w), 2 / (w * w * w));
  return {{Y, one - Y}, {fraction, one - fraction}};
}

/// Both coordinates times (2 sqrt(r) - 1) / r, r the larger one.
Coordinate radial_axis(const PieceCoordinates& p, int axis) {
  const Jet x = parent_axis(p, axis).x, r = parent_axis(p, p.u >= p.v ? 0 : 1).x, one = Jet::constant(1);
  if (r.value <= 0) return {Jet::constant(-1), Jet::constant(2)};
  const double value = r.value, root = std::sqrt(value);
  const Jet factor = r.under(2 / root - 1 / value, -1 / (value * root) + 1 / (value * value),
                             1.5 / (value * value * root) - 2 / (value * value * value));
  const Jet moved = x * factor;
  return {moved, one - moved};
}

std::array<Coordinate, 2> mapped(const PieceMap& map, const PieceCoordinates& p) {
  const Jet zero = Jet::constant(0), one = Jet::constant(1);
  if (map.axes[0].span == Span::spoke) {
    const Jet r = parent_axis(p, p.u >= p.v ? 0 : 1).x, along = r.under(4 * r.value, 4, 0);
    return {Coordinate{along, one - along}, Coordinate{one, zero}};
  }
  if (map.axes[0].span == Span::fold) {
    const Jet least = parent_axis(p, p.u <= p.v ? 0 : 1).x, back = least.under(2 * least.value, 2, 0);
    return {Coordinate{one - back, back}, Coordinate{zero, one}};
  }
  if (map.axes[0].span == Span::wedge) {
    // `from` of axis 0 says which parent axis runs away from the border that the piece's point is on.
    const auto [Y, fraction] = wedge(p, map.axes[0].from);
    if (map.axes[0].reversed) return {fraction, Y};
    return {Y, fraction};
  }
  std::array<Coordinate, 2> result;
  for (int i = 0; i < 2; ++i) {
    const PieceMap::Axis& axis = map.axes[i];
    result[i] = spanned(map.radial ? radial_axis(p, axis.from) : parent_axis(p, axis.from), axis.span, axis.scale);
    if (map.axes[i].reversed) std::swap(result[i].x, result[i].rest);
  }
  return result;
}

}  // namespace

PieceCoordinates PieceMap::operator()(const PieceCoordinates& p) const {
  if (is_triangle) {
    const double parent[3] = {p.u1, p.u, p.v};
    double child[3] = {};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) child[i] += barycentric[i][j] * parent[j];
    return {child[1], child[2], child[0], 0};
  }
  if (!radial && axes[0].span <= Span::upper && axes[1].span <= Span::upper) {  // nearly always
    PieceCoordinates child;
    for (int i = 0; i < 2; ++i) {
      double x = axes[i].from == 0 ? p.u : p.v, rest = axes[i].from == 0 ? p.u1 : p.v1;
      if (axes[i].span == Span::lower) x = axes[i].scale * x, rest = 1 - x;
      if (axes[i].span == Span::upper) rest = axes[i].scale * rest, x = 1 - rest;
      if (axes[i].reversed) std::swap(x, rest);
      (i == 0 ? child.u : child.v) = x;
      (i == 0 ? child.u1 : child.v1) = rest;
    }
    return child;
  }
  const std::array<Coordinate, 2> child = mapped(*this, p);
  return {child[0].x.value, child[1].x.value, child[0].rest.value, child[1].rest.value};
}

bool PieceMap::contains(const PieceCoordinates& p) const {
  if (axes[0].span == Span::spoke && !is_triangle) return p.u <= 0.25 && p.v <= 0.25;
  if (axes[0].span == Span::fold && !is_triangle) return p.u <= 0.5 && p.v <= 0.5;
  const PieceCoordinates child = (*this)(p);
  if (is_triangle) return child.u >= 0 && child.v >= 0 && child.u1 >= 0;
  return child.u >= 0 && child.v >= 0 && child.u1 >= 0 && child.v1 >= 0;
}

PieceMap::Chain PieceMap::chain(const PieceCoordinates& p) const {
  double J[2][2], H[2][3] = {};  // derivatives of the child's parameters
  if (is_triangle) {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) J[i][j] = barycentric[i + 1][j + 1] - barycentric[i + 1][0];
  } else {
    const std::array<Coordinate, 2> child = mapped(*this, p);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) J[i][j] = child[i].x.d[j];
      for (int j = 0; j < 3; ++j) H[i][j] = child[i].x.dd[j];
    }
  }
  Chain c;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) c.first[j][i] = J[i][j];
  const int a[3] = {0, 0, 1}, b[3] = {0, 1, 1};
  for (int k = 0; k < 3; ++k) {
    c.second[k][0] = J[0][a[k]] * J[0][b[k]];
    c.second[k][1] = J[0][a[k]] * J[1][b[k]] + J[0][b[k]] * J[1][a[k]];
    c.second[k][2] = J[1][a[k]] * J[1][b[k]];
    for (int i = 0; i < 2; ++i) c.bend[k][i] = H[i][k];
  }
  return c;
}

}  // namespace sublimit
