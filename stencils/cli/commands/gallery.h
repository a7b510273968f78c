// SPDX-License-Identifier: Apache-2.0
#pragma once
// `sublimit schemes --gallery DIR`.
#include <memory>

#include "support/common.h"

namespace sublimit::cli {

struct GalleryRun {
  Common common;
  std::string directory;  ///< empty: no gallery
  int faces = 0;
};

/// The gallery's options on an app.
std::shared_ptr<GalleryRun> add_gallery(CLI::App& command);

/// Draws and writes; says what it made unless `silent`.
void draw_gallery(const GalleryRun& run, bool silent);

}  // namespace sublimit::cli
