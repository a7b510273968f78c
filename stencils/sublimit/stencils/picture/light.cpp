// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/light.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sublimit/stencils/picture/depth_buffer.h"

namespace sublimit::picture {
namespace {

/// How much of the sky every face sees: depth buffers from many directions, weighted by the cosine law and a brighter
/// zenith.
void light_from_sky(Scene& scene, const Camera& camera, int directions) {
  constexpr int size = 256;
  std::vector<double> seen(scene.faces.size(), 0), all(scene.faces.size(), 0);
  const Vector3d zenith = camera.seen(camera.up);
  std::vector<Projected> at(scene.points.size());
  for (int d = 0; d < directions; ++d) {
    const double z = 1 - (2 * d + 1) / static_cast<double>(directions), r = std::sqrt(1 - z * z);
    const double angle = d * std::numbers::pi * (3 - std::sqrt(5.));  // golden angle: evenly spread over the sphere
    const Vector3d to_light(r * std::cos(angle), r * std::sin(angle), z);
    const double weight = .65 + .35 * to_light.dot(zenith);
    const Vector3d right = to_light.unitOrthogonal(), upward = to_light.cross(right);
    constexpr double scale = size / 3.6;  // the scene lies in a sphere of radius sqrt(3)
    const auto project = [&](const Vector3d& p) {
      return Projected{size / 2. + scale * p.dot(right), size / 2. + scale * p.dot(upward), p.dot(to_light)};
    };
    DepthBuffer buffer(size, size);
    std::transform(scene.points.begin(), scene.points.end(), at.begin(), project);
    for (int f = 0; f < static_cast<int>(scene.faces.size()); ++f) {
      const SceneFace& face = scene.faces[f];
      if (!face.solid) continue;
      for_each_triangle(scene, face, at, project(face.center),
                        [&](const Projected& a, const Projected& b, const Projected& c) { buffer.draw(a, b, c, f); });
    }
    for (int f = 0; f < static_cast<int>(scene.faces.size()); ++f) {
      const SceneFace& face = scene.faces[f];
      const double cosine = face.normal.dot(to_light);
      if (cosine <= 0) continue;
      const Projected p = project(face.center + .03 * face.normal);
      const double w = weight * cosine;
      all[f] += w;
      const auto open = [&](int other, float near) { return other == f || near <= p.near + .02; };
      seen[f] += w * buffer.share_around(p.x, p.y, open);
    }
  }
  for (std::size_t f = 0; f < scene.faces.size(); ++f) scene.faces[f].light = all[f] > 0 ? seen[f] / all[f] : 0;

  // Means over the faces around a vertex, as far as they are smooth there, take the grain away.
  std::vector<std::vector<int>> around(scene.points.size());
  for (int f = 0; f < static_cast<int>(scene.faces.size()); ++f) {
    const SceneFace& face = scene.faces[f];
    for (int c = face.begin; c < face.end; ++c) around[scene.corners[c].point].push_back(f);
  }
  for (int pass = 0; pass < 6; ++pass) {
    for (const SceneFace& face : scene.faces) {
      for (int c = face.begin; c < face.end; ++c) {
        double sum = 0;
        int count = 0;
        for (int g : around[scene.corners[c].point]) {
          const SceneFace& other = scene.faces[g];
          if (&other != &face && other.normal.dot(face.normal) < crease_cosine) continue;
          sum += other.light;
          ++count;
        }
        scene.corners[c].light = sum / count;
      }
    }
    for (SceneFace& face : scene.faces) {
      if (face.flat && pass > 0) continue;
      double sum = 0;
      for (int c = face.begin; c < face.end; ++c) sum += scene.corners[c].light;
      face.light = sum / (face.end - face.begin);
    }
  }
}

/// Tone of a point: a key light from the upper left, a fill from the right, the sky, a soft highlight.
double tone(const Vector3d& point, const Vector3d& n, double light, bool back, const Camera& camera) {
  const Vector3d key = Vector3d(-.50, .62, .60).normalized(), fill = Vector3d(.85, .05, .5).normalized();
  const Vector3d eye =
      camera.distance > 0 ? Vector3d(Vector3d(0, 0, camera.distance) - point).normalized() : Vector3d::UnitZ();
  const double sky = .5 + .5 * n.dot(camera.seen(camera.up));
  const auto shine = [&](const Vector3d& from, double width) {
    return std::pow(std::max(0., n.dot((from + eye).normalized())), width);
  };
  const Vector3d window = Vector3d(-.85, .10, .75).normalized();
  const double value = .07 + light * (.20 * sky + .46 * std::max(0., n.dot(key)) + .12 * std::max(0., n.dot(fill)) +
                                      .28 * shine(key, 50) + .20 * shine(window, 45));
  return std::clamp(back ? .12 + .5 * value : value, 0., 1.) * (tones - 1);
}

void set_tones(Scene& scene, const Camera& camera) {
  for (SceneFace& face : scene.faces) {
    const int size = face.end - face.begin;
    for (int c = face.begin; c < face.end; ++c) {
      SceneCorner& corner = scene.corners[c];
      corner.tone = face.flat ? std::round(tone(face.center, face.normal, face.light, face.back, camera))
                              : tone(scene.point(c), corner.normal, corner.light, face.back, camera);
      face.tone += corner.tone / size;
    }
  }
}

}  // namespace

void light_scene(Scene& scene, const Camera& camera, int sky_directions) {
  light_from_sky(scene, camera, sky_directions);
  set_tones(scene, camera);
}

}  // namespace sublimit::picture
