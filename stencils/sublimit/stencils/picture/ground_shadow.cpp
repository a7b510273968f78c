// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/ground_shadow.h"

#include <algorithm>
#include <vector>

#include "sublimit/stencils/picture/svg.h"

namespace sublimit::picture {

using svg::pixels;

std::string ground_shadow(const Panel& panel, const Frame& frame, const Camera& camera) {
  const double rise = camera.axes.row(2).dot(camera.up);  // sine of the elevation
  std::vector<Vector3d> points;
  for (const PictureMesh& mesh : panel.layers) {
    if (!mesh.faces) continue;
    for (Index v : mesh.face_vertices) points.push_back(frame.local(mesh.positions.row(v)));
  }
  if (points.empty() || rise < .05) return {};
  const auto height = [&](const Vector3d& p) { return p.dot(camera.up); };
  const auto by_height = [&](const Vector3d& p, const Vector3d& q) { return height(p) < height(q); };
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end(), by_height);
  const double low = height(*lowest), reach = .06 * (height(*highest) - low);
  Vector3d center = Vector3d::Zero();
  double count = 0, radius = 0;
  for (const Vector3d& p : points) {
    if (height(p) <= low + reach) center += p, ++count;
  }
  center /= count;
  for (const Vector3d& p : points) {
    const Vector3d d = p - center;
    if (height(p) <= low + reach) radius = std::max(radius, (d - d.dot(camera.up) * camera.up).norm());
  }
  const Projected middle = camera.project(camera.seen(center));
  const double across = 1.55 * radius * camera.scale;
  return "<ellipse cx=\"" + pixels(middle.x) + "\" cy=\"" + pixels(middle.y) + "\" rx=\"" + pixels(across) +
         "\" ry=\"" + pixels(across * rise) + "\" fill=\"url(#shadow)\"/>\n";
}

}  // namespace sublimit::picture
