// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/winding.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/search/intersect.h"

namespace sublimit {
namespace {

/// In turn, all over the sphere, and along no axis.
Eigen::Vector3d direction(int number) {
  const double z = 1 - 2 * std::fmod(0.37 + number / std::numbers::phi, 1), angle = 1 + 2.4 * number;
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Nothing if a hit touches the surface, or has no side.
std::optional<int> windings(const RayHits& hits, size_t ray, const Eigen::Vector3d& along) {
  constexpr double grazing = 1e-6;
  if (hits.undecided[ray] > 0) return std::nullopt;
  int turns = 0;
  for (auto k = Eigen::Index(hits.first[ray]); k < Eigen::Index(hits.first[ray + 1]); ++k) {
    const double side = hits.normals.row(k) * along;
    if (std::abs(side) < grazing) return std::nullopt;
    turns += side > 0 ? 1 : -1;
  }
  return turns;
}

}  // namespace

std::vector<int> winding_numbers(const PartedSurface& surface, const Points& queries) {
  if (const std::string why = surface.why_not_closed(); !why.empty())
    throw UnsupportedTopology("what is inside is known of closed surfaces alone: " + why);
  check_measurable(queries, "point to look from");
  std::vector<int> numbers(size_t(queries.rows()));
  std::vector<Eigen::Index> left(numbers.size());
  for (size_t i = 0; i < left.size(); ++i) left[i] = Eigen::Index(i);
  std::optional<Eigen::Index> given_up;  // of the last rays
  constexpr int most_directions = 12;
  for (int number = 0; number < most_directions && !left.empty(); ++number) {
    const Eigen::Vector3d along = direction(number);
    std::vector<Ray> rays;
    for (const Eigen::Index i : left) rays.push_back({queries.row(i).transpose(), along});
    const RayHits hits = intersect(surface, rays, {.all = true});
    std::vector<Eigen::Index> undecided;
    given_up.reset();
    for (size_t k = 0; k < left.size(); ++k) {
      if (const std::optional<int> turns = windings(hits, k, along)) {
        numbers[size_t(left[k])] = *turns;
        continue;
      }
      undecided.push_back(left[k]);
      const auto begin = hits.kinds.begin() + hits.first[k], end = hits.kinds.begin() + hits.first[k + 1];
      if (std::find(begin, end, HitKind::given_up) != end) given_up = left[k];
    }
    left = std::move(undecided);
  }
  if (given_up)
    throw AnalysisError("whether point " + std::to_string(*given_up) +
                        " is inside is not known: a ray from it was given up, as others were before");
  return numbers;  // points on the surface itself may be left: either side will do
}

}  // namespace sublimit
