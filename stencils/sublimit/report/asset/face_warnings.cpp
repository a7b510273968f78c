// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "sublimit/report/asset/warnings.h"

namespace sublimit::asset {
namespace {

using Eigen::Vector3d;
using Severity = AssetWarning::Severity;

struct Shape {
  Vector3d area = Vector3d::Zero();  ///< twice, along the normal
  Vector3d middle = Vector3d::Zero();
  double size = 0;  ///< square of the longest edge
  int turned = 0;   ///< corners that turn the other way
};

Shape shape(const Topology& t, Face f, const Points& points) {
  Shape s;
  const std::span<const Index> v = t.vertices(f);
  const Vector3d origin = points.row(v[0]);
  const size_t n = v.size();
  const auto at = [&](size_t i) { return Vector3d(points.row(v[i % n])); };
  for (size_t i = 0; i < n; ++i) {
    s.area += (at(i) - origin).cross(at(i + 1) - origin);
    s.middle += at(i) / double(n);
    s.size = std::max(s.size, (at(i + 1) - at(i)).squaredNorm());
  }
  for (size_t i = 0; i < n; ++i)
    s.turned += (at(i + 1) - at(i)).cross(at(i + n - 1) - at(i)).dot(s.area) < -1e-9 * s.size * s.area.norm();
  return s;
}

}  // namespace

std::vector<AssetWarning> face_warnings(const Level& level, const Points& points, Index listed) {
  const Topology& t = level.topology();
  WarningGroup empty(Severity::error, "face without area", "move its points apart, or take the face out"),
      crossing(Severity::warning, "quadrilateral that crosses itself", "order its corners around the face"),
      concave(Severity::hint, "concave face", "move the corner that points inwards, or cut the face there"),
      folded(Severity::warning, "face folded back onto its neighbour",
             "turn the edge, or move its points so that the angle between the faces opens");
  std::vector<Shape> shapes(t.num_faces());
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (level.holes[f]) continue;
    const Shape& s = shapes[f] = shape(t, Face{f}, points);
    if (s.area.norm() <= 1e-12 * s.size)
      empty.add_face(f, s.middle, listed);
    else if (t.size(Face{f}) == 4 && s.turned >= 2)
      crossing.add_face(f, s.middle, listed);
    else if (s.turned > 0)
      concave.add_face(f, s.middle, listed);
  }
  for (Index e = 0; e < t.num_edges(); ++e) {
    const HalfEdge h = t.half_edge(Edge{e});
    if (!exists(t.twin(h)) || is_infinite(level.sharpness.edge[e])) continue;
    const Index f = index(t.face(h)), g = index(t.face(t.twin(h)));
    if (f == g || level.holes[f] || level.holes[g]) continue;
    const Vector3d a = shapes[f].area, b = shapes[g].area;
    if (a.norm() <= 1e-12 * shapes[f].size || b.norm() <= 1e-12 * shapes[g].size) continue;
    if (a.normalized().dot(b.normalized()) < std::cos(170 * std::numbers::pi / 180))
      folded.add_face(f, shapes[f].middle, listed);
  }
  std::vector<AssetWarning> result;
  for (const WarningGroup* group : {&empty, &crossing, &folded, &concave}) group->put_into(result);
  return result;
}

}  // namespace sublimit::asset
