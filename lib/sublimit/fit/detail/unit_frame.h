// SPDX-License-Identifier: Apache-2.0
#pragma once
// Coordinates in which targets are around the origin and have size 1, so that tolerances are meaningful. Since
// rows of limits sum to 1, fits commute with this map.
#include <algorithm>
#include <cmath>

#include "sublimit/fit/targets.h"

namespace sublimit {

/// Origin and unit of the coordinates.
struct UnitFrame {
  Eigen::RowVectorXd origin;
  double unit = 1;
  Points inside(const Points& points) const { return (points.rowwise() - origin) / unit; }
  Points outside(const Points& points) const { return (points * unit).rowwise() + origin; }
};

/// Returns the frame of the bounding box of the targets, or of that of the mesh if the targets are one point.
inline UnitFrame unit_frame(const std::vector<VertexTarget>& targets, const Points& mesh) {
  Points at(static_cast<Index>(targets.size()), 3);
  for (size_t i = 0; i < targets.size(); ++i) at.row(i) = targets[i].position;
  UnitFrame frame{.origin = Eigen::RowVector3d::Zero()};
  for (const Points* points : {static_cast<const Points*>(&at), &mesh}) {
    if (points->rows() == 0) continue;
    const Eigen::RowVectorXd low = points->colwise().minCoeff(), high = points->colwise().maxCoeff();
    frame.origin = low + (high - low) / 2;
    frame.unit = (high - low).norm();
    if (frame.unit > 0 && std::isfinite(frame.unit)) return frame;
  }
  frame.unit = 1;
  return frame;
}

}  // namespace sublimit
