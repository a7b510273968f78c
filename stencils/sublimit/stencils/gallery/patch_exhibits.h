// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gallery's classical surfaces: each made from its recipe, as a picture with its net and its data, and what is said
// of it, which is asked of the surface.
#include <string>
#include <vector>

#include "sublimit/stencils/picture/picture.h"

namespace sublimit::gallery {

/// Relation of a surface to its data.
enum class PatchForm {
  net,        ///< the exact net of a B-spline surface
  rows,       ///< rows over points, but no such net
  nonlinear,  ///< neither
};

struct PatchExhibit {
  std::string kind, name;
  PatchForm form = PatchForm::net;
  std::string degree;   ///< in u and v, or of a triangle; empty where there is no polynomial
  std::string made_of;  ///< "net 4 x 3", "rows over 24 points"
  std::string why;      ///< there is no net
  Index faces = 0;
  Panel panel;  ///< layers: the surface, the net if one is drawn, the data if there are any besides
};

/// One for each of the recipes (patch_recipes.h), in their order.
std::vector<PatchExhibit> patch_exhibits();

/// Returns the view of all patch exhibits.
PictureOptions patch_view();

}  // namespace sublimit::gallery
