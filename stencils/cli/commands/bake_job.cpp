// SPDX-License-Identifier: Apache-2.0
// One table, from a mesh file to a file of its own.
#include <fmt/core.h>

#include <functional>
#include <optional>
#include <utility>

#include "commands/bake.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/stencils/bake/detail/table_info.h"
#include "sublimit/stencils/files/patch_places.h"
#include "sublimit/stencils/files/place_files.h"
#include "sublimit/stencils/files/sample_files.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/rule_of_word.h"
#include "sublimit/stencils/patterns/pattern_file.h"
#include "support/free_form.h"

namespace sublimit::cli {
namespace {

constexpr size_t places_per_batch = 65536;

/// All of a file, a batch after the other.
std::vector<Place> places_of(const std::function<void(std::vector<Place>& batch, size_t most)>& read) {
  std::vector<Place> all, batch;
  do {
    read(batch, places_per_batch);
    all.insert(all.end(), batch.begin(), batch.end());
  } while (batch.size() == places_per_batch);
  return all;
}

BakeRequest request_of(const BakeJob& job) {
  BakeRequest request{.derivatives = job.derivatives,
                      .face_varying = !job.common.face_varying.empty(),
                      .face_varying_interpolation = rule_of<FaceVaryingInterpolation>(job.common.face_varying),
                      .tags = job.tags};
  if (job.levels) {
    request.rows = job.limit ? TableRows::limit : TableRows::level;
    request.level = *job.levels;
  } else if (job.grid) {
    request.rows = TableRows::grid;
    request.grid = *job.grid;
  } else {
    request.rows = TableRows::samples;
  }
  return request;
}

void set_places(PlacedFaces placed, FaceCount faces, const std::string& name, BakeRequest& request) {
  check_places(placed, faces, name);
  request.samples = std::move(placed.places);
  request.face_sizes = std::move(placed.face_sizes);
  request.face_vertices = std::move(placed.face_vertices);
}

/// Whether a file is a sound table of the same job. What is wrong with it does not matter: it will be replaced.
bool is_there(const BakeJob& job, const TableInfo& info, const BakeRequest& request) {
  try {
    const AnyTable table = load_table(job.output, {.checksums = true});
    return std::holds_alternative<BakedTable<float>>(table) == job.is_float &&
           std::visit([&](const auto& found) { return is_table_of(found, info, request); }, table);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

void check(const BakeJob& job) {
  const int points = job.levels.has_value() + job.grid.has_value() + !job.at.empty() + !job.tessellation.empty();
  if (points != 1)
    throw InvalidOption(
        fmt::format("{} -l LEVELS, --grid N, --at IN.csv and --tessellation IN.ply; one of them says "
                    "which points to bake",
                    points == 0 ? "none of" : "more than one of"));
  if (job.limit && !job.levels)
    throw InvalidOption("--limit is for -l LEVELS; points of all others are on the limit anyway");
  if (job.levels && !job.limit && job.derivatives > 0)
    throw InvalidOption("--derivatives are those of the limit: -l LEVELS needs --limit for them");
  for (const auto& [name, given] :
       {std::pair("--face-varying", !job.common.face_varying.empty()), std::pair("--tags", job.tags)})
    if (given && !job.levels) throw InvalidOption(fmt::format("{} is for the faces between vertices: -l LEVELS", name));
}

Patterns& Dictionaries::of(const Scheme<double>& scheme, const SchemeOptions& options) {
  Entry& entry = entries_[{scheme.name, options}];
  if (entry.patterns) return *entry.patterns;
  if (!path_.empty() && entries_.size() > 1 && !std::filesystem::is_directory(path_))
    throw InvalidOption("--dictionary " + path_ +
                        ": a file is of one scheme and its options; name a directory, which has "
                        "one for each");
  auto patterns = std::make_unique<Patterns>(scheme);
  if (!path_.empty()) {
    entry.file = path_;
    if (std::filesystem::is_directory(path_))
      entry.file /= fmt::format("{}-{:016x}.safetensors", scheme.name, mask_hash(scheme));
    if (std::filesystem::exists(entry.file)) load_patterns(entry.file, *patterns);
    entry.num_saved = patterns->num_matrices();
  }
  entry.patterns = std::move(patterns);
  return *entry.patterns;
}

void Dictionaries::save() {
  if (path_.empty()) return;
  for (auto& [key, entry] : entries_) {
    if (!entry.patterns || entry.patterns->num_matrices() == entry.num_saved) continue;
    check_output_path(entry.file.string(), {});
    save_patterns(entry.file, *entry.patterns);
    entry.num_saved = entry.patterns->num_matrices();
  }
}

namespace {

void write_table(const BakeJob& job, const Baked& baked, BakeOutcome& outcome, Progress& progress) {
  outcome.statistics = baked.statistics;
  progress.step("writing " + job.output);
  check_disk("tables", job.output,
             double(baked.statistics.bytes) / (job.is_float ? 2 : 1) + double(baked.statistics.channel_bytes),
             "use fewer points");
  if (job.is_float) {
    const BakedTable<float> table = in_float(baked.table);
    outcome.statistics.bytes = table.table.num_bytes();
    save_table(job.output, table);
  } else {
    save_table(job.output, baked.table);
  }
  std::error_code failed;  // of a pipe, which has no size
  const auto bytes = std::filesystem::file_size(job.output, failed);
  outcome.file_bytes = failed ? 0 : static_cast<std::int64_t>(bytes);
}

/// A table of the free-form surfaces of a file: without a scheme.
BakeOutcome bake_free_form(const BakeJob& job, const Source& source, Progress& progress, bool keep) {
  if (job.tags) throw InvalidOption("--tags are those of meshes, which need -s SCHEME");
  if (job.limit) throw InvalidOption("--limit is for meshes: points of a net have no places; take --grid N");
  if (!job.tessellation.empty()) throw InvalidOption("--tessellation is for meshes, which need -s SCHEME");
  if (job.is_plan) throw InvalidOption("--plan is for meshes, which need -s SCHEME");
  std::unique_ptr<SampleReader> reader;
  std::unique_ptr<OwnPlaceReader> own_reader;
  if (!job.at.empty() && has_own_places(job.at, "patch")) {
    if (job.derivatives > 0)
      throw InvalidOption(
          "--derivatives with places patch,u,v: derivatives of a table are per unit of its faces; name "
          "the places as face,u,v");
    own_reader = std::make_unique<OwnPlaceReader>(job.at);
  } else if (!job.at.empty()) {
    reader = std::make_unique<SampleReader>(job.at);
  }
  limit_threads(job.common);
  const LoadedPatches found = load_patches(source);
  BakeOutcome outcome;
  outcome.control_points = found.patches.num_points();
  BakeRequest request = request_of(job);
  if (reader)
    request.samples =
        places_of([&](std::vector<Place>& batch, size_t most) { reader->read(batch, most, found.patches.faces()); });
  OwnPlaces own;
  if (own_reader)
    request.samples =
        places_of([&](std::vector<Place>& batch, size_t most) { own_reader->read(batch, own, most, found.patches); });
  if (keep && is_there(job, table_info(found.patches, request), request)) {
    outcome.was_there = true;
    return outcome;
  }
  progress.step("baking");
  naming_mesh(job.common, [&] { write_table(job, bake(found.patches, request), outcome, progress); });
  return outcome;
}

}  // namespace

BakeOutcome bake_table(const BakeJob& job, Dictionaries& dictionaries, Progress& progress, bool keep) {
  if (!job.is_plan) check_output_path(job.output, all_formats().writers({contents::tables}));
  const Source source = load_source(job.common, {"bake", {SourceKind::mesh, SourceKind::patches}});
  if (source.kind == SourceKind::patches) return bake_free_form(job, source, progress, keep);
  std::unique_ptr<SampleReader> reader;  // a wrong header is told before a large mesh is read
  if (!job.at.empty()) reader = std::make_unique<SampleReader>(job.at);
  std::optional<PlacedFaces> placed;
  if (!job.tessellation.empty()) placed = read_placed_faces(job.tessellation);
  const Loaded loaded = load(job.common, progress);
  BakeOutcome outcome;
  outcome.control_points = loaded.mesh.num_vertices();
  naming_mesh(job.common, [&] {
    BakeRequest request = request_of(job);
    if (reader || placed) {
      const Topology topology(view(loaded.mesh));
      const Addresses addresses(topology, loaded.scheme->face_size() == 3);
      if (reader)
        request.samples =
            places_of([&](std::vector<Place>& batch, size_t most) { reader->read(batch, most, addresses); });
      else
        set_places(*std::move(placed), addresses, job.tessellation, request);
    }
    if (keep && is_there(job, table_info(*loaded.scheme, loaded.mesh, request, loaded.rules), request)) {
      outcome.was_there = true;
      return;
    }
    Patterns& patterns = dictionaries.of(*loaded.scheme, loaded.options);
    if (job.is_plan || job.memory_limit < INFINITY) {
      progress.step("planning");
      try {
        outcome.plan = bake_plan(patterns, loaded.mesh, request, loaded.rules, job.memory_limit);
      } catch (const ResourceError& error) {
        throw ResourceError(job.common.mesh + ": " + job.common.scheme + ": " + error.what());
      }
      if (job.is_plan) return;
    }
    progress.step("baking");
    const Baked baked = bake(patterns, loaded.mesh, request, loaded.rules);
    write_table(job, baked, outcome, progress);
  });
  return outcome;
}

std::string in_words(const BakeStatistics& s) {
  const std::string method = std::string("by ") + name(s.method);
  if (s.method == BakeMethod::rows) return method;
  return fmt::format("{}: {} types, {} blocks, {} groups", method, s.types, s.blocks, s.groups);
}

}  // namespace sublimit::cli
