// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/spline_rows.h"

#include <utility>

#include "sublimit/core/detail/sparse_rows.h"

namespace sublimit {

PointRows point_rows(const Knots<double>& knots, const KnotPlace<double>& place, int order) {
  const Index width = knots.degree() + 1, first = knots.span(place.face) - knots.degree();
  std::array<double, 3 * (max_degree + 1)> rows;
  span_rows(knots, place.face, place.u, order, std::span<double>(rows).first((order + 1) * width));
  PointRows result;
  std::array<Index, max_degree + 1> points;
  for (Index i = 0; i < width; ++i) {
    points[i] = knots.point(first + i);
    for (int r = 0; r <= order; ++r)
      if (rows[r * width + i] != 0) {
        result.points.push_back(points[i]);
        break;
      }
  }
  std::ranges::sort(result.points);
  result.points.erase(std::unique(result.points.begin(), result.points.end()), result.points.end());
  result.weights = WeightRows::Zero(order + 1, std::ssize(result.points));
  for (Index i = 0; i < width; ++i) {
    const auto at = std::ranges::lower_bound(result.points, points[i]);
    if (at == result.points.end() || *at != points[i]) continue;
    for (int r = 0; r <= order; ++r) result.weights(r, at - result.points.begin()) += rows[r * width + i];
  }
  result.sides_differ = sides_differ(knots, place, order);
  return result;
}

bool sides_differ(const Knots<double>& knots, const KnotPlace<double>& place, int order) {
  if (place.u != 0 && place.u != 1) return false;
  const std::optional<int> smooth = knots.continuity(place.face, place.u == 0 ? KnotSide::left : KnotSide::right);
  return smooth && *smooth < order;
}

SparseMatrix point_matrix(const BandRows<double>& rows, const Knots<double>& knots) {
  SparseRows sums;
  sums.reserve(static_cast<size_t>(rows.size()), rows.weights.size());
  std::vector<SparseRows::Term> terms;
  for (Index r = 0; r < rows.size(); ++r) {
    terms.clear();
    for (Index i = 0; i < rows.width; ++i)
      if (const double weight = rows[r][i]; weight != 0) terms.push_back({knots.point(rows.first[r] + i), weight});
    // In the order of the functions where several are one point: the sums have the same bits everywhere.
    std::ranges::stable_sort(terms, {}, &SparseRows::Term::first);
    for (const auto& [point, weight] : terms) sums.add(point, weight);
    sums.end_row();
  }
  std::vector<SparseRows::Row> spans;
  for (size_t r = 0; r < sums.size(); ++r) spans.push_back(sums[r]);
  return matrix_of(spans, knots.num_points());
}

SparseMatrix refinement_matrix(const Knots<double>& coarse, const Knots<double>& fine) {
  return point_matrix(
      fine.degree() == coarse.degree() + 1 ? elevation_rows(coarse, fine) : refinement_rows(coarse, fine), coarse);
}

Knots<double> part_knots(const Knots<double>& whole, double first, double last) {
  const auto order = static_cast<size_t>(whole.degree()) + 1;
  std::vector<double> knots(order, first);
  for (const double t : whole.in_domain())
    if (first < t && t < last) knots.push_back(t);
  knots.insert(knots.end(), order, last);
  const auto points = static_cast<Index>(knots.size() - order);  // counted before they are moved
  return Knots<double>::open(whole.degree(), points, std::move(knots));
}

SparseMatrix part_matrix(const Knots<double>& whole, const Knots<double>& part) {
  const Index p = whole.degree();
  BandRows<double> rows{.width = p + 1};
  std::array<double, max_degree> points;
  for (Index j = 0; j < part.num_points(); ++j) {
    const Index face = whole.place(part.all()[j]).face;
    std::copy_n(part.all().begin() + j + 1, p, points.begin());
    blossom_row(whole, face, std::span<double>(points).first(size_t(p)), rows.add(whole.span(face) - p));
  }
  return point_matrix(rows, whole);
}

}  // namespace sublimit
