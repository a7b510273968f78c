// SPDX-License-Identifier: Apache-2.0
// Figures of limit surfaces: shaded, with reflection lines, coloured by curvature.
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "sublimit/report/page/bands.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/stencils/picture/camera.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {
namespace {

using Eigen::Vector3d;

PictureOptions small_picture(const std::string& title, bool small = false) {
  PictureOptions options;
  options.panel_width = small ? 230 : 300;
  options.panel_height = small ? 172 : 225;
  options.up = {0, 0, 1};
  options.azimuth = .7;
  options.elevation = .62;
  options.sky_directions = 16;
  options.tone_step = small ? 8 : 4;
  options.ground_shadow = false;
  options.plate = false;
  options.title = title;
  return options;
}

/// Towards the eye of a picture, for all points alike: stripes of a far world.
Vector3d eye_of(const PictureOptions& options) { return picture::Camera(options).axes.row(2).transpose(); }

/// A coordinate of the direction in which an eye far away sees the world mirrored.
std::vector<double> mirrored(const PictureMesh& mesh, const Vector3d& eye) {
  const Vector3d across = Vector3d(.55, .75, .36).normalized();
  std::vector<double> values;
  for (Eigen::Index v = 0; v < mesh.vertex_normals.rows(); ++v) {
    const Vector3d n = mesh.vertex_normals.row(v).transpose().normalized();
    values.push_back((2 * n.dot(eye) * n - eye).dot(across));
  }
  return values;
}

/// How far normals look towards a light far away: its level lines are isophotes.
std::vector<double> lit(const PictureMesh& mesh, const Vector3d& light) {
  std::vector<double> values;
  for (Eigen::Index v = 0; v < mesh.vertex_normals.rows(); ++v)
    values.push_back(mesh.vertex_normals.row(v).dot(light.normalized()));
  return values;
}

/// Stripes in turn between equal steps of a value.
std::string striped(const PictureMesh& mesh, const std::vector<double>& values, int count,
                    const PictureOptions& options) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  std::vector<double> thresholds;
  for (int i = 1; i < count; ++i) thresholds.push_back(*low + (*high - *low) * i / count);
  Panel panel{bands(mesh, values, thresholds, 2), {}, {}};
  panel.layers[0].color = {.80, .82, .83}, panel.layers[1].color = {.16, .25, .36};
  return svg_picture({panel}, options);
}

constexpr int curvature_colors = 9;

/// From hollow (saddle) blue over pale to bulging red.
Color curvature_color(int band) {
  constexpr Color cool = {.10, .36, .66}, pale = {.86, .84, .78}, warm = {.80, .24, .10};
  const double t = 2. * band / (curvature_colors - 1) - 1;
  return t < 0 ? mix(pale, cool, std::pow(-t, .8)) : mix(pale, warm, std::pow(t, .8));
}

struct Curvature {
  std::vector<double> gauss;  // per vertex
  double scale = 0;           // where colours end
};

/// Gauss curvature per vertex; where it does not exist, the mean of the neighbours that have one.
Curvature gauss_of(const Json& surface, const PictureMesh& mesh, std::size_t percent) {
  Curvature result;
  const Json& list = at(surface, "curvature");
  if (!list.is_array() || static_cast<Eigen::Index>(list.size()) != mesh.positions.rows()) return result;
  std::vector<double> sum(list.size(), 0), count(list.size(), 0), known;
  std::vector<bool> has(list.size());
  for (std::size_t v = 0; v < list.size(); ++v) {
    const std::optional<double> k = number(at(list[v], 1));
    has[v] = k.has_value();
    result.gauss.push_back(k.value_or(0));
    if (k) known.push_back(std::abs(*k));
  }
  if (known.empty()) return {};
  std::size_t begin = 0;
  for (Index size : mesh.face_sizes) {
    for (Index i = 0; i < size; ++i)
      for (Index j = 0; j < size; ++j) {
        const Index a = mesh.face_vertices[begin + static_cast<std::size_t>(i)],
                    b = mesh.face_vertices[begin + static_cast<std::size_t>(j)];
        if (has[b]) sum[a] += result.gauss[b], count[a] += 1;
      }
    begin += static_cast<std::size_t>(size);
  }
  for (std::size_t v = 0; v < list.size(); ++v)
    if (!has[v] && count[v] > 0) result.gauss[v] = sum[v] / count[v];
  std::sort(known.begin(), known.end());
  result.scale = known[known.size() * percent / 100];
  if (!(result.scale > 0)) result.scale = known.back() > 0 ? known.back() : 1;
  return result;
}

std::vector<PictureMesh> colored(const PictureMesh& mesh, const Curvature& curvature) {
  std::vector<double> thresholds;
  for (int i = 1; i < curvature_colors; ++i) thresholds.push_back(curvature.scale * (2. * i / curvature_colors - 1));
  std::vector<PictureMesh> parts = bands(mesh, curvature.gauss, thresholds);
  for (int i = 0; i < curvature_colors; ++i) parts[i].color = curvature_color(i);
  std::erase_if(parts, [](const PictureMesh& part) { return part.face_sizes.empty(); });
  return parts;
}

Legend curvature_legend(const Curvature& curvature) {
  Legend items;
  for (const int band : {0, 2, 4, 6, 8}) {
    const double middle = curvature.scale * (2. * band + 1 - curvature_colors) / curvature_colors;
    const std::string value = digits(std::abs(middle) < 1e-9 * curvature.scale ? 0. : middle, 2);
    items.emplace_back(swatch_of(hex(curvature_color(band))), band == 0                      ? "≤ " + value
                                                              : band == curvature_colors - 1 ? "≥ " + value
                                                                                             : value);
  }
  return items;
}

}  // namespace

void add_surface_figures(const Json& surface, const std::string& name, bool small, Json& figures) {
  const PictureMesh mesh = mesh_of(surface);
  if (mesh.face_sizes.empty() || !mesh.positions.allFinite()) return;
  PictureOptions shaded = small_picture("Limit surface, " + name, small);
  shaded.tone_step = small ? 2 : 1;
  figures["surface"] = figure(svg_picture({{{mesh}, {}, {}}}, shaded));
  if (mesh.vertex_normals.rows() > 0) {
    PictureOptions options = small_picture("Reflection lines, " + name, small);
    options.tone_step = small ? 16 : 10;  // the stripes say it
    figures["reflection"] = figure(striped(mesh, mirrored(mesh, eye_of(options)), small ? 20 : 26, options));
  }
  if (const Curvature curvature = gauss_of(surface, mesh, 92); !curvature.gauss.empty())
    figures["gauss"] =
        figure(svg_picture({{colored(mesh, curvature), {}, {}}}, small_picture("Gauss curvature, " + name, small)),
               curvature_legend(curvature));
}

namespace {

/// Of a whole asset.
PictureOptions asset_picture(const PictureMesh& mesh, const std::string& title) {
  PictureOptions options = small_picture(title);
  const Vector3d extent = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).transpose();
  // Files do not say. Most have y upwards; what is much flatter in z lies on its belly.
  if (extent.z() >= .5 * extent.y()) options.up = {0, 1, 0};
  options.elevation = .36;
  return options;
}

std::string asset_surface(const Json& asset, const PictureMesh& mesh, const Curvature& curvature) {
  PictureOptions options = asset_picture(mesh, "Limit surface of " + string(at(asset, "file"), "the mesh"));
  options.panel_width = 900;
  options.panel_height = 620;
  options.sky_directions = 64;
  options.tone_step = 3;
  Panel panel;
  panel.layers = curvature.gauss.empty() ? std::vector<PictureMesh>{mesh} : colored(mesh, curvature);
  const Json& worst = at(asset, "worst");
  PictureMesh places;
  places.faces = false;
  const std::size_t count = worst.is_array() ? worst.size() : 0;
  places.positions = Points::Zero(static_cast<Eigen::Index>(count), 3);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      places.positions(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
          number(at(at(at(worst, i), "at"), c)).value_or(0);
  options.in_view = places.positions;
  std::string svg = svg_picture({panel}, options);
  const picture::Frame frame = picture::frame_of({panel}, options);
  picture::Camera camera(options);
  fit(camera, {panel}, frame, options);
  struct Label {
    double x, y;
    std::string words;
    int count;
  };
  std::vector<Label> labels;  // one for several places that lie together
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d p = places.positions.row(static_cast<Eigen::Index>(i)).transpose();
    const picture::Projected at = camera.project(camera.seen(frame.local(p)));
    const auto near = std::find_if(labels.begin(), labels.end(), [&](const Label& l) {
      return std::abs(l.x - at.x) < 64 && std::abs(l.y - at.y) < 21;
    });
    const std::string word = std::to_string(i + 1);
    if (near == labels.end()) {
      labels.push_back({at.x, at.y, word, 1});
    } else if (++near->count <= 3) {
      near->words += ", " + word;
    } else if (near->count == 4) {
      near->words += " …";
    }
  }
  std::string numbers = "<g transform=\"translate(14 14)\">";
  for (const Label& l : labels) {
    const double half = std::max(10., 5 + 3.7 * static_cast<double>(l.words.size()));
    numbers += "<rect x=\"" + svg::pixels(l.x - half) + "\" y=\"" + svg::pixels(l.y - 10) + "\" width=\"" +
               svg::pixels(2 * half) +
               "\" height=\"20\" rx=\"10\" fill=\"#fff\" stroke=\"#22262f\" stroke-width=\"1.6\"/><text x=\"" +
               svg::pixels(l.x) + "\" y=\"" + svg::pixels(l.y + 4.5) +
               "\" style=\"fill:#22262f;font-weight:700;font-size:12px\">" + l.words + "</text>";
  }
  svg.insert(svg.rfind("</svg>"), numbers + "</g>\n");
  return svg;
}

}  // namespace

Json mesh_figures(const Json& asset) {
  Json figures = deviation_figures(at(asset, "seams"));
  const PictureMesh mesh = mesh_of(at(asset, "surface"));
  if (mesh.face_sizes.empty() || !mesh.positions.allFinite()) return figures;
  const Curvature curvature = gauss_of(at(asset, "surface"), mesh, 80);  // rounded edges would hide the rest
  Json drawn = {{"surface", figure(asset_surface(asset, mesh, curvature),
                                   curvature.gauss.empty() ? Legend() : curvature_legend(curvature))}};
  if (mesh.vertex_normals.rows() > 0) {
    const auto stripes = [&](const char* what, const auto& values, int count) {
      PictureOptions options = asset_picture(mesh, what + (" of " + string(at(asset, "file"), "the mesh")));
      options.panel_width = 440;
      options.panel_height = 310;
      options.tone_step = 16;  // the stripes say it
      return figure(striped(mesh, values(options), count, options));
    };
    drawn["zebra"] = stripes(
        "Zebra stripes", [&](const auto& o) { return mirrored(mesh, eye_of(o)); }, 26);
    drawn["isophotes"] = stripes(
        "Isophotes",
        [&](const auto&) {
          return lit(mesh, {.35, .5, .8});
        },
        22);
  }
  drawn.update(figures);
  return drawn;
}

}  // namespace sublimit::page
