// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/picture.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/stencils/picture/camera.h"
#include "sublimit/stencils/picture/ground_shadow.h"
#include "sublimit/stencils/picture/panel.h"
#include "sublimit/stencils/picture/svg.h"

namespace sublimit {
namespace {

using svg::escaped;
using svg::pixels;

void require(bool condition, int panel, int layer, const char* what) {
  if (condition) return;
  throw InvalidParameter("picture: panel " + std::to_string(panel) + ", layer " + std::to_string(layer) + ": " + what);
}

void check(const PictureMesh& mesh, int panel, int layer) {
  const auto need = [&](bool condition, const char* what) { require(condition, panel, layer, what); };
  const Eigen::Index count = mesh.positions.rows();
  const auto inside = [&](Index v) { return v >= 0 && v < count; };
  need(count == 0 || mesh.positions.cols() == 3, "positions need 3 columns");
  need(mesh.positions.allFinite(), "a coordinate is not finite");
  std::size_t corners = 0;
  for (Index size : mesh.face_sizes) {
    need(size >= 3, "a face has fewer than 3 corners");
    corners += static_cast<std::size_t>(size);
  }
  need(corners == mesh.face_vertices.size(), "face_sizes do not add up to the length of face_vertices");
  need(std::all_of(mesh.face_vertices.begin(), mesh.face_vertices.end(), inside),
       "a face has a vertex that does not exist");
  need(std::all_of(mesh.dots.begin(), mesh.dots.end(), inside), "a dot is a vertex that does not exist");
  for (const PictureMesh::Line& line : mesh.creases) {
    need(inside(line.tail) && inside(line.head), "a crease has a vertex that does not exist");
    need(line.strength >= 0 && line.strength <= 1, "a crease's strength is outside 0..1");
  }
  need(mesh.dot_size >= 0 && mesh.dot_size <= 2, "the size of dots is 0 to 2");
  if (mesh.ink) {
    need(mesh.ink->width >= 0 && mesh.ink->width <= 5, "the width of lines is 0 to 5 pixels");
    for (double c : mesh.ink->color) need(c >= 0 && c <= 1, "a colour is outside 0..1");
  }
  for (double c : mesh.color) need(c >= 0 && c <= 1, "a colour is outside 0..1");
  const auto normals = [&](const Points& n, Eigen::Index rows) {
    need(n.size() == 0 || (n.rows() == rows && n.cols() == 3),
         "normals need 3 columns and one row per vertex or corner");
    need(n.allFinite(), "a normal is not finite");
  };
  normals(mesh.vertex_normals, count);
  normals(mesh.corner_normals, static_cast<Eigen::Index>(corners));
}

void check(const PictureOptions& o) {
  const auto need = [](bool condition, const char* what) {
    if (!condition) throw InvalidParameter(std::string("picture: ") + what);
  };
  const auto size = [](double pixels) { return pixels >= 16 && pixels <= 4096; };
  need(size(o.panel_width) && size(o.panel_height), "a panel's width and height are 16 to 4096 pixels");
  need(o.caption_size >= 4 && o.caption_size <= 100, "captions are 4 to 100 pixels");
  need(o.up.allFinite() && o.up.norm() > 0, "the direction up is not finite or zero");
  need(std::isfinite(o.azimuth) && std::isfinite(o.elevation), "azimuth and elevation must be finite");
  need(o.sky_directions >= 1 && o.sky_directions <= 10'000, "the sky has 1 to 10000 directions");
  need(o.tone_step >= 1 && o.tone_step <= 32, "the step of tones is 1 to 32");
  need(o.columns >= 0, "columns cannot be negative");
  need(o.in_view.rows() == 0 || (o.in_view.cols() == 3 && o.in_view.allFinite()),
       "points in view need 3 finite columns");
  need(o.distance == 0 || (o.distance > 1 && o.distance <= 1e6), "distance must be 0 or greater than 1");
}

}  // namespace

std::string svg_picture(const std::vector<Panel>& panels, const PictureOptions& options) {
  check(options);
  for (int p = 0; p < static_cast<int>(panels.size()); ++p) {
    for (int l = 0; l < static_cast<int>(panels[p].layers.size()); ++l) check(panels[p].layers[l], p, l);
  }
  const picture::Frame frame = picture::frame_of(panels, options);
  picture::Camera camera(options);
  fit(camera, panels, frame, options);

  const double border = 14, text = options.caption_size / 17;
  const bool captions =
      std::any_of(panels.begin(), panels.end(), [](const Panel& p) { return !p.caption.empty() || !p.note.empty(); });
  const double caption_height = captions ? 58 * text : 0;
  const std::size_t columns = options.columns > 0 ? static_cast<std::size_t>(options.columns) : panels.size();
  const std::size_t rows = panels.empty() ? 1 : (panels.size() + columns - 1) / columns;
  const double row_height = options.panel_height + caption_height;
  const double width = static_cast<double>(std::min(columns, panels.size())) * options.panel_width + 2 * border;
  const double height = static_cast<double>(rows) * row_height + border;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + pixels(width) + " " + pixels(height) +
                    "\" width=\"" + pixels(width) + "\" height=\"" + pixels(height) +
                    "\" font-family=\"system-ui, sans-serif\" text-anchor=\"middle\"" +
                    (options.title.empty() ? ">\n" : " role=\"img\"><title>" + escaped(options.title) + "</title>\n");
  if (!options.description.empty()) svg += "<desc>" + escaped(options.description) + "</desc>\n";
  if (options.plate) svg += "<rect width=\"100%\" height=\"100%\" rx=\"16\" fill=\"#f4f2ed\"/>\n";
  if (options.ground_shadow) {
    svg +=
        "<radialGradient id=\"shadow\"><stop offset=\".5\" stop-color=\"#3a3f55\" stop-opacity=\".42\"/>"
        "<stop offset=\".75\" stop-color=\"#3a3f55\" stop-opacity=\".14\"/>"
        "<stop offset=\"1\" stop-color=\"#3a3f55\" stop-opacity=\"0\"/></radialGradient>\n";
  }
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Panel& panel = panels[p];
    svg += "<g transform=\"translate(" + pixels(border + static_cast<double>(p % columns) * options.panel_width) + " " +
           pixels(border + static_cast<double>(p / columns) * row_height) + ")\">\n";
    if (options.ground_shadow) svg += picture::ground_shadow(panel, frame, camera);
    svg += "<g transform=\"scale(.1)\" stroke-linejoin=\"round\">\n";
    const picture::SeenPanel seen(panel, frame, camera, options);
    write_faces(svg, seen);
    for (int l = 0; l < static_cast<int>(panel.layers.size()); ++l) write_lines(svg, seen, l);
    svg += "</g>\n";
    const auto line = [&](double below, double size, const char* style, const std::string& words) {
      if (words.empty()) return;
      svg += "<text x=\"" + pixels(options.panel_width / 2) + "\" y=\"" + pixels(options.panel_height + text * below) +
             "\" font-size=\"" + pixels(text * size) + "\" " + style + ">" + escaped(words) + "</text>\n";
    };
    line(22, 17, "font-weight=\"600\" fill=\"#2b2f38\"", panel.caption);
    line(43, 13, "fill=\"#6a6f7a\"", panel.note);
    svg += "</g>\n";
  }
  svg += "</svg>\n";
  return svg;
}

}  // namespace sublimit
