// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of the gallery: what its page says of it (gallery.html), and its files.
#include <nlohmann/json.hpp>

#include <vector>

#include "sublimit/stencils/gallery/gallery.h"

namespace sublimit::gallery {

using Json = nlohmann::ordered_json;

struct GalleryPart {
  Json rows = Json::array();  ///< sections of curves, or rows of the page's table
  std::vector<GalleryFile> files = {};
};

}  // namespace sublimit::gallery
