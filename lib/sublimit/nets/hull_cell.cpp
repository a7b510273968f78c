// SPDX-License-Identifier: Apache-2.0
#include "sublimit/nets/hull_cell.h"

#include <algorithm>
#include <cmath>

namespace sublimit {
namespace {

/// A box of the hull in some coordinates, widened.
Eigen::AlignedBox3d box_of(const Hull& hull, const Eigen::Matrix3d& frame, double margin, double of_width) {
  Eigen::AlignedBox3d box;
  double largest = 0;
  for (const Eigen::Vector3d& p : hull) {
    box.extend(frame * p);
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  // The hull is rounded as points of the surface are, and turned.
  const Eigen::Vector3d wider =
      margin * box.sizes() + Eigen::Vector3d::Constant(of_width * box.sizes().maxCoeff() + 1e-14 * largest);
  return {box.min() - wider, box.max() + wider};
}

/// The last direction is across the longest extent of the points and the longest one across that.
Eigen::Matrix3d frame_of(const Hull& hull) {
  const Eigen::Vector3d& from = hull.front();
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), z = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : hull)
    if ((p - from).squaredNorm() > x.squaredNorm()) x = p - from;
  for (const Eigen::Vector3d& p : hull)
    if (const Eigen::Vector3d c = x.cross(p - from); c.squaredNorm() > z.squaredNorm()) z = c;
  if (!(z.norm() > 0) || !std::isfinite(z.norm())) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d frame;
  frame.row(0) = x.normalized();
  frame.row(2) = z.normalized();
  frame.row(1) = frame.row(2).cross(frame.row(0));
  return frame.allFinite() ? frame : Eigen::Matrix3d::Identity();
}

}  // namespace

double LimitCell::squared_distance(const Eigen::Vector3d& point) const {
  return std::max(box.squaredExteriorDistance(point), own_box.squaredExteriorDistance(Eigen::Vector3d(frame * point)));
}

bool LimitCell::is_thin() const {
  constexpr double thin = 0.03;
  const Eigen::Vector3d size = own_box.sizes();
  return size[2] <= thin * std::max(size[0], size[1]);
}

LimitCell hull_cell(const Hull& hull, const Place& start, double radius, double margin, double of_width) {
  const Eigen::Matrix3d frame = frame_of(hull);
  return {start, radius, box_of(hull, Eigen::Matrix3d::Identity(), margin, of_width), frame,
          box_of(hull, frame, margin, of_width)};
}

bool turns(std::span<const Points> nets, bool triangle) {
  constexpr double least_cosine = 0.8;
  std::vector<Eigen::Vector3d> normals;
  for (const Points& net : nets) {
    const Eigen::Index n = net.rows();
    const int d =
        static_cast<int>(std::lround(triangle ? (std::sqrt(8.0 * double(n) + 1) - 3) / 2 : std::sqrt(double(n)) - 1));
    Eigen::Index row = 0;
    for (int i = 0; i <= d; ++i) {
      const int across = triangle ? d - i + 1 : d + 1;
      for (int j = 0; j < across; ++j, ++row) {
        if (i == d || j + 1 == across) continue;
        const Eigen::Vector3d x = net.row(row), u = net.row(row + across), v = net.row(row + 1);
        normals.push_back((u - x).cross(v - x));
      }
    }
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& n : normals) mean += n;
  return std::any_of(normals.begin(), normals.end(),
                     [&](const Eigen::Vector3d& n) { return n.dot(mean) < least_cosine * n.norm() * mean.norm(); });
}

}  // namespace sublimit
