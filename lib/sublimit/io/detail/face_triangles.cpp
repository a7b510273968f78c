// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/face_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace sublimit {
namespace {

constexpr std::size_t most_corners = 4096;  // ears take the square of their number

}  // namespace

double FaceTriangles::twice_area(Index a, Index b, Index c) const {
  const auto &p = flat_[static_cast<std::size_t>(a)], &q = flat_[static_cast<std::size_t>(b)],
             &r = flat_[static_cast<std::size_t>(c)];
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

bool FaceTriangles::fan(Index around) {
  triangles_.clear();
  const auto size = static_cast<Index>(flat_.size());
  for (Index i = 1; i + 1 < size; ++i) {
    const Corners corners{around, (around + i) % size, (around + i + 1) % size};
    if (!(twice_area(corners[0], corners[1], corners[2]) > 0)) return false;
    triangles_.push_back(corners);
  }
  return true;
}

bool FaceTriangles::holds_another(Index a, Index b, Index c) const {
  return std::ranges::any_of(left_, [&](Index i) {
    return i != a && i != b && i != c && twice_area(a, b, i) >= 0 && twice_area(b, c, i) >= 0 &&
           twice_area(c, a, i) >= 0;
  });
}

bool FaceTriangles::ears() {
  triangles_.clear();
  left_.resize(flat_.size());
  std::iota(left_.begin(), left_.end(), Index{0});
  for (std::size_t at = 0, misses = 0; left_.size() > 3;) {
    const std::size_t size = left_.size();
    if (misses++ == size) return false;
    at %= size;
    const Index a = left_[(at + size - 1) % size], b = left_[at], c = left_[(at + 1) % size];
    if (twice_area(a, b, c) > 0 && !holds_another(a, b, c)) {
      triangles_.push_back({a, b, c});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      misses = 0;
    }
    ++at;
  }
  triangles_.push_back({left_[0], left_[1], left_[2]});
  return twice_area(left_[0], left_[1], left_[2]) > 0;  // the rest of the area is in it, also where sides cross
}

std::span<const FaceTriangles::Corners> FaceTriangles::cut(const Points& points, std::span<const Index> vertices,
                                                           Index avoided) {
  const auto size = static_cast<Index>(vertices.size());
  const auto point = [&](Index i) {
    return Eigen::Vector3d(points.row(vertices[static_cast<std::size_t>(i % size)]).transpose());
  };
  const Eigen::Vector3d origin = point(0);
  double extent = 0;  // products of coordinates stay finite numbers relative to it
  for (Index i = 1; i < size; ++i) extent = std::max(extent, (point(i) / 2 - origin / 2).cwiseAbs().maxCoeff());
  const auto near = [&](Index i) { return Eigen::Vector3d((point(i) / 2 - origin / 2) / extent); };
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  if (extent > 0)
    for (Index i = 1; i + 1 < size; ++i) normal += near(i).cross(near(i + 1));
  Eigen::Index longest = 0;
  normal.cwiseAbs().maxCoeff(&longest);
  // The two other coordinates have the same areas up to a factor.
  const Eigen::Index u = (longest + 1) % 3, v = (longest + 2) % 3;
  const double side = normal[longest] < 0 ? -1 : 1;
  flat_.clear();
  for (Index i = 0; i < size; ++i) {
    const Eigen::Vector3d p = extent > 0 ? near(i) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    flat_.push_back({p[u], side * p[v]});
  }
  is_fan_ = true;
  const bool is_small = vertices.size() <= most_corners;
  Index last = -1;  // a fan that works, around the vertex to avoid
  for (Index around = 0; around < (is_small ? size : 1); ++around) {
    if (!fan(around)) continue;
    last = around;
    if (vertices[static_cast<std::size_t>(around)] != avoided) return triangles_;
  }
  if (last >= 0 && fan(last)) return triangles_;
  if (is_small && normal[longest] != 0 && ears()) {
    is_fan_ = false;
    return triangles_;
  }
  triangles_.clear();
  const Index around = vertices[0] == avoided ? 1 : 0;
  for (Index i = 1; i + 1 < size; ++i) triangles_.push_back({around, (around + i) % size, (around + i + 1) % size});
  return triangles_;
}

}  // namespace sublimit
