// SPDX-License-Identifier: Apache-2.0
#include "support/input_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

using Kinds = std::vector<FileKind>;

/// An argument or option that names a file to read.
struct Role {
  const char* owner;  ///< the subcommand, or the program; nullptr: any that has it
  const char* name;
  const char* takes;  ///< "a table of `sublimit bake`"
  Kinds kinds;
};

/// The first that fits is taken.
const std::vector<Role>& roles() {
  using enum FileKind;
  static const std::vector<Role> all{
      // Whatever it is, verify answers by its verdict.
      {"verify",
       "TABLE",
       "a table of `sublimit bake` or a report of `sublimit analyze --json`",
       {FileKind::empty, obj, ply, off, csv, json, npy, safetensors, zip, matrix_market, xml, FileKind::step, brep,
        gltf}},
      {nullptr, "TABLE", "a table of `sublimit bake`, .safetensors", {safetensors}},
      {"sublimit-mpi",
       "POINTS",
       "points of the table's cage, .obj, .ply, .npy or .safetensors",
       {obj, ply, npy, safetensors}},
      {nullptr,
       "POINTS",
       "points of the table's cage, .obj, .ply, .off, .csv or .npy",
       {obj, ply, off, csv, npy, json}},
      {nullptr, "RECIPE", "recipes, .json", {json}},
      {nullptr, "FIELD", "a field, .json", {json}},
      {"sublimit-mpi", "MESH", "a control mesh, .obj, .ply or .safetensors", {obj, ply, safetensors}},
      // The readers say more of a polygon, a recipe or nothing in the place of a mesh.
      {nullptr, "MESH", "a control mesh, .obj, .ply or .off", {obj, ply, off, csv, json, FileKind::empty}},
      {nullptr, "--at", "places, .csv", {csv}},
      {nullptr, "--rays", "rays, .csv", {csv}},
      {nullptr, "--rates", "rates of edges, .csv", {csv}},
      {nullptr, "--targets", "targets, .csv", {csv}},
      {nullptr, "--pin", "vertices, as numbers or in a .csv", {csv}},
      {nullptr, "--points", "points, .csv, .npy, .obj, .ply or .off", {csv, npy, obj, ply, off}},
      {nullptr, "--cloud", "points, .csv, .obj, .ply or .off", {csv, obj, ply, off}},
      {nullptr, "--tessellation", "triangles of `sublimit tessellate`, .ply", {ply}},
      {nullptr, "--manifest", "jobs, .jsonl", {json, FileKind::empty}},  // there may be none
      {nullptr, "--dictionary", "a dictionary that `bake` keeps, or a directory of them", {safetensors, directory}},
  };
  return all;
}

/// A file that the command line names.
struct Given {
  const Role* role;
  std::string path;
  FileKind kind;
  bool fits() const { return kind == FileKind::unknown || std::ranges::find(role->kinds, kind) != role->kinds.end(); }
  bool fits(const Role& other) const { return std::ranges::find(other.kinds, kind) != other.kinds.end(); }
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view first_word(std::string_view line) {
  return line.substr(0, std::min(line.find_first_of(" \t\r"), line.size()));
}

/// The first line that is not blank and no comment, as OBJ, OFF and CSV have them.
std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    if (!line.empty() && line.front() != '#') return line;
  }
  return {};
}

template <size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::ranges::find(words, word) != words.end();
}

/// Fields without blanks inside and commas between: a sentence is no CSV.
bool is_csv(std::string_view line) {
  if (line.find(',') == std::string_view::npos) return false;
  bool blank = false, inside = false;  // there was a blank after the field began
  for (const char c : line) {
    if (c == ',') {
      blank = inside = false;
    } else if (is_blank(c)) {
      blank = inside;
    } else {
      if (blank) return false;
      inside = true;
    }
  }
  return true;
}

FileKind kind_of_text(std::string_view text) {
  using enum FileKind;
  constexpr std::array<std::string_view, 26> obj_words{
      "v",   "vt",   "vn",     "vp",   "f",    "l",     "p",    "g",    "o",    "s",    "mtllib", "usemtl", "t",
      "deg", "bmat", "cstype", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "end",    "sp",     "mg"};
  constexpr std::array<std::string_view, 8> off_words{"OFF",   "COFF", "NOFF", "STOFF",
                                                      "CNOFF", "4OFF", "nOFF", "STNOFF"};
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::string_view line = first_line(text);
  if (line.starts_with("%%MatrixMarket")) return matrix_market;
  if (line.starts_with("ISO-10303-21")) return FileKind::step;
  if (line.starts_with("DBRep_DrawableShape")) return brep;
  if (line.starts_with('<')) return xml;
  if (line.starts_with('{') || line.starts_with('[')) return json;
  const std::string_view word = first_word(line);
  if (word == "ply") return ply;
  if (is_one_of(word, off_words)) return off;
  if (is_one_of(word, obj_words)) return obj;
  if (is_csv(line)) return csv;
  return unknown;
}

/// In words of the message, without what is wrong.
std::string argument_of(const Given& given) { return fmt::format("{} is {}", given.role->name, given.role->takes); }

[[noreturn]] void refuse(const Given& given, const std::vector<Given>& all) {
  if (given.kind == FileKind::directory)
    throw IoError(fmt::format("{}: it is a directory; name a file in it ({})", given.path, argument_of(given)));
  if (given.kind == FileKind::empty) throw FormatError(fmt::format("{}: empty; {}", given.path, argument_of(given)));
  for (const Given& other : all)
    if (&other != &given && given.fits(*other.role) && other.fits(*given.role))
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
  using enum FileKind;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status)) return directory;
  if (!std::filesystem::is_regular_file(status)) return unknown;
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open()) return unknown;  // its reader says why
  std::string text(4096, '\0');
  file.read(text.data(), std::ssize(text));
  text.resize(size_t(file.gcount()));
  if (text.empty()) return file.bad() ? unknown : FileKind::empty;
  if (text.starts_with("\x93NUMPY")) return npy;
  if (text.starts_with("PK\x03\x04")) return zip;
  if (text.starts_with("glTF")) return gltf;
  // The length of a header that begins with a brace, in eight bytes.
  if (text.size() > 8 && text[8] == '{' && text[7] == '\0' && text[6] == '\0') return safetensors;
  return kind_of_text(text);
}

const char* name_of(FileKind kind) {
  using enum FileKind;
  switch (kind) {
    case directory:
      return "a directory";
    case FileKind::empty:
      return "an empty file";
    case obj:
      return "an OBJ file";
    case ply:
      return "a PLY file";
    case off:
      return "an OFF file";
    case csv:
      return "a CSV file";
    case json:
      return "a JSON file";
    case npy:
      return "a NumPy array";
    case safetensors:
      return "a table (safetensors)";
    case zip:
      return "a zip archive";
    case matrix_market:
      return "a Matrix Market file";
    case xml:
      return "an XML or HTML file";
    case FileKind::step:
      return "a STEP file";
    case brep:
      return "a BREP file";
    case gltf:
      return "a glTF file";
    case unknown:
      break;
  }
  return "a file of an unknown kind";
}

std::string input_meaning(const CLI::App& command, const CLI::Option& option) {
  const Role* role = role_of(command, option);
  return role ? role->takes : "";
}

std::vector<std::string> input_extensions(const CLI::App& command, const CLI::Option& option) {
  using enum FileKind;
  std::vector<std::string> extensions;
  const Role* role = role_of(command, option);
  if (!role) return extensions;
  const auto add = [&](std::initializer_list<const char*> names) {
    extensions.insert(extensions.end(), names.begin(), names.end());
  };
  for (const FileKind kind : role->kinds) {
    if (kind == obj) add({"obj"});
    if (kind == ply) add({"ply"});
    if (kind == off) add({"off"});
    if (kind == csv) add({"csv"});
    if (kind == json) add({"json", "jsonl"});
    if (kind == npy) add({"npy"});
    if (kind == safetensors) add({"safetensors"});
  }
  return extensions;
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
