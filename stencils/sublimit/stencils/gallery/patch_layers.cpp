// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/patch_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>

#include "sublimit/stencils/picture/camera.h"

namespace sublimit::gallery {
namespace {

constexpr Color net_ink{.50, .30, .20}, data_ink{.78, .14, .12};

using Edges = std::set<std::array<Index, 2>>;

Edges edges_of(const Patch::Net& net) {
  Edges edges;
  size_t first = 0;
  for (const Index size : net.sizes) {
    for (Index i = 0; i < size; ++i) {
      const auto [a, b] =
          std::minmax(net.vertices[first + size_t(i)], net.vertices[first + size_t(i + 1 < size ? i + 1 : 0)]);
      edges.insert({a, b});
    }
    first += size_t(size);
  }
  return edges;
}

/// Of the lattice of a triangle's control points.
Edges edges_of_triangle(Index degree) {
  Edges edges;
  const auto at = [&](Index j, Index k) { return k * (degree + 1) - k * (k - 1) / 2 + j; };
  for (Index k = 0; k < degree; ++k)
    for (Index j = 0; j + k < degree; ++j) {
      edges.insert({at(j, k), at(j + 1, k)});
      edges.insert({at(j, k), at(j, k + 1)});
      edges.insert({at(j + 1, k), at(j, k + 1)});
    }
  return edges;
}

Points euclidean(const Points& columns, Coordinates coordinates) {
  if (coordinates == Coordinates::plain) return columns;
  return columns.leftCols(3).array().colwise() / columns.col(3).array();
}

PictureMesh net_lines(const Points& columns, Coordinates coordinates, const Edges& edges) {
  PictureMesh lines;
  lines.faces = false;
  lines.ink = {net_ink, .9};
  lines.positions = euclidean(columns, coordinates);
  for (const auto& [a, b] : edges) lines.creases.push_back({a, b});
  for (Index i = 0; i < columns.rows(); ++i) lines.dots.push_back(i);
  lines.dot_size = .42;
  return lines;
}

}  // namespace

PictureMesh surface_layer(const SampledSurface& surface) {
  const int n = std::clamp(static_cast<int>(28 / std::sqrt(surface.faces.size)), 4, 28);
  const bool triangles = surface.faces.triangles;
  const LimitSamples samples = surface.at(grid_places(surface.faces, n + 1));
  const Index per_face = triangles ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1);
  PictureMesh mesh;
  mesh.positions = samples.position;
  mesh.vertex_normals = samples.normal;
  for (Index f = 0; f < surface.faces.size; ++f) {
    const auto at = [&](int i, int j) {
      return f * per_face + (triangles ? j * (n + 1) - j * (j - 1) / 2 : j * (n + 1)) + i;
    };
    const auto add = [&](std::initializer_list<Index> corners) {
      mesh.face_sizes.push_back(static_cast<Index>(corners.size()));
      mesh.face_vertices.insert(mesh.face_vertices.end(), corners);
    };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < (triangles ? n - j : n); ++i) {
        if (!triangles) {
          add({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
          continue;
        }
        add({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < n) add({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    for (int i = 0; i < n; ++i) {
      mesh.creases.push_back({at(i, 0), at(i + 1, 0)});
      mesh.creases.push_back({at(0, i), at(0, i + 1)});
      if (triangles) {
        mesh.creases.push_back({at(n - i, i), at(n - i - 1, i + 1)});
      } else {
        mesh.creases.push_back({at(i, n), at(i + 1, n)});
        mesh.creases.push_back({at(n, i), at(n, i + 1)});
      }
    }
  }
  return mesh;
}

PictureMesh net_layer(const SplineNet& net) {
  return net_lines(net.columns, net.coordinates, edges_of(net.surface->net()));
}

PictureMesh triangle_net_layer(Index degree, const Points& columns, Coordinates coordinates) {
  return net_lines(columns, coordinates, edges_of_triangle(degree));
}

PictureMesh data_layer(const PatchData& data, double normal_length) {
  Strokes lines(data_ink, 1.7);
  for (const Points& curve : data.curves) lines.polyline(curve);
  std::vector<Index> dots;
  for (Index i = 0; i < data.points.rows(); ++i) {
    dots.push_back(lines.add(data.points.row(i)));
    if (i >= data.normals.rows()) continue;
    lines.line(dots.back(), lines.add(data.points.row(i) + normal_length * data.normals.row(i).normalized()));
  }
  PictureMesh mesh = lines.mesh();
  mesh.dots = dots;
  mesh.dot_size = .7;
  return mesh;
}

void fit_window(std::vector<PictureMesh>& layers, const PictureOptions& view) {
  const Eigen::Matrix3d axes = picture::Camera(view).axes;  // right, up, towards the eye
  Eigen::RowVector3d low = Eigen::RowVector3d::Constant(1e300), high = -low;
  for (const PictureMesh& mesh : layers) {
    const Points seen = mesh.positions * axes.transpose();
    low = low.cwiseMin(seen.colwise().minCoeff());
    high = high.cwiseMax(seen.colwise().maxCoeff());
  }
  const Eigen::RowVector3d center = (low + high) / 2 * axes, half = (high - low) / 2;
  const double size = std::max({half.x() * view.panel_height / view.panel_width, half.y(), half.z() / 1.5});
  for (PictureMesh& mesh : layers) mesh.positions = (mesh.positions.rowwise() - center) / size;
}

}  // namespace sublimit::gallery
