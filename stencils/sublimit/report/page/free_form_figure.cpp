// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sublimit/report/page/bands.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {
namespace {

using Eigen::Vector3d;

std::optional<Vector3d> point_of(const Json& list) {
  const std::optional<double> x = number(at(list, 0)), y = number(at(list, 1)), z = number(at(list, 2));
  if (!x || !y || !z) return std::nullopt;
  return Vector3d(*x, *y, *z);
}

/// Lines of one ink through points of the report, those that there are.
struct Lines : Strokes {
  using Strokes::Strokes;
  void through(const Json& list) {
    std::optional<Index> last;
    for (const Json& p : list) {
      const std::optional<Vector3d> point = point_of(p);
      const std::optional<Index> next = point ? std::optional(add(*point)) : std::nullopt;
      if (last && next) line(*last, *next);
      last = next;
    }
  }
  void put_into(Panel& panel) const {
    if (PictureMesh lines = mesh(); lines.positions.rows() > 0) panel.layers.push_back(std::move(lines));
  }
};

/// Colours of what a seam or a joint is.
struct SeamInk {
  const char* words;
  Color color;
};
constexpr std::array<SeamInk, 6> seam_inks = {{{"gap", {.62, .05, .45}},
                                               {"G⁰", {.80, .13, .10}},
                                               {"G¹", {.90, .56, .08}},
                                               {"G²", {.13, .48, .26}},
                                               {"boundary", {.12, .13, .20}},
                                               {"non-manifold", {.45, .20, .70}}}};

/// Which of them; none of sides that are one point.
std::optional<std::size_t> ink_of(const Json& seam) {
  const Json& measured = at(seam, "measured");
  if (measured.is_object()) return static_cast<std::size_t>(std::clamp(whole(at(measured, "g"), -1) + 1, 0, 3));
  const std::string kind = string(at(seam, "kind"));
  if (kind == "boundary") return 4;
  if (kind == "non-manifold") return 5;
  return std::nullopt;
}

/// Lines from the curve against its curvature vector, and the line through their ends.
void add_combs(Panel& panel, const Json& curves, double size) {
  std::vector<double> lengths;
  const auto each = [&](const auto& use) {
    for (const Json& curve : curves)
      for (const Json& piece : at(curve, "pieces")) use(at(piece, "points"), at(piece, "curvature"));
  };
  each([&](const Json&, const Json& curvature) {
    for (const Json& K : curvature)
      if (const auto k = point_of(K)) lengths.push_back(k->norm());
  });
  if (lengths.empty()) return;
  std::sort(lengths.begin(), lengths.end());
  const double usual = lengths[lengths.size() * 95 / 100];
  if (!(usual > 0)) return;
  const double scale = .12 * size / usual, longest = .2 * size;
  Lines teeth({.55, .66, .76}, .7), ends({.23, .43, .65}, 1);
  each([&](const Json& points, const Json& curvature) {
    Index last = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::optional<Vector3d> p = point_of(at(points, i)), K = point_of(at(curvature, i));
      if (!p || !K) {
        last = -1;
        continue;
      }
      Vector3d tooth = -scale * *K;
      if (tooth.norm() > longest) tooth *= longest / tooth.norm();
      const Vector3d tip = *p + tooth;
      teeth.line(*p, tip);
      const Index next = ends.add(tip);
      if (last >= 0) ends.line(last, next);
      last = next;
    }
  });
  teeth.put_into(panel);
  ends.put_into(panel);
}

PictureOptions options_of(const Json& report) {
  PictureOptions options;
  options.panel_width = 900;
  options.panel_height = 620;
  options.sky_directions = 48;
  options.tone_step = 3;
  options.ground_shadow = false;
  options.plate = false;
  options.title = "Patches, seams and curves of " + string(at(report, "file"), "the file");
  options.azimuth = .7;
  const Json& box = at(report, "box");
  const std::optional<Vector3d> low = point_of(at(box, 0)), high = point_of(at(box, 1));
  if (!low || !high) return options;
  const Vector3d extent = *high - *low;
  if (extent.z() <= 1e-9 * extent.norm()) {  // in the plane: seen from above
    options.azimuth = options.elevation = options.distance = 0;
  } else if (extent.z() < .5 * extent.y() || at(report, "surface").is_object()) {
    options.up = {0, 0, 1};
    options.elevation = .5;
  }
  return options;
}

}  // namespace

Json free_form_figure(const Json& report) {
  Panel panel;
  PictureMesh mesh = mesh_of(at(report, "surface"));
  const bool has_surface = !mesh.face_sizes.empty() && mesh.positions.allFinite();
  Legend items;
  if (has_surface) {
    mesh.color = {.74, .79, .82};
    mesh.ink = {{.45, .52, .58}, .6};
    for (const Json& isoline : at(report, "isolines")) {
      Index last = -1;
      for (const Json& v : isoline) {
        const int next = whole(v, -1);
        const bool is_there = next >= 0 && next < mesh.positions.rows();
        if (is_there && last >= 0) mesh.creases.push_back({last, next, 1});
        last = is_there ? next : -1;
      }
    }
    panel.layers.push_back(std::move(mesh));
  }
  Lines net({.62, .56, .44}, .5);
  const Json &points = at(at(report, "net"), "points"), &edges = at(at(report, "net"), "edges");
  Index count = 0;
  bool complete = true;
  for (const Json& p : points) {
    const std::optional<Vector3d> point = point_of(p);
    complete &= point.has_value();
    count = net.add(point.value_or(Vector3d::Zero())) + 1;
  }
  for (const Json& edge : edges) {
    const int a = whole(at(edge, 0), -1), b = whole(at(edge, 1), -1);
    if (complete && a >= 0 && b >= 0 && a < count && b < count) net.line(a, b);
  }
  if (complete) net.put_into(panel);
  if (count > 0) items.emplace_back(swatch_of(hex({.62, .56, .44})), "control net");

  const Json& curves = at(report, "curves");
  const Json& box = at(report, "box");
  const std::optional<Vector3d> low = point_of(at(box, 0)), high = point_of(at(box, 1));
  if (low && high) add_combs(panel, curves, (*high - *low).norm());
  Lines drawn({.14, .18, .26}, 1.8);
  for (const Json& curve : curves)
    for (const Json& piece : at(curve, "pieces")) drawn.through(at(piece, "points"));
  drawn.put_into(panel);

  std::array<std::size_t, seam_inks.size()> counts{};
  for (const std::size_t kind : {4u, 3u, 2u, 1u, 0u, 5u}) {  // the worst on top
    Lines strokes(seam_inks[kind].color, kind == 4 ? 1.2 : kind == 3 ? 1.4 : 2.4);
    for (const Json& seam : at(at(report, "seams"), "list"))
      if (ink_of(seam) == kind) strokes.through(at(seam, "points")), ++counts[kind];
    Lines discs(seam_inks[kind].color, 5);  // lines without length have round ends
    for (const Json& joint : at(at(report, "joints"), "list"))
      if (ink_of(joint) == kind) {
        ++counts[kind];
        if (const std::optional<Vector3d> p = point_of(at(joint, "at"))) discs.dot(*p);
      }
    strokes.put_into(panel);
    discs.put_into(panel);
  }
  for (std::size_t kind = 0; kind < seam_inks.size(); ++kind)
    if (counts[kind] > 0)
      items.emplace_back(swatch_of(hex(seam_inks[kind].color)),
                         std::string(seam_inks[kind].words) + ": " + std::to_string(counts[kind]));
  if (panel.layers.empty()) return {};
  Json shown = figure(svg_picture({panel}, options_of(report)), items);
  shown["surface"] = has_surface;
  return shown;
}

}  // namespace sublimit::page
