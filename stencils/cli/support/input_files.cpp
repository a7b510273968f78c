// SPDX-License-Identifier: Apache-2.0
#include "support/input_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

using enum FileKind::State;

/// An argument or option that names a file to read.
struct Role {
  const char* owner;  ///< the subcommand, or the program; nullptr: any that has it
  const char* name;
  std::string takes;  ///< in words; {}: extensions of formats with the contents
  std::vector<Content> wanted;
  std::vector<Content> also = {};           ///< the readers say more of these
  std::vector<FileKind::State> other = {};  ///< directories, empty files; known: any file
};

/// The first that fits is taken.
const std::vector<Role>& roles() {
  using namespace contents;
  static const std::vector<Role> all{
      // Whatever it is, verify answers by its verdict.
      {"verify",
       "TABLE",
       "a table of `sublimit bake` or a report of `sublimit analyze --json`",
       {tables, reports},
       {},
       {empty, known}},
      {nullptr, "TABLE", "a table of `sublimit bake`, {}", {tables}},
      {"sublimit-mpi", "POINTS", "points of the table's cage, {}", {mesh_parts, arrays}},
      {nullptr, "POINTS", "points of the table's cage, {}", {meshes, rows, arrays}, {recipes}},
      {nullptr, "SCENE", "a scene of USD, {}", {scenes}, {meshes}},  // an extension tells more than first bytes
      {nullptr, "RECIPE", "recipes, {}", {recipes}},
      {nullptr, "FIELD", "a field, {}", {recipes}},
      {"sublimit-mpi", "MESH", "a control mesh, {}", {mesh_parts}},
      // The readers say more of a polygon, a recipe or nothing in the place of a mesh.
      {nullptr, "MESH", "a control mesh, {}", {meshes}, {rows, recipes}, {empty}},
      {nullptr, "--sidecar", "tags, {}", {recipes}},
      {nullptr, "--at", "places, {}", {rows, arrays}},
      {nullptr, "--rays", "rays, {}", {rows, arrays}},
      {nullptr, "--rates", "rates of edges, {}", {rows, arrays}},
      {nullptr, "--targets", "targets, {}", {rows, arrays}},
      {nullptr, "--pin", "vertices, as numbers or in a {}", {rows, arrays}},
      {nullptr, "--points", "points, {}", {rows, arrays, meshes}},
      {nullptr, "--cloud", "points, {}", {rows, arrays, meshes}},
      {nullptr, "--tessellation", "triangles of `sublimit tessellate`, {}", {vertex_values}},
      {nullptr, "--manifest", "jobs, {}", {jobs}, {}, {empty}},  // there may be none
      {nullptr, "--dictionary", "a dictionary that `bake` keeps, or a directory of them", {tables}, {}, {directory}},
  };
  return all;
}

std::string words_of(const Role& role) {
  return fmt::format(fmt::runtime(role.takes), listed(all_formats().readers(role.wanted), "or"));
}

bool is_taken(const Role& role, const FileKind& kind) {
  if (std::ranges::find(role.other, kind.state) != role.other.end()) return true;
  const auto reads_it = [&](Content content) {
    // Formats may begin alike: what begins as a .jsonl is found as a .json.
    return std::ranges::any_of(all_formats().rows(), [&](const FileFormat& row) {
      return kind.format && row.name == kind.format->name && reads(row, content);
    });
  };
  return std::ranges::any_of(role.wanted, reads_it) || std::ranges::any_of(role.also, reads_it);
}

/// A file that the command line names.
struct Given {
  const Role* role;
  std::string path;
  FileKind kind;
  bool fits() const { return kind.state == unknown || is_taken(*role, kind); }
};

/// In words of the message, without what is wrong.
std::string argument_of(const Given& given) { return fmt::format("{} is {}", given.role->name, words_of(*given.role)); }

[[noreturn]] void refuse(const Given& given, const std::vector<Given>& all) {
  if (given.kind.state == directory)
    throw IoError(fmt::format("{}: it is a directory; name a file in it ({})", given.path, argument_of(given)));
  if (given.kind.state == empty) throw FormatError(fmt::format("{}: empty; {}", given.path, argument_of(given)));
  for (const Given& other : all)
    if (&other != &given && is_taken(*other.role, given.kind) && is_taken(*given.role, other.kind))
      throw FormatError(fmt::format("{} is {} and {} is {}: they are swapped; {}, and {}", given.path,
                                    name_of(given.kind), other.path, name_of(other.kind), argument_of(given),
                                    argument_of(other)));
  throw FormatError(fmt::format("{} is {}; {}", given.path, name_of(given.kind), argument_of(given)));
}

/// The role of an option of a subcommand; null if it names no file to read.
const Role* role_of(const CLI::App& command, const CLI::Option& option) {
  const auto role = std::ranges::find_if(roles(), [&](const Role& r) {
    const bool owned = !r.owner || command.get_name() == r.owner ||
                       (command.get_parent() && command.get_parent()->get_name() == r.owner);
    return owned && option.check_name(r.name);
  });
  return role == roles().end() ? nullptr : &*role;
}

}  // namespace

FileKind file_kind(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::path opened = opened_path(path);
  const std::filesystem::file_status status = std::filesystem::status(opened, ignored);
  if (std::filesystem::is_directory(status)) return {directory};
  if (!std::filesystem::is_regular_file(status)) return {};
  std::ifstream file(opened, std::ios::binary);
  if (!file.is_open()) return {};  // its reader says why
  std::string text(4096, '\0');
  file.read(text.data(), std::ssize(text));
  text.resize(size_t(file.gcount()));
  if (text.empty()) return {file.bad() ? unknown : empty};
  const FileFormat* const format = all_formats().recognized(text);
  return {format ? known : unknown, format};
}

std::string name_of(const FileKind& kind) {
  switch (kind.state) {
    case directory:
      return "a directory";
    case empty:
      return "an empty file";
    case known:
      return std::string(kind.format->name);
    case unknown:
      break;
  }
  return "a file of an unknown kind";
}

std::string input_meaning(const CLI::App& command, const CLI::Option& option) {
  const Role* role = role_of(command, option);
  return role ? words_of(*role) : "";
}

std::vector<std::string> input_extensions(const CLI::App& command, const CLI::Option& option) {
  const Role* const role = role_of(command, option);
  if (!role) return {};
  std::vector<Content> all = role->wanted;
  all.insert(all.end(), role->also.begin(), role->also.end());
  std::vector<std::string> extensions = all_formats().readers(all);
  for (std::string& extension : extensions) extension.erase(0, 1);
  return extensions;
}

std::optional<std::string> input_extension(const CLI::App& command, const CLI::Option& option,
                                           std::string_view first_bytes) {
  const Role* const role = role_of(command, option);
  if (!role) return std::nullopt;
  const FileStart start(first_bytes);
  for (const bool taken : {true, false})
    for (const FileFormat& row : all_formats().rows()) {
      const auto reads_it = [&](Content content) { return reads(row, content); };
      if (!first_bytes.empty() && row.begins && row.begins(start) &&
          (!taken || std::ranges::any_of(role->wanted, reads_it) || std::ranges::any_of(role->also, reads_it)))
        return std::string(row.extensions.front());
    }
  if (std::ranges::find(role->other, known) != role->other.end()) return "";
  const std::vector<std::string> all = all_formats().readers(role->wanted);
  const bool may_be_empty = std::ranges::find(role->other, empty) != role->other.end();
  if (all.size() == 1 && (!first_bytes.empty() || may_be_empty)) return all.front();
  return std::nullopt;
}

void check_input_files(const CLI::App& command) {
  std::vector<Given> all;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() != 1) continue;
    if (const Role* role = role_of(command, *option))
      all.push_back({role, option->results().front(), file_kind(option->results().front())});
  }
  for (const Given& given : all)
    if (!given.fits()) refuse(given, all);
}

}  // namespace sublimit::cli
