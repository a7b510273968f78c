// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gallery: every scheme on the same cages, level by level and in the limit, measured; classical surfaces with their
// nets.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

struct GalleryOptions {
  int levels = 3;      ///< drawn, 0 to 5, and the limit of surfaces after them
  Index faces = 3000;  ///< at least, of the surfaces that are measured and drawn as limits; 200 to 200 000
  /// Makes the page of a report on a mesh under a scheme; none: the gallery has no such page.
  std::function<std::string(const Mesh&, const std::string&)> report = {};
};

struct GalleryFile {
  std::string name, text;
};

/// Draws and measures; writes nothing.
/// @return  "index.html" (the last one) with its pictures, "measures.json", and the recipes "patches.json"
/// @param progress  called with what is done and what there is to do, by one thread at a time, if given
/// @throws InvalidParameter  an option outside its range
/// @note  Deterministic: same build, same bytes, for any number of threads.
std::vector<GalleryFile> make_gallery(const GalleryOptions& options = {},
                                      const std::function<void(int, int)>& progress = {});

/// Writes all files or none.
/// @param directory  must exist
/// @throws IoError  unwritable;  ResourceError  a full disk
void write_gallery(const std::string& directory, const std::vector<GalleryFile>& files);

}  // namespace sublimit
