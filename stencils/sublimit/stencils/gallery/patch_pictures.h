// SPDX-License-Identifier: Apache-2.0
#pragma once
// The classical surfaces as a section of the gallery's page.
#include <string>
#include <utility>
#include <vector>

#include "sublimit/stencils/gallery/gallery_page.h"

namespace sublimit::gallery {

struct PatchPictures {
  PageSection section;
  std::vector<std::pair<std::string, std::string>> files;  ///< "patches.svg", and its recipes "patches.json"
};

PatchPictures patch_pictures();

}  // namespace sublimit::gallery
