// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gallery's curves: an open and a closed polygon under every curve scheme, level by level.
#include <string>
#include <utility>
#include <vector>

#include "sublimit/stencils/gallery/gallery_page.h"

namespace sublimit::gallery {

struct CurvePictures {
  std::vector<PageSection> sections;                       ///< one a polygon, a row a scheme
  std::vector<std::pair<std::string, std::string>> files;  ///< names and texts of the rows' pictures
};

/// @param levels  drawn, besides the control polygon
CurvePictures curve_pictures(int levels);

}  // namespace sublimit::gallery
