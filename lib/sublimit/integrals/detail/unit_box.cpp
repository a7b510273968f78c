// SPDX-License-Identifier: Apache-2.0
#include "sublimit/integrals/detail/unit_box.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// By a power of two, so that squares and fifth powers of coordinates neither overflow nor vanish.
double power_of_two(double size) { return size > 0 ? std::exp2(std::ilogb(size)) : 1; }

/// What a number or a matrix of numbers is where lengths are so much larger. One by one, so that 0 stays 0.
template <class T>
T scaled(T value, double scale, int power) {
  for (int k = 0; k < power; ++k) value *= scale;
  return value;
}

/// @throws InvalidMesh  some of them are larger than numbers are, naming the control point that is farthest out
void check_range(const LimitIntegrals& found, const Points& points) {
  const char* what = !std::isfinite(found.area) || !std::isfinite(found.area_error) ? "area" : "";
  if (const std::optional<SolidIntegrals>& solid = found.solid) {
    if (!std::isfinite(solid->inertia_error) || !solid->inertia.allFinite()) what = "inertia";
    if (!std::isfinite(solid->volume_error) || !std::isfinite(solid->volume)) what = "volume";
  }
  if (*what == 0) return;
  Eigen::Index row = 0, column = 0;
  points.cwiseAbs().maxCoeff(&row, &column);
  throw InvalidMesh("control point " + std::to_string(row) + " has the coordinate " +
                    format_number(points(row, column)) + ", and the " + what +
                    " of the limit is larger than numbers are (1.8e308); give points in another unit of length");
}

SolidIntegrals solid_of(const EstimatedSums& sums) {
  const SurfaceSums &value = sums.value, &error = sums.error;
  SolidIntegrals solid;
  solid.volume = value.volume;
  solid.centroid = value.first / value.volume;
  const Eigen::Matrix3d central = value.second - value.volume * solid.centroid * solid.centroid.transpose();
  solid.inertia = central.trace() * Eigen::Matrix3d::Identity() - central;
  const double first = error.first.norm(), distance = solid.centroid.norm();
  solid.volume_error = error.volume;
  solid.centroid_error = (first + distance * error.volume) / std::abs(value.volume);
  // The error of `central`, four times: its trace has at most sqrt(3) times its norm, and the identity has sqrt(3).
  solid.inertia_error = 4 * (error.second.norm() + 2 * distance * first + distance * distance * error.volume);
  return solid;
}

}  // namespace

UnitBox::UnitBox(const Points& points)
    : middle_(points.colwise().minCoeff() / 2 + points.colwise().maxCoeff() / 2),
      scale_(power_of_two((points.rowwise() - middle_).cwiseAbs().maxCoeff())) {}

LimitIntegrals UnitBox::integrals(const EstimatedSums& sums, std::string why_no_solid, const Points& points) const {
  LimitIntegrals result;
  const SurfaceSums& value = sums.value;
  result.area = scaled(value.area, scale_, 2);
  result.area_error = scaled(sums.error.area, scale_, 2);
  if (value.area > 0) {
    const Eigen::Vector3d centroid = value.of_area / value.area;
    result.centroid = middle_.transpose() + scale_ * centroid;
    result.centroid_error = scale_ * (sums.error.of_area.norm() + centroid.norm() * sums.error.area) / value.area;
  }
  result.why_no_solid = std::move(why_no_solid);
  if (result.why_no_solid.empty() && std::abs(value.volume) <= std::max(1e-13 * value.area, sums.error.volume))
    result.why_no_solid = "the surface encloses no volume";
  if (result.why_no_solid.empty()) {
    SolidIntegrals solid = solid_of(sums);
    solid.volume = scaled(solid.volume, scale_, 3);
    solid.volume_error = scaled(solid.volume_error, scale_, 3);
    solid.centroid = middle_.transpose() + scale_ * solid.centroid;
    solid.centroid_error *= scale_;
    solid.inertia = scaled(solid.inertia, scale_, 5);
    solid.inertia_error = scaled(solid.inertia_error, scale_, 5);
    result.solid = solid;
  }
  check_range(result, points);
  return result;
}

LimitIntegrals no_faces() {
  LimitIntegrals result;
  result.why_no_solid = "there are no faces";
  return result;
}

}  // namespace sublimit
