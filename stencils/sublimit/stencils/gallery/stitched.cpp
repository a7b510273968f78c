// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/stitched.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "sublimit/io/detail/obj.h"
#include "sublimit/patches/detail/interval_mesh.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/gallery/patch_exhibits.h"
#include "sublimit/stencils/gallery/patch_layers.h"
#include "sublimit/stencils/picture/picture_mesh.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::gallery {
namespace {

constexpr Index lid_points = 6, seam_points = 11, wall_rows = 5;
constexpr Color lid_color{.42, .60, .70}, wall_color{.74, .58, .42}, both_color{.50, .62, .52},
    net_color{.55, .35, .25};

/// Knots with these distances between the control points of a cubic.
Knots<double> cubic_knots(const std::vector<double>& intervals) {
  // Control point k is at knot k + 2; beyond the ends intervals are mirrored.
  std::vector<double> knots{-2 * intervals.front(), -intervals.front(), 0};
  for (const double d : intervals) knots.push_back(knots.back() + d);
  for (int i = 0; i < 2; ++i) knots.push_back(knots.back() + intervals.back());
  return Knots<double>::open(3, static_cast<Index>(intervals.size()) + 1, knots);
}

/// A surface, its control points, u fastest, and where these are in the mesh.
struct Part {
  SplineSurface surface;
  Points points;
  std::vector<Index> vertices;
};

// The first two and the last two are equal, as those of surfaces without multiple end knots in a mesh are.
const std::vector<double> lid_u{1, 1, 2, 1.5, 1.5}, lid_v{0.5, 0.5, 1, 3, 3}, wall_v{2, 2, 1, 1};

Part lid() {
  Part part{{cubic_knots(lid_u), cubic_knots(lid_v)}, Points(lid_points * lid_points, 3), {}};
  for (Index j = 0; j < lid_points; ++j)
    for (Index i = 0; i < lid_points; ++i) {
      const double x = double(i), y = double(j);
      part.points.row(j * lid_points + i) << x, y, 0.4 * std::sin(1.1 * x) * std::sin(0.9 * y);
      part.vertices.push_back(j * lid_points + i);
    }
  return part;
}

/// Point k of the seam, which goes up the lid's right side and back along the upper one.
Index seam(Index k) {
  const Index last = lid_points - 1;
  return k <= last ? k * lid_points + last : last * lid_points + 2 * last - k;
}

Part wall(const Part& lid) {
  // It sees the lid from the other side, so it runs along the seam backwards.
  std::vector<double> along(lid_u.begin(), lid_u.end());
  along.insert(along.end(), lid_v.rbegin(), lid_v.rend());
  Part part{{cubic_knots(along), cubic_knots(wall_v)}, Points(seam_points * wall_rows, 3), {}};
  for (Index row = 0; row < wall_rows; ++row)
    for (Index b = 0; b < seam_points; ++b) {
      const Index k = seam_points - 1 - b, corner = lid_points - 1;
      const Index vertex = row == 0 ? seam(k) : lid_points * lid_points + (row - 1) * seam_points + b;
      Eigen::RowVector3d x = lid.points.row(seam(k));
      if (row > 0) {
        const Eigen::RowVector3d out(k <= corner ? 1 : 0, k >= corner ? 1 : 0, 0);
        x += 0.8 * out - Eigen::RowVector3d(0, 0, x.z() + 0.9 * double(row));
      }
      part.points.row(row * seam_points + b) = x;
      part.vertices.push_back(vertex);
    }
  return part;
}

/// Adds the faces and intervals of a part; those that are no longer beside a border are no holes any more.
void add(const Part& part, Mesh& mesh) {
  const IntervalMesh own = interval_mesh(part.surface);
  const Points points = own.from_points * part.points;
  for (size_t i = 0; i < part.vertices.size(); ++i) mesh.positions.row(part.vertices[i]) = points.row(Index(i));
  mesh.face_sizes.insert(mesh.face_sizes.end(), own.mesh.face_sizes.begin(), own.mesh.face_sizes.end());
  for (const Index v : own.mesh.face_vertices) mesh.face_vertices.push_back(part.vertices[v]);
  for (const Mesh::KnotInterval& d : own.mesh.knot_intervals)
    mesh.knot_intervals.push_back({part.vertices[d.tail], part.vertices[d.head], d.length});
}

PictureMesh surface_of(const Part& part, Color color) {
  const auto patches = std::make_shared<PatchSet>(
      std::vector<std::shared_ptr<const Patch>>{std::make_shared<SplineSurface>(part.surface)});
  PictureMesh mesh =
      surface_layer({patches->faces(), [patches, points = part.points](const std::vector<Place>& samples) {
                       return patches->evaluate(points, samples, 1);
                     }});
  mesh.color = color;
  mesh.ink = {Color{.20, .26, .30}, .6};
  return mesh;
}

PictureMesh net_of(const Mesh& mesh) {
  const Scheme<double> scheme = sublimit::scheme(stitched_scheme);
  PictureMesh wire = wire_picture(control_level(scheme, mesh), mesh.positions);
  wire.faces = false;
  wire.color = net_color;
  return wire;
}

/// How far the limit is from the surface on its faces: the faces where it is the same, and the largest distance on the
/// others.
std::pair<Index, double> deviation(const Part& part, const Mesh& mesh, Index first_face) {
  const LimitMap limit(sublimit::scheme(stitched_scheme), mesh);
  const PatchSet patches({std::make_shared<SplineSurface>(part.surface)});
  const std::vector<Index> faces = interval_mesh(part.surface).faces;
  Index same = 0;
  double largest = 0;
  for (Index f = 0; f < std::ssize(faces); ++f) {
    constexpr int n = 5;
    std::vector<Place> own, on_mesh;
    for (int i = 0; i < n * n; ++i) {
      own.push_back({f, (i % n) / (n - 1.0), (i / n) / (n - 1.0)});
      on_mesh.push_back({first_face + faces[f], own.back().u, own.back().v});
    }
    const Points a = patches.evaluate(part.points, own).position, b = limit.evaluate(mesh.positions, on_mesh).position;
    const double distance = (a - b).rowwise().norm().maxCoeff();
    constexpr double rounding = 1e-13;
    same += distance <= rounding;
    largest = std::max(largest, distance);
  }
  return {same, largest};
}

}  // namespace

Mesh stitched_mesh() {
  const Part top = lid(), side = wall(top);
  Mesh mesh;
  mesh.positions = Points::Zero(lid_points * lid_points + (wall_rows - 1) * seam_points, 3);
  mesh.boundary = Boundary::none;
  add(top, mesh);
  add(side, mesh);
  return mesh;
}

GalleryPart stitched_pictures(const std::function<std::string(const Mesh&, const std::string&)>& report) {
  const Part top = lid(), side = wall(top);
  const Mesh mesh = stitched_mesh();
  const Scheme<double> scheme = sublimit::scheme(stitched_scheme);
  LimitCache types(scheme);
  constexpr int drawn_level = 3;
  std::vector<Level> levels = refine(scheme, mesh, drawn_level);
  Points points = mesh.positions;
  for (size_t k = 1; k < levels.size(); ++k) points = levels[k].S * points;
  const LimitMatrices matrices = limit_matrices(levels, types);
  const LimitPoints limit = limit_points(matrices, levels.back().topology(), points);
  PictureMesh whole = surface_picture(limit_mesh(levels.back(), matrices, limit, Normals::per_corner));
  whole.color = both_color;

  const std::vector<Panel> panels{
      {{surface_of(top, lid_color), surface_of(side, wall_color)}, "two surfaces", "bicubic, of unequal knots"},
      {{whole, net_of(mesh)}, "one mesh", "with their intervals"},
      {{whole}, "its limit", "a vertex of three faces where they meet"}};
  GalleryPart result;
  const auto add_row = [&](const char* name, const Part& part, Index first_face) {
    const auto [same, largest] = deviation(part, mesh, first_face);
    result.rows.push_back(
        {name, std::to_string(part.surface.num_faces()), std::to_string(same), fmt::format("{:.2g}", largest)});
  };
  add_row("lid", top, 0);
  add_row("wall", side, (lid_points - 1) * (lid_points - 1));
  result.files = {{"stitched.svg", svg_picture(panels, patch_view())}, {"stitched.obj", format_obj(mesh)}};
  if (report) result.files.push_back({"stitched.html", report(mesh, stitched_scheme)});
  return result;
}

}  // namespace sublimit::gallery
