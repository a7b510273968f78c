// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/curve_source.h"

#include <limits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/source/detail/stencil_matrices.h"

namespace sublimit {

CurveSamples CurveSource::evaluate(const Points& columns, std::span<const CurvePlace> places, int order,
                                   Coordinates coordinates) const {
  check_order(order);
  const Eigen::Index dimension = columns.cols() - (coordinates == Coordinates::homogeneous ? 1 : 0);
  if (columns.rows() != num_unknowns() || dimension < 1)
    throw InvalidParameter("columns are " + format_number(columns.rows()) + " x " + format_number(columns.cols()) +
                           "; one row is needed for each of " + format_number(num_points()) + " control points" +
                           (unknowns_per_point() > 1 ? ", and one for each derivative there" : ""));
  for (size_t i = 0; i < places.size(); ++i) check_place(places[i], num_segments(), static_cast<std::int64_t>(i));
  CurveSamples out(std::ssize(places), dimension, order);
  const auto fill = [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    fill_samples(places.subspan(size_t(begin), size_t(end - begin)), columns, coordinates, Index(begin), out);
  };
  parallel_for_blocks(std::ssize(places), fill, 256);
  return out;
}

void CurveSource::fill_samples(std::span<const CurvePlace> places, const Points& columns, Coordinates coordinates,
                               Index first, CurveSamples& out) const {
  for (Index row = first; const CurvePlace& place : places) {
    const CurveStencil found = stencil(place, out.derivatives());
    const RowValues at =
        row_values(found.weights, 1, columns(found.unknowns, Eigen::all), coordinates, unknowns_per_point() == 1);
    out.status[row] = at.is_pole ? LimitStatus::pole : found.status;
    for (Eigen::Index k = 0; k < at.values.rows(); ++k) out.part(int(k)).row(row) = at.values.row(k);
    if (!at.is_pole) out.order[row] = static_cast<std::int8_t>(found.weights.rows() - 1);
    if (out.order[row] > 0) out.set_normal(row, 64 * std::numeric_limits<double>::epsilon() * at.sizes[1]);
    ++row;
  }
}

std::vector<CurvePlace> CurveSource::grid(int N) const {
  if (N < 2) throw InvalidParameter("a grid of " + std::to_string(N) + " has no two ends; it must be 2 or more");
  std::vector<CurvePlace> places;
  places.reserve(static_cast<size_t>(num_segments()) * N);
  for (Index segment = 0; segment < num_segments(); ++segment)
    for (int i = 0; i < N; ++i) places.push_back({segment, static_cast<double>(i) / (N - 1)});
  return places;
}

PlaceStencils place_stencils(const CurveSource& curve, std::span<const CurvePlace> places, int derivatives) {
  return stencil_matrices(curve, places, derivatives, &CurveStencil::unknowns, derivatives + 1, curve.num_unknowns());
}

}  // namespace sublimit
