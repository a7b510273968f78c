// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/weighted_source.h"

#include <cmath>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

WeightedSource::WeightedSource(const PatchSet& patches, Eigen::VectorXd weights)
    : patches_(patches), weights_(std::move(weights)) {
  if (patches_.coordinates() != Coordinates::homogeneous)
    throw UnsupportedTopology("patches over plain points have no weights; they are linear as they are");
  if (weights_.size() != num_points())
    throw InvalidParameter(std::to_string(weights_.size()) + " weights of " + std::to_string(num_points()) +
                           " control points; one each is right");
  for (Eigen::Index i = 0; i < weights_.size(); ++i)
    if (!std::isfinite(weights_[i]) || weights_[i] == 0)
      throw InvalidParameter("the weight of point " + std::to_string(i) + " is " + format_number(weights_[i]) +
                             "; it must be finite, and not 0: that would be a direction, not a point");
}

LimitStencil WeightedSource::stencil(const Place& place, int order) const {
  LimitStencil stencil = patches_.stencil(place, order);
  if (stencil.weights.rows() == 0) return stencil;
  // R_i is the surface whose i-th point is 1, the others 0: all of them at once are one of as many dimensions.
  const auto n = std::ssize(stencil.vertices);
  Points columns = Points::Zero(n, n + 1);
  for (Eigen::Index i = 0; i < n; ++i) columns(i, i) = columns(i, n) = weights_[stencil.vertices[size_t(i)]];
  const RowValues values = row_values(stencil.weights, 2, std::move(columns), Coordinates::homogeneous);
  if (values.is_pole) return {.status = LimitStatus::pole, .vertices = {}, .weights = {}, .tangents = {}};
  stencil.weights = values.values;
  if (stencil.weights.rows() >= 3) stencil.tangents = stencil.weights.middleRows(1, 2);
  return stencil;
}

LimitSamples WeightedSource::evaluate(const Points& points, std::span<const Place> samples, int order,
                                      bool normals) const {
  return patches_.evaluate(homogeneous(points, weights_), samples, order, normals);
}

}  // namespace sublimit
