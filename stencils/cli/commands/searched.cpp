// SPDX-License-Identifier: Apache-2.0
#include "commands/searched.h"

#include "sublimit/parts/parted_patches.h"
#include "sublimit/parts/parted_surface.h"
#include "support/free_form.h"
#include "support/memory_limit.h"

namespace sublimit::cli {

void with_searched_surface(const Source& source, Progress& progress,
                           const std::function<void(const PartedSurface&)>& search) {
  const Common& common = source.common;
  if (source.kind == SourceKind::patches) {
    limit_threads(common);
    const LoadedPatches loaded = load_patches(source);
    progress.step("preparing the search");
    naming_mesh(common, [&] { search(PartedPatches(loaded.patches, loaded.columns)); });
    return;
  }
  const Loaded loaded = load(common, progress);
  check_mesh_memory(common.mesh, loaded.mesh);
  progress.step("preparing the search");
  naming_mesh(common, [&] {
    const LimitMap surface(*loaded.scheme, loaded.mesh, loaded.rules);
    search(PartedLimit(surface, loaded.mesh.positions));
  });
}

}  // namespace sublimit::cli
