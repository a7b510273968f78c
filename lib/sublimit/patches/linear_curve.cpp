// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/linear_curve.h"

#include <limits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {

CurveSamples CurveSource::evaluate(const Points& columns, std::span<const CurvePlace> samples, int order,
                                   Coordinates coordinates) const {
  check_order(order);
  const Eigen::Index dimension = columns.cols() - (coordinates == Coordinates::homogeneous ? 1 : 0);
  if (columns.rows() != num_points() || dimension < 1)
    throw InvalidParameter("columns are " + format_number(columns.rows()) + " x " + format_number(columns.cols()) +
                           "; one row is needed for each of " + format_number(num_points()) + " control points");
  for (size_t i = 0; i < samples.size(); ++i) check_place(samples[i], num_segments(), static_cast<std::int64_t>(i));
  CurveSamples out(std::ssize(samples), dimension, order);
  const auto fill = [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const CurveStencil found = stencil(samples[static_cast<size_t>(i)], order);
      const RowValues at = row_values(found.weights, 1, columns(found.unknowns, Eigen::all), coordinates);
      out.status[i] = at.is_pole ? LimitStatus::pole : found.status;
      if (at.is_pole) continue;
      out.order[i] = static_cast<std::int8_t>(order);
      out.position.row(i) = at.values.row(0);
      if (order >= 1) out.first.row(i) = at.values.row(1);
      if (order >= 2) out.second.row(i) = at.values.row(2);
      const double noise = order >= 1 ? 64 * std::numeric_limits<double>::epsilon() * at.sizes[1] : 0;
      out.set_normal(static_cast<Index>(i), noise);
    }
  };
  parallel_for_blocks(std::ssize(samples), fill, 256);
  return out;
}

}  // namespace sublimit
