// SPDX-License-Identifier: Apache-2.0
#pragma once
// The curves of the gallery: an open and a closed polygon under every curve scheme, level by level.
#include <string>
#include <utility>
#include <vector>

#include "sublimit/stencils/gallery/gallery_page.h"

namespace sublimit::gallery {

struct CurvePictures {
  std::vector<PageSection> sections;                       ///< a section for each polygon, with a row for each scheme
  std::vector<std::pair<std::string, std::string>> files;  ///< names and texts of the rows' pictures
};

/// @param levels  number of levels drawn after the control polygon
CurvePictures curve_pictures(int levels);

}  // namespace sublimit::gallery
