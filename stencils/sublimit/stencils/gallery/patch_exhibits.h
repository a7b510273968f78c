// SPDX-License-Identifier: Apache-2.0
#pragma once
// The classical surfaces of the gallery: each made from its recipe, as a picture with its net and data, and
// with a description computed from the surface.
#include <string>
#include <vector>

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

/// Returns an exhibit for each of the recipes (patch_recipes.h), in their order.
std::vector<PatchExhibit> patch_exhibits();

/// Returns the view of all patch exhibits.
PictureOptions patch_view();

}  // namespace sublimit::gallery
