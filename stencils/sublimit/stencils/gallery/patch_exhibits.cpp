// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/patch_exhibits.h"

#include <memory>
#include <utility>

#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/geometric/placed_surface.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/stencils/gallery/patch_data.h"
#include "sublimit/stencils/gallery/patch_layers.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit::gallery {
namespace {

constexpr Color with_net{.42, .60, .70}, with_rows{.52, .66, .48}, not_linear{.66, .58, .72};
constexpr const char* times = "\u00a0\u00d7\u00a0";

/// Says what a surface is; what it gives refers to the surface.
SampledSurface describe(const RecipeSurface& surface, PatchExhibit& exhibit) {
  const Patch& patch = *surface.patch;
  const auto product = [](Index a, Index b) { return std::to_string(a) + times + std::to_string(b); };
  if (surface.net) {
    const SplineSurface& spline = *surface.net->surface;
    exhibit.form = PatchForm::net;
    exhibit.degree = product(spline.u().degree(), spline.v().degree());
    exhibit.made_of = "net " + product(spline.u().num_points(), spline.v().num_points());
    exhibit.panel.layers.push_back(net_layer(*surface.net));
  } else {
    exhibit.form = PatchForm::rows;
    exhibit.made_of = "rows over " + std::to_string(patch.num_points()) + " points";
    exhibit.why = surface.no_net;
    if (const auto* const triangle = dynamic_cast<const TrianglePatch*>(&patch)) {
      exhibit.degree = std::to_string(triangle->degree());
      exhibit.panel.layers.push_back(triangle_net_layer(triangle->degree(), surface.columns, surface.coordinates));
    }
  }
  if (surface.coordinates == Coordinates::homogeneous && !exhibit.degree.empty()) exhibit.degree += ", rational";
  return {patch.faces(), [&surface](const std::vector<Place>& places) {
            return surface.patch->evaluate(surface.columns, places, 1, surface.coordinates);
          }};
}

SampledSurface describe(const NormalTriangles& data, PatchExhibit& exhibit) {
  const GeometricNormalScheme scheme = geometric_scheme<NormalMesh>(exhibit.kind);
  const std::shared_ptr<const PlacedSurface> surface =
      scheme.surface(scheme.checked({{0, 1, 2}, data.points, data.normals}));
  exhibit.form = PatchForm::nonlinear;
  exhibit.made_of = "of points and normals, not linear";
  exhibit.why = "it is made with lengths and unit normals";
  return {surface->faces(), [surface](const std::vector<Place>& places) {
            LimitSamples samples;
            surface->evaluate(places, 1, true, samples);
            return samples;
          }};
}

PatchExhibit exhibit_of(const Recipe& recipe, const JsonValue& object) {
  PatchExhibit exhibit;
  exhibit.kind = recipe.kind;
  exhibit.name = recipe.name;
  const NormalTriangles* const triangles = std::get_if<NormalTriangles>(&recipe.shape);
  const SampledSurface surface = triangles ? describe(*triangles, exhibit) : describe(*recipe.surface(), exhibit);
  exhibit.faces = surface.faces.size;
  PictureMesh mesh = surface_layer(surface);
  mesh.color = exhibit.form == PatchForm::net ? with_net : exhibit.form == PatchForm::rows ? with_rows : not_linear;
  mesh.ink = {mix(mesh.color, {.1, .12, .2}, .45), .6};
  const PatchData data = patch_data(object);
  std::vector<PictureMesh>& layers = exhibit.panel.layers;
  layers.insert(layers.begin(), std::move(mesh));
  if (!data.curves.empty() || data.points.rows() > 0) {
    const double size = (layers[0].positions.colwise().maxCoeff() - layers[0].positions.colwise().minCoeff()).norm();
    layers.push_back(data_layer(data, size / 6));
  }
  fit_window(layers, patch_view());
  exhibit.panel.caption = exhibit.name;
  exhibit.panel.note = (exhibit.degree.empty() ? "" : "degree " + exhibit.degree + ", ") + exhibit.made_of;
  return exhibit;
}

}  // namespace

std::string_view patch_recipes() {
  return
#include "patches.json.inc"
      ;
}

PictureOptions patch_view() {
  PictureOptions options;
  options.panel_width = 200;
  options.panel_height = 170;
  options.columns = 6;
  options.up = {0, 0, 1};
  options.azimuth = .6;
  options.elevation = .58;
  options.sky_directions = 32;
  options.tone_step = 4;  // decides the size of the file
  options.ground_shadow = false;
  options.caption_size = 13;
  return options;
}

std::vector<PatchExhibit> patch_exhibits() {
  const std::string text(patch_recipes()), name = "patches.json";
  const JsonValue file = parse_json(text, name);
  const std::vector<JsonValue>& objects = file.find("recipes")->items;
  std::vector<PatchExhibit> exhibits;
  for (const Recipe& recipe : parse_recipes(text, name)) exhibits.push_back(exhibit_of(recipe, objects[recipe.index]));
  return exhibits;
}

GalleryPart patch_pictures() {
  GalleryPart part;
  std::vector<Panel> panels;
  for (const PatchExhibit& exhibit : patch_exhibits()) {
    panels.push_back(exhibit.panel);
    part.rows.push_back(
        {exhibit.name, exhibit.kind, exhibit.degree, std::to_string(exhibit.faces), exhibit.made_of, exhibit.why});
  }
  part.files = {{"patches.svg", svg_picture(panels, patch_view())}, {"patches.json", std::string(patch_recipes())}};
  return part;
}

}  // namespace sublimit::gallery
