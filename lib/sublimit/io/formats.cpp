// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/formats.h"

#include <algorithm>
#include <array>

#include "sublimit/io/detail/gltf.h"
#include "sublimit/io/detail/gltf_layout.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/off.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/detail/polygon_files.h"
#include "sublimit/io/detail/stl.h"
#include "sublimit/io/detail/usd.h"
#include "sublimit/io/detail/usd_flat.h"
#include "sublimit/io/detail/usd_stage.h"
#include "sublimit/io/detail/usdz.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

using Abilities = std::vector<FileFormat::Ability>;
/// The extensions of a format with a content, or the words for them.
enum class As { extensions, words };

const FileFormat::Ability* find_ability(const Abilities& abilities, Content content) {
  const auto found = std::ranges::find(abilities, content, &FileFormat::Ability::content);
  return found == abilities.end() ? nullptr : &*found;
}

std::vector<std::string> names(const std::vector<FileFormat>& rows, Abilities FileFormat::*side,
                               const std::vector<Content>& wanted, As as) {
  std::vector<std::string> found;
  std::vector<const FileFormat*> taken;
  for (const Content content : wanted)
    for (const FileFormat& row : rows) {
      const FileFormat::Ability* const ability = find_ability(row.*side, content);
      if (!ability || std::ranges::find(taken, &row) != taken.end()) continue;
      taken.push_back(&row);
      if (as == As::words && !ability->words.empty())
        found.emplace_back(ability->words);
      else
        found.insert(found.end(), row.extensions.begin(), row.extensions.end());
    }
  return found;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Fields without blanks inside and commas between: neither a sentence nor JSON.
bool begins_csv(const FileStart& start) {
  const std::string_view line = start.line;
  if (line.find(',') == std::string_view::npos || line.find_first_of("{[<") == 0) return false;
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

bool begins_obj(const FileStart& start) {
  constexpr std::array<std::string_view, 26> words{
      "v",   "vt",   "vn",     "vp",   "f",    "l",     "p",    "g",    "o",    "s",    "mtllib", "usemtl", "t",
      "deg", "bmat", "cstype", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "end",    "sp",     "mg"};
  return std::ranges::find(words, start.word) != words.end();
}

bool begins_off(const FileStart& start) { return parse_off_keyword(start.word).has_value(); }

/// glTF in one of its two kinds of files, which hold the same.
FileFormat gltf_row(FileFormat kind) {
  using enum MeshField;
  kind.reads = kind.writes = {{contents::meshes}};
  kind.holds = {face_varying,   objects, materials,      MeshField::vertex_normals,
                corner_normals, texture, vertex_colours, MeshField::vertex_values};
  kind.keeps = {face_varying, objects, materials, vertex_colours, MeshField::vertex_values};
  kind.texture_columns = 2;
  kind.needs_normals = true;
  kind.read_mesh = read_gltf;
  kind.changes = changes_in_gltf;
  kind.vertex_order = gltf_vertex_order;
  return kind;
}

std::vector<FileFormat> rows() {
  using enum MeshField;
  using namespace contents;
  const std::vector<MeshField> usd_fields_kept{creases,      corners,          knot_intervals, holes,
                                               rules,        face_varying,     groups,         objects,
                                               materials,    smoothing_groups, vertex_colours, MeshField::vertex_values,
                                               face_colours, face_values};
  std::vector<MeshField> usd_fields = usd_fields_kept;
  usd_fields.insert(usd_fields.end(), {MeshField::vertex_normals, corner_normals, texture, face_ids, comments});
  return {
      {.name = "an OBJ file",
       .extensions = {".obj"},
       .begins = begins_obj,
       .reads = {{meshes}, {mesh_parts}, {contents::vertex_normals}, {polygons, ".obj (lines)"}, {free_form}},
       .writes = {{meshes}, {polygons, ".obj (lines)"}, {free_form}},
       .holds = {creases, corners, knot_intervals, holes, rules, face_varying, groups, objects, materials,
                 smoothing_groups, MeshField::vertex_normals, corner_normals, face_ids, vertex_colours, comments},
       .keeps = {creases, corners, knot_intervals, holes, rules, face_varying, groups, objects, materials,
                 smoothing_groups, vertex_colours},
       .read_mesh = read_obj,
       .write_mesh = write_obj,
       .parse_polygon = [](std::string_view text, std::string_view name,
                           bool) { return parse_polygon_obj(text, name); },
       .format_polygon = format_polygon_obj},
      {.name = "a PLY file",
       .extensions = {".ply"},
       .begins = [](const FileStart& start) { return start.word == "ply"; },
       .reads = {{meshes}, {mesh_parts, "binary .ply"}, {contents::vertex_values}},
       .writes = {{meshes}, {mesh_parts}, {contents::vertex_values}},
       .holds = {face_varying, MeshField::vertex_normals, texture, face_ids, vertex_colours, MeshField::vertex_values,
                 face_colours, face_values, comments},
       .keeps = {face_varying, vertex_colours, MeshField::vertex_values, face_colours, face_values},
       .texture_columns = 2,
       .read_mesh = read_ply,
       .write_mesh = write_ply,
       .changes = changes_in_ply},
      {.name = "an OFF file",
       .extensions = {".off"},
       .begins = begins_off,
       .reads = {{meshes}},
       .writes = {{meshes}},
       .holds = {vertex_colours, face_colours},
       .keeps = {vertex_colours, face_colours},
       .read_mesh = read_off,
       .write_mesh = write_off,
       .changes = changes_in_off},
      {.name = "an STL file",
       .extensions = {".stl"},
       .begins = [](const FileStart& start) { return start.word == "solid" || is_binary_stl(start.bytes); },
       .reads = {{meshes}},
       .writes = {{meshes}},
       .read_mesh = read_stl,
       .write_mesh = write_stl,
       .changes = changes_in_stl},
      gltf_row({.name = "a glTF file",
                .extensions = {".glb"},
                .begins = [](const FileStart& start) { return start.bytes.starts_with("glTF"); },
                .write_mesh = write_glb}),
      gltf_row({.name = "a glTF file",
                .extensions = {".gltf"},
                .begins = [](const FileStart& start) { return begins_gltf(start.bytes); },
                .write_mesh = write_gltf}),
      {.name = "a USD file",
       .extensions = {".usda", ".usd"},
       .begins = [](const FileStart& start) { return start.bytes.starts_with("#usda") || is_usd_crate(start.bytes); },
       .reads = {{meshes}, {scenes}},
       .writes = {{meshes}, {scenes}},
       .holds = usd_fields,
       .keeps = usd_fields_kept,
       .read_mesh = read_usd,
       .write_mesh = write_usda,
       .format_scene = flattened_text},
      {.name = "a USD package",
       .extensions = {".usdz"},
       .begins = [](const FileStart& start) { return begins_usdz(start.bytes); },
       .reads = {{meshes}, {scenes}},
       .writes = {{meshes}, {scenes}},
       .holds = usd_fields,
       .keeps = usd_fields_kept,
       .read_mesh = read_usd,
       .write_mesh = write_usdz,
       .format_scene = flattened_package},
      {.name = "a CSV file",
       .extensions = {".csv"},
       .begins = begins_csv,
       .reads = {{tangents}, {polygons}, {contents::rows}},
       .writes = {{tangents}, {polygons}, {contents::rows}},
       .parse_polygon = parse_polygon_csv,
       .format_polygon = format_polygon_csv},
      {.name = "a STEP file",
       .extensions = {".step", ".stp"},
       .begins = [](const FileStart& start) { return start.line.starts_with("ISO-10303-21"); },
       .writes = {{cad}, {step}}},
      {.name = "a BREP file",
       .extensions = {".brep"},
       .begins = [](const FileStart& start) { return start.line.starts_with("DBRep_DrawableShape"); },
       .writes = {{cad}}},
  };
}

}  // namespace

FileStart::FileStart(std::string_view first_bytes) : bytes(first_bytes) {
  if (bytes.substr(0, 16).find('\0') != std::string_view::npos) return;  // binary
  std::string_view text = bytes;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  while (!text.empty() && line.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    if (line.starts_with('#')) line = {};
  }
  word = line.substr(0, std::min(line.find_first_of(" \t\r"), line.size()));
}

std::vector<MeshField> fields_of(const Mesh& mesh) {
  using enum MeshField;
  std::vector<MeshField> fields;
  const auto add = [&](bool has, MeshField field) {
    if (has) fields.push_back(field);
  };
  add(!mesh.creases.empty(), creases);
  add(!mesh.corners.empty(), corners);
  add(!mesh.knot_intervals.empty(), knot_intervals);
  add(!mesh.holes.empty(), holes);
  add(mesh.boundary || mesh.creasing || mesh.triangles || mesh.face_varying_interpolation, rules);
  add(!mesh.face_varying.empty(), face_varying);
  add(!mesh.groups.of_face.empty(), groups);
  add(!mesh.objects.of_face.empty(), objects);
  add(!mesh.materials.of_face.empty(), materials);
  add(!mesh.smoothing_groups.of_face.empty(), smoothing_groups);
  add(mesh.normals.rows() > 0 && mesh.face_normals.empty(), vertex_normals);
  add(!mesh.face_normals.empty(), corner_normals);
  add(mesh.texture.rows() > 0, texture);
  add(!mesh.face_ids.empty(), face_ids);
  const auto add_values = [&](const std::vector<Mesh::Values>& values, MeshField colours, MeshField others) {
    const auto found = find_colours(values);
    const std::ptrdiff_t taken = found ? 3 + ((*found)[3] >= 0) : 0;
    add(found.has_value(), colours);
    add(std::ssize(values) > taken, others);
  };
  add_values(mesh.vertex_values, vertex_colours, vertex_values);
  add_values(mesh.face_values, face_colours, face_values);
  add(!mesh.comments.empty(), comments);
  return fields;
}

std::string_view name_of(MeshField field) {
  switch (field) {
    case MeshField::creases:
      return "creases";
    case MeshField::corners:
      return "corners";
    case MeshField::knot_intervals:
      return "knot intervals";
    case MeshField::holes:
      return "holes";
    case MeshField::rules:
      return "rules of refinement";
    case MeshField::face_varying:
      return "texture coordinates of corners";
    case MeshField::groups:
      return "groups";
    case MeshField::objects:
      return "objects";
    case MeshField::materials:
      return "materials";
    case MeshField::smoothing_groups:
      return "smoothing groups";
    case MeshField::vertex_normals:
      return "normals";
    case MeshField::corner_normals:
      return "normals of corners";
    case MeshField::texture:
      return "texture coordinates of vertices";
    case MeshField::face_ids:
      return "numbers of faces";
    case MeshField::vertex_colours:
      return "colours of vertices";
    case MeshField::vertex_values:
      return "values at vertices";
    case MeshField::face_colours:
      return "colours of faces";
    case MeshField::face_values:
      return "values of faces";
    case MeshField::comments:
      return "comments";
  }
  return {};
}

const FileFormat* FileFormats::find(const std::filesystem::path& path) const {
  const std::string extension = file_extension(path);
  const auto found = std::ranges::find_if(rows_, [&](const FileFormat& row) {
    return std::ranges::find(row.extensions, extension) != row.extensions.end();
  });
  return found == rows_.end() ? nullptr : &*found;
}

const FileFormat* FileFormats::reader(const std::filesystem::path& path, Content content) const {
  const FileFormat* const format = find(content.compressed ? without_gz(path) : path);
  return format && find_ability(format->reads, content) ? format : nullptr;
}

const FileFormat* FileFormats::writer(const std::filesystem::path& path, Content content) const {
  const FileFormat* const format = find(path);
  return format && find_ability(format->writes, content) ? format : nullptr;
}

const FileFormat* FileFormats::recognized(std::string_view first_bytes) const {
  const FileStart start(first_bytes);
  const auto found =
      std::ranges::find_if(rows_, [&](const FileFormat& row) { return row.begins && row.begins(start); });
  return found == rows_.end() ? nullptr : &*found;
}

bool FileFormats::holds(const std::filesystem::path& path, MeshField field) const {
  const FileFormat* const format = find(path);
  return format && std::ranges::find(format->holds, field) != format->holds.end();
}

std::vector<std::string> FileFormats::readers(const std::vector<Content>& wanted) const {
  return names(rows_, &FileFormat::reads, wanted, As::extensions);
}

std::vector<std::string> FileFormats::writers(const std::vector<Content>& wanted) const {
  return names(rows_, &FileFormat::writes, wanted, As::extensions);
}

std::vector<std::string> FileFormats::holders(MeshField field) const {
  std::vector<std::string> found;
  for (const FileFormat& row : rows_)
    if (std::ranges::find(row.holds, field) != row.holds.end())
      found.insert(found.end(), row.extensions.begin(), row.extensions.end());
  return found;
}

std::string FileFormats::readers_in_words(const std::vector<Content>& wanted, std::string_view conjunction) const {
  return listed(names(rows_, &FileFormat::reads, wanted, As::words), conjunction);
}

std::string FileFormats::writers_in_words(const std::vector<Content>& wanted, std::string_view conjunction) const {
  return listed(names(rows_, &FileFormat::writes, wanted, As::words), conjunction);
}

std::vector<MeshField> left_out(const FileFormat& format, const Mesh& mesh) {
  std::vector<MeshField> fields = fields_of(mesh);
  std::erase_if(fields, [&](MeshField field) {
    if (field == MeshField::face_varying && format.texture_columns > 0 &&
        (mesh.face_varying.size() > 1 || mesh.face_varying[0].values.cols() != format.texture_columns))
      return false;
    return std::ranges::find(format.holds, field) != format.holds.end();
  });
  return fields;
}

bool reads(const FileFormat& format, Content content) { return find_ability(format.reads, content); }

std::string listed(const std::vector<std::string>& words, std::string_view conjunction) {
  std::string list;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 < words.size() || conjunction.empty() ? ", " : " " + std::string(conjunction) + " ";
    list += words[i];
  }
  return list;
}

const FileFormats& io_formats() {
  static const FileFormats formats(rows());
  return formats;
}

}  // namespace sublimit
