// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/thinning.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;
constexpr double least_cosine = 0.5;  // between a triangle and the normals of its corners

/// Triangles by vertex, changed one collapse at a time.
class Collapsing {
 public:
  explicit Collapsing(const CurvatureMesh& mesh) : points_(mesh.points), around_(mesh.points.size()) {
    for (Index f = 0; f < mesh.num_faces(); ++f) {
      triangles_.push_back({mesh.triangles[3 * f], mesh.triangles[3 * f + 1], mesh.triangles[3 * f + 2]});
      for (const Index v : triangles_.back()) around_[v].push_back(f);
    }
  }

  /// Merges an inner vertex into a neighbour.
  /// @return  whether that was possible
  bool remove(Index v) {
    double before = 1;
    for (const Index f : around_[v]) before = std::min(before, cosine(triangles_[f]));
    Index best = -1;
    double best_cosine = std::min(least_cosine, before);
    for (const Index w : neighbours(v))
      if (const double c = cosine_after(v, w); c > best_cosine || (best < 0 && c == best_cosine)) {
        best = w;
        best_cosine = c;
      }
    if (best < 0) return false;
    merge(v, best);
    return true;
  }

  /// Triangles that are left.
  std::vector<std::array<Index, 3>> triangles() const {
    std::vector<std::array<Index, 3>> result;
    for (const std::array<Index, 3>& t : triangles_)
      if (t[0] >= 0) result.push_back(t);
    return result;
  }

 private:
  std::vector<Index> neighbours(Index v) const {
    std::vector<Index> result;
    for (const Index f : around_[v])
      for (const Index w : triangles_[f])
        if (w != v && std::find(result.begin(), result.end(), w) == result.end()) result.push_back(w);
    return result;
  }

  /// The least one, between the normal of a triangle and those of its corners.
  double cosine(const std::array<Index, 3>& t) const {
    const Vector3d a = points_[t[0]].position, b = points_[t[1]].position, c = points_[t[2]].position;
    const Vector3d normal = (b - a).cross(c - a).normalized();  // zero if the triangle is
    double least = 1;
    for (const Index v : t) least = std::min(least, normal.dot(points_[v].normal));
    return least;
  }

  /// The least one of all new triangles; -2 where v cannot go into w.
  double cosine_after(Index v, Index w) const {
    // The link condition: nothing but the two corners opposite to the edge sees both ends.
    const std::vector<Index> of_v = neighbours(v), of_w = neighbours(w);
    std::vector<Index> common;
    for (const Index x : of_v)
      if (std::find(of_w.begin(), of_w.end(), x) != of_w.end()) common.push_back(x);
    if (common.size() != 2) return -2;
    for (const Index x : common)
      if (around_[x].size() < 4) return -2;
    double least = 1;
    for (const Index f : around_[v]) {
      std::array<Index, 3> t = triangles_[f];
      if (std::find(t.begin(), t.end(), w) != t.end()) continue;
      std::replace(t.begin(), t.end(), v, w);
      least = std::min(least, cosine(t));
    }
    return least;
  }

  void merge(Index v, Index w) {
    for (const Index f : around_[v]) {
      std::array<Index, 3>& t = triangles_[f];
      if (std::find(t.begin(), t.end(), w) == t.end()) {
        std::replace(t.begin(), t.end(), v, w);
        around_[w].push_back(f);
      } else {
        for (const Index x : t)
          if (x != v) std::erase(around_[x], f);
        t = {-1, -1, -1};
      }
    }
    around_[v].clear();
  }

  const std::vector<SurfacePoint>& points_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<std::vector<Index>> around_;
};

}  // namespace

CurvatureMesh thinned(const CurvatureMesh& mesh, Index count) {
  if (count < 0) throw InvalidParameter("count is " + format_number(count) + "; it must be 0 or more");
  const Topology topology(view(mesh));
  std::vector<Index> order;  // of those that may go
  for (Index v = 0; v < mesh.num_vertices(); ++v)
    if (!mesh.original.empty() && !mesh.original[v] && !topology.is_boundary(Vertex{v})) order.push_back(v);
  const auto bending = [&](Index v) {
    const SurfacePoint& p = mesh.points[v];
    return p.k1 * p.k1 + p.k2 * p.k2;
  };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return bending(a) < bending(b); });

  Collapsing collapsing(mesh);
  Index left = mesh.num_vertices();
  for (bool progress = true; left > count && progress;) {  // what could not go may be free later
    progress = false;
    std::vector<Index> stay;
    for (const Index v : order)
      if (left > count && collapsing.remove(v)) {
        --left;
        progress = true;
      } else {
        stay.push_back(v);
      }
    order = std::move(stay);
  }

  const std::vector<std::array<Index, 3>> triangles = collapsing.triangles();
  std::vector<Index> number(mesh.points.size(), -1);
  for (const std::array<Index, 3>& t : triangles)
    for (const Index v : t) number[v] = 0;
  CurvatureMesh result;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (number[v] < 0) continue;
    number[v] = result.num_vertices();
    result.points.push_back(mesh.points[v]);
    if (!mesh.original.empty()) result.original.push_back(mesh.original[v]);
  }
  for (const std::array<Index, 3>& t : triangles)
    for (const Index v : t) result.triangles.push_back(number[v]);
  return result;
}

}  // namespace sublimit
