// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <array>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "commands/bake_manifest.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

/// A line of a manifest, and where it is.
class Line {
 public:
  Line(std::string place, const std::filesystem::path& directory) : place_(std::move(place)), directory_(directory) {}

  BakeJob job(const std::string& text, BakeJob job) const {
    const nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
    if (object.is_discarded()) fail("not JSON; every line should be one object, like {\"mesh\": \"cage.obj\", ...}");
    if (!object.is_object()) fail("not an object; it should be like {\"mesh\": \"cage.obj\", ...}");
    for (const auto& [key, value] : object.items()) set(job, key, value);
    for (const auto& [key, given] : {std::pair("mesh", &job.common.mesh), std::pair("scheme", &job.common.scheme),
                                     std::pair("output", &job.output)})
      if (given->empty()) fail(fmt::format("\"{}\" is missing", key));
    return job;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw FormatError(place_ + what); }
  [[noreturn]] void fail(const std::string& key, const nlohmann::json& value, const char* right) const {
    fail(fmt::format("\"{}\" is {}; it should be {}", key, value.dump().substr(0, 60), right));
  }

  std::string word(const std::string& key, const nlohmann::json& value) const {
    if (!value.is_string() || value.get<std::string>().empty()) fail(key, value, "a text");
    return value;
  }
  std::string path(const std::string& key, const nlohmann::json& value) const {
    return (directory_ / word(key, value)).string();  // an absolute path stays one
  }
  bool flag(const std::string& key, const nlohmann::json& value) const {
    if (!value.is_boolean()) fail(key, value, "true or false");
    return value;
  }
  int whole(const std::string& key, const nlohmann::json& value) const {
    if (!value.is_number_integer() || value < 0 || value > std::numeric_limits<int>::max())
      fail(key, value, "a whole number");
    return value;
  }
  std::string one_of(const std::string& key, const nlohmann::json& value, std::span<const char* const> words) const {
    std::string right;
    for (const char* known : words) {
      if (value.is_string() && value == known) return known;
      right += (right.empty() ? "" : ", ") + std::string(known);
    }
    fail(key, value, ("one of " + right).c_str());
  }

  void set(BakeJob& job, const std::string& key, const nlohmann::json& value) const {
    if (key == "mesh") {
      job.common.mesh = path(key, value);
    } else if (key == "output") {
      job.output = path(key, value);
    } else if (key == "at") {
      job.at = path(key, value);
    } else if (key == "tessellation") {
      job.tessellation = path(key, value);
    } else if (key == "scheme") {
      job.common.scheme = word(key, value);
    } else if (key == "levels") {
      job.levels = whole(key, value);
    } else if (key == "grid") {
      job.grid = whole(key, value);
    } else if (key == "limit") {
      job.limit = flag(key, value);
    } else if (key == "derivatives") {
      job.derivatives = whole(key, value);
      if (job.derivatives > 2) fail(key, value, "0, 1 or 2");
    } else if (key == "precision") {
      job.is_float = one_of(key, value, std::array{"float", "double"}) == "float";
    } else if (key == "boundary") {
      job.common.boundary = one_of(key, value, boundary_words);
    } else if (key == "creasing") {
      job.common.creasing = one_of(key, value, creasing_words);
    } else if (key == "triangles") {
      job.common.triangles = one_of(key, value, triangles_words);
    } else if (key == "face-varying") {
      job.common.face_varying = one_of(key, value, face_varying_words);
    } else if (key == "tags") {
      job.tags = flag(key, value);
    } else if (key == "triangulate") {
      job.common.triangulate = flag(key, value);
    } else if (key == "no-creases") {
      job.common.no_creases = flag(key, value);
    } else if (key == "strict") {
      job.common.strict = flag(key, value);
    } else if (key == "options") {
      if (!value.is_object()) fail(key, value, "an object, like {\"tension\": \"1/2\"}");
      for (const auto& [name, text] : value.items()) {
        if (!text.is_string() && !text.is_number()) fail(name, text, "a text or a number");
        job.common.options.push_back(name + "=" + (text.is_string() ? text.get<std::string>() : text.dump()));
      }
    } else {
      fail(fmt::format(
          "\"{}\" is no key of a job; they are mesh, scheme, output, levels, limit, grid, at, "
          "tessellation, derivatives, precision, options, boundary, creasing, triangles, triangulate, no-creases, face-varying, tags, "
          "strict",
          key));
    }
  }

  std::string place_;
  const std::filesystem::path& directory_;
};

}  // namespace

std::vector<ManifestJob> read_manifest(const std::string& path, const BakeJob& defaults) {
  const std::filesystem::path directory = std::filesystem::path(path).parent_path();
  std::istringstream lines(read_file(path));
  std::vector<ManifestJob> jobs;
  std::map<std::string, std::int64_t> line_of_output;
  std::int64_t number = 0;
  for (std::string text; std::getline(lines, text);) {
    ++number;
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = fmt::format("{}:{}: ", path, number);
    jobs.push_back({number, Line(place, directory).job(text, defaults)});
    // Machines would write over each other's.
    const auto [other, is_new] =
        line_of_output.try_emplace(std::filesystem::path(jobs.back().job.output).lexically_normal().string(), number);
    if (!is_new)
      throw FormatError(
          fmt::format("{}\"output\" is that of line {} too; every job should have its own", place, other->second));
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
