// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spline patches along a line of knots or a side as pairs of Bezier patches, in any number type. The knots of
// both patches divide the line into common parts; across it each patch contributes one row of faces.
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/patches/joins/bezier_piece.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

/// A line of constant u (v) at an end of a row of faces of a patch.
struct PatchLine {
  std::size_t patch = 0;
  bool along_v = true;             ///< true for a line of constant u
  Index face = 0;                  ///< face of the knots across the line
  KnotSide end = KnotSide::right;  ///< end of this face at which the line is

  bool operator==(const PatchLine&) const = default;
};

/// A patch, which must outlive this, with its control columns.
struct PatchColumns {
  const SplineSurface* surface = nullptr;
  Points columns;  ///< #points x 3, or x 4 if they are homogeneous

  const Knots<double>& across(const PatchLine& line) const { return line.along_v ? surface->u() : surface->v(); }
  const Knots<double>& along(const PatchLine& line) const { return line.along_v ? surface->v() : surface->u(); }
};

/// Returns knots in another number type, with exactly the same values.
template <class T>
Knots<T> converted(const Knots<double>& knots) {
  const std::span<const double> from = knots.is_closed() ? knots.in_domain() : knots.all();
  std::vector<T> to;
  for (const double t : from) to.push_back(T(t));
  return knots.is_closed() ? Knots<T>::closed(knots.degree(), to)
                           : Knots<T>::open(knots.degree(), knots.num_points(), std::move(to));
}

/// An interval inside a face; from > to if it is traversed backwards.
template <class T>
struct LinePart {
  Index face = 0;
  T from{}, to{};
};

/// A patch in numbers of type T.
template <class T>
struct SeamNet {
  Knots<T> u, v;
  std::vector<T> columns;  ///< u fastest, 3 or 4 of each point
  Coordinates coordinates;

  SeamNet(Knots<T> in_u, Knots<T> in_v, std::vector<T> all, Coordinates given)
      : u(std::move(in_u)), v(std::move(in_v)), columns(std::move(all)), coordinates(given) {}
  SeamNet(const PatchColumns& patch, Coordinates given)
      : u(converted<T>(patch.surface->u())), v(converted<T>(patch.surface->v())), coordinates(given) {
    columns.reserve(static_cast<std::size_t>(patch.columns.size()));
    for (Eigen::Index i = 0; i < patch.columns.rows(); ++i)
      for (Eigen::Index k = 0; k < patch.columns.cols(); ++k) columns.push_back(T(patch.columns(i, k)));
  }
};

/// Returns the Bezier points of a part as rows over the basis functions of its face: (degree + 1)^2 numbers.
template <class T>
std::vector<T> part_rows(const Knots<T>& knots, const LinePart<T>& part) {
  const auto p = static_cast<std::size_t>(knots.degree());
  std::vector<T> rows((p + 1) * (p + 1)), points(p);
  for (std::size_t i = 0; i <= p; ++i) {
    // f(from^(p-i), to^i), arguments ascending.
    const bool rises = part.from < part.to;
    for (std::size_t j = 0; j < p; ++j) points[j] = (rises ? j < p - i : j >= i) ? part.from : part.to;
    blossom_row(knots, part.face, std::span<T>(points), std::span<T>(rows).subspan(i * (p + 1), p + 1));
  }
  return rows;
}

/// Returns the Bezier patch at a part of a line, with u across the line and v along it.
/// @param at_end  true: the line is u = 1; false: u = 0
template <class T>
BezierPatch<T> strip(const SeamNet<T>& net, const PatchLine& line, bool at_end, const LinePart<T>& along) {
  const Knots<T>&across_knots = line.along_v ? net.u : net.v, &along_knots = line.along_v ? net.v : net.u;
  LinePart<T> across{.face = line.face,
                     .from = across_knots.all()[across_knots.span(line.face)],
                     .to = across_knots.all()[across_knots.span(line.face) + 1]};
  if ((line.end == KnotSide::right) != at_end) std::swap(across.from, across.to);
  const int p = across_knots.degree(), q = along_knots.degree(),
            width = net.coordinates == Coordinates::homogeneous ? 4 : 3;
  BezierPatch<T> result{.degree_u = p, .degree_v = q, .columns = {}, .coordinates = net.coordinates};
  result.length = across.from < across.to ? across.to - across.from : across.from - across.to;
  const std::vector<T> in_u = part_rows(across_knots, across), in_v = part_rows(along_knots, along);
  const auto column = [&](Index i, Index j) {
    const Index a = across_knots.point(across_knots.span(across.face) - p + i),
                b = along_knots.point(along_knots.span(along.face) - q + j);
    const Index point = line.along_v ? a + net.u.num_points() * b : b + net.u.num_points() * a;
    return net.columns.begin() + std::ptrdiff_t{point} * width;
  };
  // First across, then along.
  std::vector<T> half(static_cast<std::size_t>((p + 1) * (q + 1) * width), T(0));
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i)
      for (int m = 0; m <= p; ++m)
        for (int k = 0; k < width; ++k)
          half[static_cast<std::size_t>((j * (p + 1) + i) * width + k)] +=
              in_u[static_cast<std::size_t>(i * (p + 1) + m)] * column(m, j)[k];
  result.columns.assign(half.size(), T(0));
  for (int j = 0; j <= q; ++j)
    for (int m = 0; m <= q; ++m)
      for (int at = 0; at < (p + 1) * width; ++at)
        result.columns[static_cast<std::size_t>(j * (p + 1) * width + at)] +=
            in_v[static_cast<std::size_t>(j * (q + 1) + m)] * half[static_cast<std::size_t>(m * (p + 1) * width + at)];
  return result;
}

/// A part of a line inside one face of each patch.
template <class T>
struct CommonPart {
  LinePart<T> left, right;
  T begin{}, end{};  ///< the part in the parameter 0 .. 1 of the line
};

/// Returns the common parts of a line, in a parameter that maps both domains linearly to 0 .. 1.
/// @param reversed   true if the right side runs backwards
/// @param tolerance  distance up to which knots count as equal
template <class T>
std::vector<CommonPart<T>> common_parts(const Knots<T>& left, const Knots<T>& right, bool reversed,
                                        const T& tolerance = T(0)) {
  const T of_left = left.end() - left.begin(), of_right = right.end() - right.begin();
  const auto right_face = [&](Index j) { return reversed ? right.num_faces() - 1 - j : j; };
  // Where a face ends, as a parameter of the line, and back.
  const auto left_end = [&](Index i) -> const T& { return left.all()[left.span(i) + 1]; };
  const auto right_end = [&](Index j) -> const T& {
    const Index k = right.span(right_face(j));
    return right.all()[reversed ? k : k + 1];
  };
  const auto left_place = [&](Index i) { return T((left_end(i) - left.begin()) / of_left); };
  const auto right_place = [&](Index j) {
    const T from_begin = reversed ? right.end() - right_end(j) : right_end(j) - right.begin();
    return T(from_begin / of_right);
  };
  std::vector<CommonPart<T>> parts;
  T s(0), in_left = left.begin(), in_right = reversed ? right.end() : right.begin();
  for (Index i = 0, j = 0; i < left.num_faces() && j < right.num_faces();) {
    const T next_left = left_place(i), next_right = right_place(j);
    CommonPart<T> part{.left = {i, in_left, left_end(i)},
                       .right = {right_face(j), in_right, right_end(j)},
                       .begin = s,
                       .end = next_left};
    const bool left_first = next_left < next_right - tolerance, right_first = next_right < next_left - tolerance;
    if (left_first)
      part.right.to = reversed ? T(right.end() - next_left * of_right) : T(right.begin() + next_left * of_right);
    if (right_first) {
      part.end = next_right;
      part.left.to = left.begin() + next_right * of_left;
    }
    if (!right_first) ++i;
    if (!left_first) ++j;
    s = part.end, in_left = part.left.to, in_right = part.right.to;
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace sublimit
