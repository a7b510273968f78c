// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gallery: pictures and measures of every scheme on the same cages, level by level and in the limit, and of
// classical surfaces with their nets.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

struct GalleryOptions {
  int levels = 3;      ///< levels drawn, 0 to 5; the limit of surfaces follows
  Index faces = 3000;  ///< least faces of surfaces measured and drawn as limits; 200 to 200 000
  /// Makes the page of a report on a mesh under a scheme. If not given, the gallery has no such page.
  std::function<std::string(const Mesh&, const std::string&)> report = {};
};

struct GalleryFile {
  std::string name, text;
};

/// Makes the files of the gallery, without writing them.
/// @return  pictures, "measures.json", the recipes "patches.json", and last "index.html"
/// @param progress  if given, called by one thread at a time with the amounts of work done and in all
/// @throws InvalidParameter  an option outside its range
/// @note  Deterministic: same build, same bytes, for any number of threads.
std::vector<GalleryFile> make_gallery(const GalleryOptions& options = {},
                                      const std::function<void(int, int)>& progress = {});

/// Writes all files, or none.
/// @param directory  must exist
/// @throws IoError  unwritable;  ResourceError  a full disk
void write_gallery(const std::string& directory, const std::vector<GalleryFile>& files);

}  // namespace sublimit
