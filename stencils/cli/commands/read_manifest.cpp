// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <array>
#include <limits>
#include <map>
#include <span>
#include <sstream>

#include "commands/bake_manifest.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/json/json_object.h"

namespace sublimit::cli {
namespace {

JsonValue parse_line(const std::string& text, const std::string& path, std::int64_t number) {
  const std::string advice = "every line should be one object, like {\"mesh\": \"cage.obj\", ...}";
  try {
    JsonValue root = parse_json(text, path, number);
    if (root.type == JsonValue::Type::object) return root;
    throw FormatError(fmt::format("{}:{}: holds {}", path, number, show(root)));
  } catch (const FormatError& error) {
    throw FormatError(std::string(error.what()) + "; " + advice);
  }
}

/// The job of a line. Its paths are relative to the manifest's directory.
BakeJob read_job(const std::string& text_of_line, const std::string& manifest, std::int64_t number, BakeJob job) {
  const std::filesystem::path directory = directory_of_names_in(manifest);
  const JsonValue root = parse_line(text_of_line, manifest, number);
  JsonObject line(root, fmt::format("{}:{}", manifest, number));
  const auto text = [&](const char* key, std::string& out) {
    if (!line.has(key)) return false;
    out = line.string(key, "a text");
    if (out.empty()) line.fail(key, "is empty; it should be a text");
    return true;
  };
  const auto path = [&](const char* key, std::string& out) {
    if (text(key, out)) out = (directory / out).string();  // an absolute path stays one
  };
  const auto rule = [&](const char* key, std::span<const char* const> words, std::string& out) {
    if (line.has(key)) out = words[line.word(key, words)];
  };
  const auto whole = [&](const char* key, std::optional<int>& out) {
    if (line.has(key)) out = line.integer(key, 0, std::numeric_limits<int>::max());
  };
  Common& common = job.common;
  path("mesh", common.mesh), text("scheme", common.scheme), path("output", job.output);
  path("at", job.at), path("tessellation", job.tessellation);
  whole("levels", job.levels), whole("grid", job.grid);
  job.limit = line.flag_or("limit", job.limit);
  job.derivatives = line.integer_or("derivatives", 0, 2, job.derivatives);
  job.is_float = line.word_or("precision", std::array{"float", "double"}, job.is_float ? 0 : 1) == 0;
  job.tags = line.flag_or("tags", job.tags);
  rule("boundary", boundary_and_fixed_words, common.boundary);
  rule("creasing", creasing_words, common.creasing);
  rule("triangles", triangles_words, common.triangles);
  rule("face-varying", face_varying_words, common.face_varying);
  if (text("sidecar", common.sidecar) && common.sidecar != "none")
    common.sidecar = (directory / common.sidecar).string();
  common.orient = line.flag_or("orient", common.orient);
  if (line.has("crease-angle")) common.crease_angle = line.number_or("crease-angle", 0);
  common.crease_smoothing_groups = line.flag_or("crease-smoothing-groups", common.crease_smoothing_groups);
  common.triangulate = line.flag_or("triangulate", common.triangulate);
  common.no_creases = line.flag_or("no-creases", common.no_creases);
  common.strict = line.flag_or("strict", common.strict);
  if (line.has("options")) {
    const char* const what = "an object, like {\"tension\": \"1/2\"}";
    const JsonValue& options = line.required("options", what, JsonValue::Type::object);
    for (size_t i = 0; i < options.keys.size(); ++i) {
      const JsonValue& value = options.items[i];
      if (value.type != JsonValue::Type::string && value.type != JsonValue::Type::number)
        line.fail("options." + options.keys[i], "is " + show(value) + "; it should be a text or a number");
      common.options.push_back(options.keys[i] + "=" + value.text);
    }
  }
  for (const auto& [key, given] :
       {std::pair("mesh", &common.mesh), std::pair("scheme", &common.scheme), std::pair("output", &job.output)})
    if (given->empty()) line.required(key, "a text");
  line.finish();
  return job;
}

}  // namespace

std::vector<ManifestJob> read_manifest(const std::string& path, const BakeJob& defaults) {
  std::istringstream lines(read_file(path));
  std::vector<ManifestJob> jobs;
  std::map<std::string, std::int64_t> line_of_output;
  std::int64_t number = 0;
  for (std::string text; std::getline(lines, text);) {
    ++number;
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = fmt::format("{}:{}", path, number);
    jobs.push_back({number, read_job(text, path, number, defaults)});
    // Machines would write over each other's.
    const auto [other, is_new] =
        line_of_output.try_emplace(std::filesystem::path(jobs.back().job.output).lexically_normal().string(), number);
    if (!is_new)
      throw FormatError(
          fmt::format("{}: output: is that of line {} too; every job should have its own", place, other->second));
  }
  return jobs;
}

Shard parse_shard(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = parse_number<std::int64_t>(std::string_view(text).substr(0, slash));
    const auto count = parse_number<std::int64_t>(std::string_view(text).substr(slash + 1));
    if (number && count && number.value >= 1 && number.value <= count.value) return {number.value, count.value};
  }
  throw InvalidOption("--shard " + text + ": it should be i/n, like 3/8, with i from 1 to n");
}

}  // namespace sublimit::cli
