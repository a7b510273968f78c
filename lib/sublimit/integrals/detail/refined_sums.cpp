// SPDX-License-Identifier: Apache-2.0
#include "sublimit/integrals/detail/refined_sums.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/integrals/detail/sequence_limit.h"
#include "sublimit/scheme/detail/check_levels.h"

namespace sublimit {
namespace {

void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, SurfaceSums& sums) {
  const Eigen::Vector3d N = (b - a).cross(c - a), sum = a + b + c;
  const double area = N.norm() / 2, flux = a.dot(N);
  sums.area += area;
  sums.of_area += area / 3 * sum;
  sums.volume += flux / 6;
  sums.first += flux / 24 * sum;
  sums.second += flux / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
}

/// A face, cut into triangles around its centroid unless it is one.
void add_face(std::span<const Index> corners, const Points& x, SurfaceSums& sums) {
  const auto point = [&](size_t i) -> Eigen::Vector3d { return x.row(corners[i % corners.size()]); };
  if (corners.size() == 3) return add_triangle(point(0), point(1), point(2), sums);
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < corners.size(); ++i) centroid += point(i) / double(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) add_triangle(point(i), point(i + 1), centroid, sums);
}

SurfaceSums sums_of(const Level& level, const Points& x) {
  const Topology& t = level.topology();
  std::vector<SurfaceSums> blocks(size_t(num_blocks(t.num_faces())));
  parallel_for_blocks(t.num_faces(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t f = begin; f < end; ++f)
      if (level.holes.empty() || !level.holes[size_t(f)])
        add_face(t.vertices(Face{Index(f)}), x, blocks[size_t(block)]);
  });
  SurfaceSums sums;
  for (const SurfaceSums& block : blocks) sums += block;
  return sums;
}

/// What sums of levels, two at least, tend to, and twice as much as the last one has moved that.
/// @param period  of levels that are alike
EstimatedSums extrapolated(const std::vector<SurfaceSums::Numbers>& levels, int period) {
  const int last = int(levels.size()) - 1;
  SurfaceSums::Numbers value, error;
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    const auto limit = [&](int level) {  // of those up to this level
      std::vector<double> s;
      for (int k = level % period; k <= level; k += period) s.push_back(levels[size_t(k)][i]);
      return sequence_limit(s);
    };
    value[i] = limit(last);
    error[i] = 2 * std::abs(value[i] - limit(last - 1));
    // Else levels that agree by chance would be believed.
    if (last > 1) error[i] = std::max(error[i], std::abs(value[i] - limit(last - 2)) / 2);
  }
  return {SurfaceSums::of(value), SurfaceSums::of(error)};
}

/// Faces that lie on several of those before leave no region to a hole: it is another one on each level.
void check_holes(const Level& control, const Scheme<double>& scheme) {
  if (std::ranges::find(control.holes, true) == control.holes.end()) return;
  for (const Step<double>& step : scheme.steps)
    if (!is_primal(step.split))
      throw UnsupportedTopology(scheme.name +
                                ": holes are no whole faces of its levels, so what they leave of a limit that is not "
                                "made of polynomials has no area; leave these faces out of the mesh");
}

}  // namespace

EstimatedSums refined_sums(const Level& control, const Points& points, const Scheme<double>& scheme,
                           const RefinedSumsOptions& options) {
  check_holes(control, scheme);
  constexpr int least_levels = 2;
  std::vector<SurfaceSums::Numbers> found;
  Level made;
  const Level* level = &control;
  Points x = points;
  double faces_before = control.topology().num_faces();
  while (true) {
    found.push_back(sums_of(*level, x).numbers());
    const double faces = level->topology().num_faces();
    if (found.size() > least_levels) {
      const EstimatedSums sums = extrapolated(found, scheme.period);
      if (sums.error.numbers().maxCoeff() <= options.enough * sums.value.area ||
          faces * faces / faces_before > double(options.most_faces))
        return sums;
    }
    faces_before = faces;
    check_levels(scheme, level->topology(), 1);
    Level next = next_level(scheme, *level);
    x = next.S * x;
    made = std::move(next);
    level = &made;
  }
}

}  // namespace sublimit
