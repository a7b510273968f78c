// SPDX-License-Identifier: Apache-2.0
#pragma once
// The classical surfaces of the gallery: each made from its recipe, as a picture with its net and data, and
// with a description computed from the surface.
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/stencils/gallery/gallery_part.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::gallery {

/// Relation of a surface to its data.
enum class PatchForm {
  net,        ///< has the exact net of a B-spline surface
  rows,       ///< linear in its points, but without such a net
  nonlinear,  ///< not linear in its data
};

struct PatchExhibit {
  std::string kind, name;
  PatchForm form = PatchForm::net;
  std::string degree;   ///< degrees in u and v, or total degree; empty if not polynomial
  std::string made_of;  ///< "net 4 x 3", "rows over 24 points"
  std::string why;      ///< reason why there is no net
  Index faces = 0;
  Panel panel;  ///< layers: surface, net if there is one, data other than the net if any
};

/// Returns the recipes, as a file of them (patches.json).
std::string_view patch_recipes();

/// Returns an exhibit for each of the recipes, in their order.
std::vector<PatchExhibit> patch_exhibits();

/// Returns the view of all patch exhibits.
PictureOptions patch_view();

/// Returns a row for each exhibit, and the files "patches.svg" and "patches.json".
GalleryPart patch_pictures();

}  // namespace sublimit::gallery
