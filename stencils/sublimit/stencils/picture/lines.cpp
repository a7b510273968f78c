// SPDX-License-Identifier: Apache-2.0
// Lines and dots as SVG, as far as no face is in front of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sublimit/stencils/picture/color.h"
#include "sublimit/stencils/picture/panel.h"

namespace sublimit::picture {
namespace {

// Difference in depth, in a scene of radius 1 to sqrt(3), up to which a line is taken to be on a face.
constexpr double line_gap = .005;

bool visible(const SeenPanel& seen, const Projected& p, const std::vector<int>& own) {
  const auto ours = [&](int face, float near) {
    return near <= p.near + line_gap || std::find(own.begin(), own.end(), face) != own.end();
  };
  return seen.buffer.share_around(p.x * supersampling, p.y * supersampling, ours) > 0;
}

void add_visible(const SeenPanel& seen, svg::Path& path, int tail, int head, const std::vector<int>& own) {
  const Projected &a = seen.at[tail], &b = seen.at[head];
  const int steps = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y))));
  const auto between = [&](double t) {
    return Projected{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.near + t * (b.near - a.near)};
  };
  for (int i = 0; i < steps;) {
    const auto shown = [&](int k) { return visible(seen, between((k + .5) / steps), own); };
    const int begin = i;
    while (i < steps && shown(i)) ++i;
    if (i > begin) {
      path.move(spot(between(static_cast<double>(begin) / steps)));
      path.line(spot(between(static_cast<double>(i) / steps)));
    } else {
      ++i;
    }
  }
}

void write_stroke(std::string& svg, const Color& color, int width, double opacity, const std::string& data) {
  if (data.empty()) return;
  svg += "<path fill=\"none\" stroke-linecap=\"round\" stroke=\"" + hex(color) + "\" stroke-width=\"" +
         std::to_string(width) + "\"";
  if (opacity < 1) svg += " stroke-opacity=\"" + svg::pixels(opacity) + "\"";
  svg += " d=\"" + data + "\"/>\n";
}

}  // namespace

void write_lines(std::string& svg, const SeenPanel& seen, int layer) {
  const PictureMesh& mesh = seen.panel.layers[layer];
  std::map<std::pair<int, int>, std::vector<int>> edge_faces;
  std::map<int, std::vector<int>> vertex_faces;
  for (int f = 0; f < static_cast<int>(seen.scene.faces.size()); ++f) {
    const SceneFace& face = seen.scene.faces[f];
    if (face.layer != layer) continue;
    for (int c = face.begin; c < face.end; ++c) {
      const int a = seen.scene.corners[c].point, b = seen.scene.corners[seen.scene.next(face, c)].point;
      edge_faces[std::minmax(a, b)].push_back(f);
      vertex_faces[a].push_back(f);
    }
  }
  const auto faces_of = [&](int a, int b) {
    const auto found = edge_faces.find(std::minmax(a, b));
    return found == edge_faces.end() ? std::vector<int>{} : found->second;
  };
  if (mesh.wireframe) {
    svg::Path path;
    for (const auto& [edge, faces] : edge_faces) add_visible(seen, path, edge.first, edge.second, faces);
    write_stroke(svg, ramp(mesh.color, .05), mesh.faces ? 5 : 7, .6, path.data());
  }
  const int first = seen.scene.first_point[layer];
  std::map<double, svg::Path> creases;
  for (const PictureMesh::Line& line : mesh.creases) {
    add_visible(seen, creases[mesh.ink ? 0 : line.strength], first + line.tail, first + line.head,
                faces_of(first + line.tail, first + line.head));
  }
  for (const auto& [strength, path] : creases) {
    if (mesh.ink) {
      write_stroke(svg, mesh.ink->color, static_cast<int>(std::lround(svg::units * mesh.ink->width)), 1, path.data());
      continue;
    }
    write_stroke(svg, mix({.95, .62, .15}, {.80, .16, .12}, strength),
                 static_cast<int>(std::lround(14 + 10 * strength)), 1, path.data());
  }
  svg::Path dots;
  for (Index v : mesh.dots) {
    const Projected& p = seen.at[first + v];
    const auto near = vertex_faces.find(first + v);
    if (visible(seen, p, near == vertex_faces.end() ? std::vector<int>{} : near->second)) dots.dot(spot(p));
  }
  const auto dot = [&](double width) { return static_cast<int>(std::lround(width * mesh.dot_size)); };
  write_stroke(svg, {1, 1, 1}, dot(66), 1, dots.data());
  write_stroke(svg, {.10, .12, .22}, dot(46), 1, dots.data());
}

}  // namespace sublimit::picture
