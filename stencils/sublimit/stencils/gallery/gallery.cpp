// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/gallery.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/gallery/curve_pictures.h"
#include "sublimit/stencils/gallery/exhibit.h"
#include "sublimit/stencils/gallery/gallery_part.h"
#include "sublimit/stencils/gallery/patch_exhibits.h"
#include "sublimit/stencils/gallery/stitched.h"

namespace sublimit {
namespace {

using namespace gallery;

/// One scheme on one cage.
struct Work {
  int scheme = 0;
  const Cage* cage = nullptr;
  Exhibit exhibit;
  std::string picture() const { return exhibit.measured.scheme + "-" + cage->name + ".svg"; }
};

/// Everything that the exhibits of a cage show.
Points in_view(const std::vector<Work>& work, const Cage& cage) {
  std::vector<double> all;
  for (const Work& w : work)
    if (w.cage == &cage)
      for (const Panel& panel : w.exhibit.panels)
        for (const PictureMesh& mesh : panel.layers)
          all.insert(all.end(), mesh.positions.data(), mesh.positions.data() + mesh.positions.size());
  return Eigen::Map<Points>(all.data(), static_cast<Eigen::Index>(all.size() / 3), 3);
}

PictureOptions small_multiples() {
  PictureOptions options;
  options.panel_width = 184;
  options.panel_height = 170;
  options.sky_directions = 32;
  options.tone_step = 2;
  options.ground_shadow = false;
  options.caption_size = 13;
  return options;
}

/// The limits of the cube, in triangles where the scheme wants them, and of the tetrahedron, in rows of seven.
std::string overview(const std::vector<Work>& work) {
  std::vector<Panel> panels;
  for (const bool tetrahedron : {false, true})
    for (const Work& w : work) {
      const bool quads = std::any_of(work.begin(), work.end(), [&](const Work& other) {
        return other.scheme == w.scheme && other.cage->name == "cube";
      });
      if (w.cage->name == (tetrahedron ? "tetrahedron" : quads ? "cube" : "cube-tetrahedral"))
        panels.push_back(w.exhibit.small);
    }
  PictureOptions options = small_multiples();
  options.panel_width = 165;
  options.panel_height = 140;
  options.caption_size = 12;
  options.columns = 7;
  options.tone_step = 4;  // decides the size of the file
  return svg_picture(panels, options);
}

std::string percent(double x) { return fmt::format("{:.3g}\u00a0%", x < 1e-10 ? 0 : 100 * x); }

Json page_row(const Work& w, const std::string& source) {
  const Measured& m = w.exhibit.measured;
  std::string bending;
  for (const Measured::Bending& b : m.bending)
    bending += (bending.empty() ? "" : " \u2192 ") + fmt::format("{:.3f}", b.energy);
  return {{"name", m.scheme},
          {"source", source},
          {"numbers",
           {{"volume", percent(m.volume)},
            {"distance", percent(m.mean_distance) + ", at most " + percent(m.max_distance)},
            {"symmetry defect", percent(m.symmetry_defect)},
            {"bending", bending}}},
          {"picture", w.picture()}};
}

std::string json(const std::vector<Work>& work) {
  Json surfaces = Json::array();
  for (const Work& w : work) {
    const Measured& m = w.exhibit.measured;
    Json bending = Json::array();
    for (const Measured::Bending& b : m.bending)
      bending.push_back({{"level", b.level}, {"faces", b.faces}, {"energy", b.energy}});
    surfaces.push_back({{"scheme", m.scheme},
                        {"cage", m.cage},
                        {"level", m.level},
                        {"faces", m.faces},
                        {"volume_ratio", m.volume},
                        {"mean_distance", m.mean_distance},
                        {"max_distance", m.max_distance},
                        {"symmetry_defect", m.symmetry_defect},
                        {"roundness", m.roundness},
                        {"bending_energy", bending}});
  }
  return Json{{"surfaces", surfaces}}.dump(1) + "\n";
}

/// The page: the template with its data.
std::string page(const Json& data) {
  std::string html =
#include "gallery.html.inc"
      ;
  std::string text = data.dump();
  for (size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  const std::string place = "id=\"gallery\">{}";
  return html.replace(html.find(place) + place.size() - 2, 2, text);
}

}  // namespace

std::vector<GalleryFile> make_gallery(const GalleryOptions& options, const std::function<void(int, int)>& progress) {
  if (options.levels < 0 || options.levels > 5) throw InvalidParameter("gallery: 0 to 5 levels can be drawn");
  if (options.faces < 200 || options.faces > 200'000)
    throw InvalidParameter("gallery: surfaces have 200 to 200000 faces");
  const std::vector<Scheme<double>> schemes = all_schemes();
  const std::vector<Cage> all_cages = cages();
  std::vector<std::unique_ptr<LimitCache>> caches;
  std::vector<Work> work;
  for (const Scheme<double>& scheme : schemes) {
    caches.push_back(std::make_unique<LimitCache>(scheme));
    for (const Cage& cage : all_cages)
      if (scheme.face_size() == 0 || Topology(view(cage.mesh)).uniform_face_size() == scheme.face_size())
        work.push_back({static_cast<int>(caches.size()) - 1, &cage, {}});
  }
  std::mutex mutex;
  int done = 0;
  const int total = 2 * static_cast<int>(work.size()) + 3;
  const auto step = [&] {
    const std::lock_guard lock(mutex);
    if (progress) progress(done, total);
    ++done;
  };
  // A scheme's cache is used by one task at a time.
  const auto show_scheme = [&](std::int64_t s, std::int64_t, std::int64_t) {
    for (Work& w : work) {
      if (w.scheme != static_cast<int>(s)) continue;
      step();
      w.exhibit = exhibit(*w.cage, *caches[size_t(s)], {options.levels, options.faces});
    }
  };
  parallel_for_blocks(std::int64_t(schemes.size()), show_scheme, 1);

  std::map<const Cage*, Points> views;
  for (const Cage& cage : all_cages) views[&cage] = in_view(work, cage);
  std::vector<GalleryFile> files(work.size());
  const auto draw = [&](std::int64_t block, std::int64_t, std::int64_t) {
    const auto i = static_cast<size_t>(block);
    step();
    PictureOptions picture = small_multiples();
    picture.in_view = views.at(work[i].cage);
    files[i] = {work[i].picture(), svg_picture(work[i].exhibit.panels, picture)};
  };
  parallel_for_blocks(std::int64_t(work.size()), draw, 1);
  step();
  files.push_back({"overview.svg", overview(work)});

  Json sections = Json::array();
  for (const Cage& cage : all_cages) {
    Json rows = Json::array();
    for (const Work& w : work)
      if (w.cage == &cage) rows.push_back(page_row(w, schemes[w.scheme].source));
    sections.push_back({{"id", cage.name}, {"title", cage.title}, {"rows", rows}});
  }
  const auto add = [&](GalleryPart part) {
    std::ranges::move(part.files, std::back_inserter(files));
    return part.rows;
  };
  for (const Json& section : add(curve_pictures(options.levels))) sections.push_back(section);
  step();
  const Json patches = add(patch_pictures());
  step();
  const Json stitched = add(stitched_pictures(options.report));
  files.push_back({"measures.json", json(work)});
  files.push_back(
      {"index.html",
       page({{"sections", sections}, {"patches", patches}, {"stitched", stitched}, {"report", bool(options.report)}})});
  return files;
}

void write_gallery(const std::string& directory, const std::vector<GalleryFile>& files) {
  std::vector<std::unique_ptr<AtomicFile>> open;
  for (const GalleryFile& file : files) {
    open.push_back(std::make_unique<AtomicFile>(std::filesystem::path(directory) / file.name));
    open.back()->write(file.text);
  }
  for (const auto& file : open) file->commit();
}

}  // namespace sublimit
