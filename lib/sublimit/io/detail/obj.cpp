// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj_calls.h"
#include "sublimit/io/detail/decimals.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/obj_indices.h"
#include "sublimit/io/detail/obj_keywords.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/io/detail/obj_tags.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

class ObjReader {
 public:
  explicit ObjReader(std::string_view text, std::string_view name, const ObjCounts& before = {},
                     std::vector<TextScanner::Origin> origins = {})
      : scanner_(text, name, TextScanner::Continuation::backslash, before.lines + 1),
        num_vertices_(before.vertices),
        faces_before_(before.faces) {
    texture_.count = before.texture_coordinates;
    scanner_.set_origins(std::move(origins));
  }

  /// @param warnings  that come first: of lines that are left out
  Mesh read(std::vector<std::string> warnings = {}) {
    if (!warnings.empty()) left_out_ = "; " + warnings.front();
    mesh_.warnings = std::move(warnings);
    read_lines();
    finish();
    return std::move(mesh_);
  }

  Mesh read_part() {
    read_lines();
    mesh_.positions = Eigen::Map<const Points>(coordinates_.data(), Eigen::Index(coordinates_.size() / 3), 3);
    if (!texture_.values.empty() || (!texture_.corners.empty() && texture_.line_without < 0)) add_channel();
    return std::move(mesh_);
  }

 private:
  void read_lines() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.token();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "vt") {
        read_texture_coordinates();
      } else if (keyword == "f") {
        read_face();
      } else if (keyword == "t") {
        tags_.read(scanner_, mesh_);
      } else if (keyword == "g") {
        groups_.read(scanner_, mesh_.groups);
      } else if (keyword == "o") {
        objects_.read(scanner_, mesh_.objects);
      } else if (keyword == "usemtl") {
        materials_.read(scanner_, mesh_.materials);
      } else if (keyword == "s") {
        smoothing_groups_.read(scanner_, mesh_.smoothing_groups);
      } else if (keyword == "mtllib") {
        if (std::string file = rest_of_line(scanner_); !file.empty()) mesh_.material_files.push_back(std::move(file));
      } else if (keyword == "call") {  // of a text alone, or of a part of a file
        mesh_.warnings.push_back(scanner_.place() + "call left out: the file that it names is not read here");
      } else if (keyword == "vn" || keyword == "vp" || is_attribute_keyword(keyword)) {
        continue;
      } else if (!keyword.empty() && !elements_.count(scanner_, keyword) && !is_free_form_keyword(keyword)) {
        unknown_.warn(scanner_, keyword, mesh_.warnings);
      }
    }
  }

  void read_vertex() {
    make_room(coordinates_.size() + 3 > coordinates_.capacity());
    for (const char* const what : {"coordinate x", "coordinate y", "coordinate z"}) {
      coordinates_.push_back(scanner_.finite(scanner_.token(), what));
    }
    read_colour();
    ++num_vertices_;
  }

  // Lists that double are there twice meanwhile: a short text can be a large mesh.
  void make_room(bool grows) const {
    if (!grows || coordinates_.size() + mesh_.face_vertices.size() < std::size_t{1} << 16) return;
    const double lists =
        3.0 * double(sizeof(double) * coordinates_.size() + sizeof(Index) * mesh_.face_vertices.size());
    check_memory(scanner_.name() + ": the text, " + format_number(coordinates_.size() / 3) + " vertices and " +
                     format_number(mesh_.face_sizes.size()) + " faces to begin with",
                 double(scanner_.offset() + scanner_.rest()) + lists, "a smaller mesh can be read");
  }

  // Three or four numbers behind the coordinates are a colour; a single one is a weight, which a mesh has no use for.
  void read_colour() {
    std::array<double, 4> colour{0, 0, 0, 1};
    std::size_t count = 0;
    for (std::string_view token; !(token = scanner_.token()).empty(); ++count) {
      const double number = scanner_.real(token, "number behind a vertex");
      if (count < colour.size()) colour[count] = number;
    }
    if (count == 1 && colour[0] != 1 && !std::exchange(warned_of_weight_, true))
      mesh_.warnings.push_back(scanner_.place() + "weight " + format_number(colour[0]) +
                               " behind a vertex left out, and any others; a mesh has none, free-form surfaces have");
    if (count < 3) {
      if (colours_.line_without < 0) colours_.line_without = scanner_.line();
      return;
    }
    for (std::size_t i = 0; i < std::min(count, colour.size()); ++i)
      if (!std::isfinite(colour[i]))
        throw InvalidMesh(scanner_.place() + "a colour is " + format_number(colour[i]) + "; it should be 0 to 1");
    colours_.alpha = colours_.alpha || count > 3;
    colours_.values.insert(colours_.values.end(), colour.begin(), colour.end());
  }

  void read_texture_coordinates() {
    std::size_t count = 0;
    for (std::string_view token; count < 3 && !(token = scanner_.token()).empty(); ++count)
      texture_.values.push_back(scanner_.finite(token, "texture coordinate"));
    if (count == 0) scanner_.finite("", "texture coordinate");
    for (std::string_view token; !(token = scanner_.token()).empty();)
      scanner_.real(token, "number behind a texture coordinate");
    texture_.values.resize(texture_.values.size() + 3 - count, 0);  // OBJ: absent ones are 0
    texture_.columns = std::max(texture_.columns, count);
    ++texture_.count;
  }

  void read_face() {
    make_room(mesh_.face_vertices.size() == mesh_.face_vertices.capacity());
    const std::int64_t line = scanner_.line();
    std::int64_t size = 0;
    for (std::string_view token; !(token = scanner_.token()).empty(); ++size) read_corner(token);
    if (size < 3) {
      throw InvalidMesh(scanner_.place(line) + "face " + format_number(faces_before_ + mesh_.num_faces()) + " has " +
                        format_number(size) + " corners; it should have at least 3");
    }
    checked_index(std::int64_t(mesh_.face_vertices.size()), scanner_.name(), "corners of faces");
    const std::size_t face = mesh_.face_sizes.size();
    groups_.add_face(face, mesh_.groups);
    objects_.add_face(face, mesh_.objects);
    materials_.add_face(face, mesh_.materials);
    smoothing_groups_.add_face(face, mesh_.smoothing_groups);
    mesh_.face_sizes.push_back(static_cast<Index>(size));
  }

  // One corner: its vertex, then perhaps a texture coordinate and a normal, which is checked for form only.
  void read_corner(std::string_view token) {
    std::size_t slash = token.find('/');
    mesh_.face_vertices.push_back(indices_.read(scanner_, token.substr(0, slash), num_vertices_));
    std::int64_t value = 0;  // none
    for (int part = 0; slash != std::string_view::npos; ++part) {
      const std::size_t first = slash + 1;
      slash = token.find('/', first);
      const std::string_view index = token.substr(first, slash - first);
      if (part == 2) {
        throw FormatError(scanner_.place() + "corner " + in_quotes(token) +
                          " has more than 3 indices; it should be 'a', 'a/b', 'a//c' or 'a/b/c'");
      }
      if (index.empty()) continue;
      const std::int64_t number = scanner_.integer(index, "index");
      if (number == 0) warn_of_index_zero(part == 0 ? "texture coordinate" : "normal");
      if (part == 0) value = number;
    }
    if (value != 0 || !texture_.corners.empty()) add_texture_corner(value);
    if (value == 0 && texture_.line_without < 0) texture_.line_without = scanner_.line();
  }

  // Some exporters write 0 where there is none.
  void warn_of_index_zero(const char* what) {
    if (!std::exchange(warned_of_zero_, true))
      mesh_.warnings.push_back(scanner_.place() + "index 0 of a " + what +
                               " taken as none; indices of an OBJ file count from 1");
  }

  // The texture coordinate of the corner that was read last, 0 for none.
  void add_texture_corner(std::int64_t number) {
    texture_.corners.resize(mesh_.face_vertices.size() - 1, -1);  // those before the first that has one
    texture_.corners.push_back(-1);
    if (number == 0) return;
    const std::int64_t index = number > 0 ? number - 1 : texture_.count + number;
    if (number > texture_.most.index) texture_.most = {.index = number, .line = scanner_.line()};
    if (index < 0 && texture_.beyond.line < 0) texture_.beyond = {.index = number, .line = scanner_.line()};
    texture_.corners.back() = static_cast<Index>(std::clamp<std::int64_t>(index, 0, std::numeric_limits<Index>::max()));
  }

  void finish() {
    const std::string& name = scanner_.name();
    if (mesh_.face_sizes.empty() && elements_.has_free_form())
      throw InvalidMesh(scanner_.place(elements_.first_free_form) + "the file holds " + elements_.free_form() +
                        ", which are free-form statements, and no mesh; a mesh has lines 'f a b c ...'");
    if (num_vertices_ == 0) throw InvalidMesh(name + ": no vertices; an OBJ mesh has lines 'v x y z'" + left_out_);
    if (mesh_.face_sizes.empty())
      throw InvalidMesh(name + ": no faces; an OBJ mesh has lines 'f a b c ...'" + left_out_);
    const Index vertices = checked_index(num_vertices_, name, "vertices");
    indices_.check(scanner_, vertices);
    mesh_.positions = Eigen::Map<const Points>(coordinates_.data(), vertices, 3);
    tags_.settle(scanner_, mesh_);
    finish_colours();
    finish_texture_coordinates();
    if (elements_.has_free_form())
      mesh_.warnings.push_back(scanner_.place(elements_.first_free_form) + "the file also holds " +
                               elements_.free_form() + " (free-form statements), which are no part of the mesh");
  }

  void finish_colours() {
    if (colours_.values.empty()) return;
    if (colours_.line_without >= 0) {
      mesh_.warnings.push_back(scanner_.place(colours_.line_without) +
                               "vertices without colour, which others have; colours are dropped");
      return;
    }
    const ValueType type = type_of_decimals(colours_.values);
    for (std::size_t i = 0; i < (colours_.alpha ? 4u : 3u); ++i) {
      Mesh::Values& channel = mesh_.vertex_values.emplace_back();
      channel.name = colour_names[i];
      channel.type = type;
      for (std::size_t k = i; k < colours_.values.size(); k += 4) channel.values.push_back(colours_.values[k]);
    }
  }

  void finish_texture_coordinates() {
    if (texture_.count == 0 || texture_.corners.empty()) return;
    const auto count = [&] { return format_number(texture_.count) + " texture coordinates"; };
    if (texture_.most.index > texture_.count)
      throw InvalidMesh(scanner_.place(texture_.most.line) + "texture coordinate " +
                        format_number(texture_.most.index) + " is out of range; the file has " + count() + ", 1 to " +
                        format_number(texture_.count));
    if (texture_.beyond.line >= 0)
      throw InvalidMesh(scanner_.place(texture_.beyond.line) + "texture coordinate " +
                        format_number(texture_.beyond.index) +
                        " counts back beyond the first so far; relative indices start at -1, the last one");
    if (texture_.line_without >= 0) {
      mesh_.warnings.push_back(
          scanner_.place(texture_.line_without) +
          "corners without texture coordinate, which others have; texture coordinates are dropped");
      return;
    }
    add_channel();
  }

  void add_channel() {
    const Index rows = checked_index(std::int64_t(texture_.values.size() / 3), scanner_.name(), "texture coordinates");
    mesh_.face_varying.push_back({.name = "uv",
                                  .values = Eigen::Map<const Points>(texture_.values.data(), rows, 3)
                                                .leftCols(static_cast<Eigen::Index>(texture_.columns)),
                                  .indices = std::move(texture_.corners)});
  }

  struct Colours {
    std::vector<double> values;  // four each
    bool alpha = false;
    std::int64_t line_without = -1;
  };
  struct Forward {
    std::int64_t index, line;
  };
  struct Texture {
    std::vector<double> values;  // three each
    std::int64_t count = 0;
    std::size_t columns = 0;             // that some line has
    std::vector<Index> corners;          // -1 for none; empty before the first
    Forward most{0, -1}, beyond{0, -1};  // the largest index, and the first that counts back too far
    std::int64_t line_without = -1;
  };

  TextScanner scanner_;
  Mesh mesh_;
  ObjTags tags_;
  std::vector<double> coordinates_;
  std::int64_t num_vertices_, faces_before_;
  ObjIndices indices_{"vertices"};
  Texture texture_;
  Colours colours_;
  ObjNames groups_, objects_, materials_, smoothing_groups_;
  bool warned_of_zero_ = false, warned_of_weight_ = false;
  std::string left_out_;  // why lines may be missing, for messages
  ObjElements elements_;
  UnknownKeywords unknown_;
};

}  // namespace

Mesh read_obj(const std::filesystem::path& path) {
  std::string text = read_inflated(path);
  require_text(text, path.string(), "OBJ");
  CalledText called = with_called_files(std::move(text), path);
  return ObjReader(called.text, path.string(), {}, std::move(called.origins)).read(std::move(called.warnings));
}

ObjCounts count_obj(std::string_view part) {
  TextScanner scanner(part, "", TextScanner::Continuation::backslash);
  ObjCounts counts;
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.token();
    counts.vertices += keyword == "v";
    counts.texture_coordinates += keyword == "vt";
    counts.faces += keyword == "f";
    if (is_name_keyword(keyword)) rest_of_line(scanner);
  }
  counts.lines = scanner.line() - 1;
  return counts;
}

Mesh parse_obj_part(std::string_view part, std::string_view name, const ObjCounts& before) {
  return ObjReader(part, name, before).read_part();
}

Mesh parse_obj(std::string_view text, std::string_view name) {
  require_text(text, name, "OBJ");
  return ObjReader(text, name).read();
}

}  // namespace sublimit
