// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gallery of all schemes, `sublimit schemes --gallery DIR`.
#include <memory>

#include "support/common.h"

namespace sublimit::cli {

struct GalleryRun {
  Common common;
  std::string directory;  ///< empty: no gallery
  int faces = 0;
};

/// Adds the gallery's options to a subcommand.
std::shared_ptr<GalleryRun> add_gallery(CLI::App& command);

/// Draws the gallery, writes its files, and prints what was written unless `silent`.
void draw_gallery(const GalleryRun& run, bool silent);

}  // namespace sublimit::cli
