// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/line_search.h"

#include <algorithm>

#include "sublimit/patches/joins/golden_section.h"

namespace sublimit {

double curve_distance(const Eigen::Ref<const Points>& a, const Eigen::Ref<const Points>& b, bool reversed) {
  const auto largest = [&](const auto& differences) {
    return differences.rowwise().norm().template maxCoeff<Eigen::PropagateNaN>();
  };
  return reversed ? largest(a - b.colwise().reverse()) : largest(a - b);
}

NearestOnLine nearest_on_line(const std::function<Eigen::RowVector3d(double)>& curve,
                              const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& samples,
                              const Eigen::RowVector3d& point) {
  Eigen::Index nearest = 0;
  const double intervals = static_cast<double>(samples.rows() - 1);
  NearestOnLine best;
  best.distance = (samples.rowwise() - point).rowwise().norm().minCoeff(&nearest);
  best.s = static_cast<double>(nearest) / intervals;
  const auto at = [&](double s) {
    const double distance = (curve(s) - point).norm();
    if (distance < best.distance) best = {s, distance};
    return distance;
  };
  golden_section(at, std::max(best.s - 1 / intervals, 0.0), std::min(best.s + 1 / intervals, 1.0), 60);
  return best;
}

}  // namespace sublimit
