// SPDX-License-Identifier: Apache-2.0
#include "commands/gallery.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "sublimit/report/asset/asset_json.h"
#include "sublimit/report/page/page.h"
#include "sublimit/stencils/gallery/gallery.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::cli {

std::shared_ptr<GalleryRun> add_gallery(CLI::App& command) {
  auto run = std::make_shared<GalleryRun>();
  run->faces = GalleryOptions{}.faces;
  auto* gallery =
      command.add_option("--gallery", run->directory,
                         "Draw cube and tetrahedron, an open and a closed polygon under every scheme, level by "
                         "level, measure the limit surfaces; draw classical surfaces with their nets; "
                         "DIR/index.html shows it all");
  gallery->type_name("DIR");
  command.add_option("--gallery-faces", run->faces, "Least faces of the gallery's limit surfaces (default: 3000)")
      ->needs(gallery)
      ->check(CLI::Range(200, 200'000));
  add_run(command, run->common);
  return run;
}

void draw_gallery(const GalleryRun& run, bool silent) {
  const std::filesystem::path index = std::filesystem::path(run.directory) / "index.html";
  make_output_directory(run.directory);
  check_output_path(index.string(), {});
  limit_threads(run.common);
  Progress progress(run.common.quiet);
  const auto page_of = [](const Mesh& mesh, const std::string& scheme) {
    nlohmann::ordered_json json = report::report_head("mesh");
    json["mesh"] = to_json(asset_report(scheme_or_throw(scheme, {}), mesh, {}, {}), "stitched.obj");
    return report_page(json);
  };
  const std::vector<GalleryFile> files = make_gallery(
      {.levels = GalleryOptions{}.levels, .faces = run.faces, .report = page_of},
      [&](int done, int total) { progress.step(fmt::format("drawing and measuring, {} of {}", done, total)); });
  progress.step("writing " + run.directory);
  write_gallery(run.directory, files);
  progress.step("");
  if (run.common.quiet || silent) return;
  const auto pictures = std::ranges::count_if(files, [](const GalleryFile& f) { return f.name.ends_with(".svg"); });
  fmt::print("{} pictures, and what was measured:\n  {}\n", pictures, std::filesystem::absolute(index).string());
}

}  // namespace sublimit::cli
