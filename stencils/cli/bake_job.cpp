// SPDX-License-Identifier: Apache-2.0
// One table, from a mesh file to a file of its own.
#include <fmt/core.h>

#include "bake.h"
#include "sublimit/bake/table_info.h"
#include "sublimit/base/error.h"
#include "sublimit/base/memory.h"
#include "sublimit/files/rule_words.h"
#include "sublimit/files/sample_files.h"
#include "sublimit/patterns/pattern_file.h"
#include "sublimit/table_file.h"

namespace sublimit::cli {
namespace {

constexpr size_t places_per_batch = 65536;

std::vector<Sample> places_of(SampleReader& reader, const Loaded& loaded) {
  const Topology topology(view(loaded.mesh));
  const Addresses addresses(topology, loaded.scheme->face_size() == 3);
  std::vector<Sample> all, batch;
  do {
    reader.read(batch, places_per_batch, addresses);
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
  const int points = job.levels.has_value() + job.grid.has_value() + !job.at.empty();
  if (points != 1)
    throw InvalidOption(fmt::format("{} -l LEVELS, --grid N and --at IN.csv; one of them says which points to bake",
                                    points == 0 ? "none of" : "more than one of"));
  if (job.limit && !job.levels)
    throw InvalidOption("--limit is for -l LEVELS; points of --grid and --at are on the limit anyway");
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

BakeOutcome bake_table(const BakeJob& job, Dictionaries& dictionaries, Progress& progress, bool keep) {
  if (!job.is_plan) check_output_path(job.output, {".safetensors"});
  std::unique_ptr<SampleReader> reader;  // a wrong header is told before a large mesh is read
  if (!job.at.empty()) reader = std::make_unique<SampleReader>(job.at);
  const Loaded loaded = load(job.common, progress);
  BakeOutcome outcome;
  outcome.control_points = loaded.mesh.num_vertices();
  naming_mesh(job.common, [&] {
    BakeRequest request = request_of(job);
    if (reader) request.samples = places_of(*reader, loaded);
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
    outcome.file_bytes = static_cast<std::int64_t>(std::filesystem::file_size(job.output));
  });
  return outcome;
}

std::string in_words(const BakeStatistics& s) {
  const std::string method = std::string("by ") + name(s.method);
  if (s.method == BakeMethod::rows) return method;
  return fmt::format("{}: {} types, {} blocks, {} groups", method, s.types, s.blocks, s.groups);
}

}  // namespace sublimit::cli
