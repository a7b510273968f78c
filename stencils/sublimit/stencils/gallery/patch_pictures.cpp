// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/patch_pictures.h"

#include "sublimit/stencils/gallery/patch_exhibits.h"
#include "sublimit/stencils/gallery/patch_recipes.h"

namespace sublimit::gallery {
namespace {

constexpr const char* what_is_shown =
    "<p>Each is made from its recipe in <a href=\"patches.json\">patches.json</a> and drawn as its exact points. Blue "
    "surfaces are B-splines, brown their exact nets, which <code>sublimit construct</code> writes. Green ones have "
    "rows over points but no such net; a triangle's control points are drawn all the same. Violet ones are not linear "
    "in their data. Red: curves and normals of the recipe; large dots: points that the surface goes through. Thin "
    "lines are borders of faces.</p>\n";

}  // namespace

PatchPictures patch_pictures() {
  const std::vector<PatchExhibit> exhibits = patch_exhibits();
  PatchPictures result;
  result.section = {
      .id = "patches",
      .title = "Classical surfaces",
      .rows = {},
      .text = what_is_shown,
      .picture = "patches.svg",
      .description = "Classical surfaces with their nets, or the data that they are made from",
      .table = {.columns = {"surface", "kind", "degree", "faces", "net or rows", "why no net"}, .rows = {}}};
  std::vector<Panel> panels;
  for (const PatchExhibit& exhibit : exhibits) {
    panels.push_back(exhibit.panel);
    result.section.table.rows.push_back(
        {exhibit.name, exhibit.kind, exhibit.degree, std::to_string(exhibit.faces), exhibit.made_of, exhibit.why});
  }
  result.files = {{"patches.svg", svg_picture(panels, patch_view())}, {"patches.json", std::string(patch_recipes())}};
  return result;
}

}  // namespace sublimit::gallery
