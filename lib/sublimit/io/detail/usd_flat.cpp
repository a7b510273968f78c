// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usd_flat.h"

#include <algorithm>
#include <cmath>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/usd_text.h"

namespace sublimit {
namespace {

using Interpolation = UsdPrimvar::Interpolation;

/// A property that a mesh gets.
struct NewProperty {
  std::string name, part;
  std::string type;  ///< with what stands before it, `uniform token`
  std::string value;
  std::string metadata = {};       ///< of a statement that is new
  bool replaces_metadata = false;  ///< and of one that is there
};

/// Changes of one prim.
struct PrimEdit {
  std::vector<NewProperty> properties;
  std::vector<std::string> removed;  ///< properties, with their samples
};

std::string list_of(std::int64_t count, const auto& append) {
  std::string text;
  RowWriter out(text);
  write_usd_list(out, "    ", count, append);
  return text;
}

std::string list_of_indices(const std::vector<Index>& numbers) {
  return list_of(std::ssize(numbers),
                 [&](std::string& text, std::int64_t i) { append_number(text, numbers[std::size_t(i)]); });
}

/// Rows as values, with the digits of a type.
std::string list_of_rows(const Points& rows, ValueType type) {
  return list_of(rows.rows(), [&](std::string& text, std::int64_t i) {
    if (type == ValueType::float64)
      append_usd_row<double>(text, rows.row(i));
    else if (type == ValueType::float32)
      append_usd_row<float>(text, rows.row(i));
    else
      append_usd_row<std::int64_t>(text, rows.row(i).array().round().matrix());
  });
}

/// The statement of a property that is there, of the strongest opinion that has it; null if there is none.
const UsdProperty* declared(const UsdMesh& mesh, std::string_view name) {
  for (const UsdPrim::Opinion& opinion : mesh.opinions)
    for (const char* const part : {"timeSamples", ""})
      if (const UsdProperty* const property = opinion.spec->property(name, part)) return property;
  return nullptr;
}

std::string in_braces(const std::vector<double>& times, const auto& value_of) {
  std::string text = "{";
  for (std::size_t i = 0; i < times.size(); ++i)
    text += "\n        " + format_number(times[i]) + ": " + value_of(i) + ",";
  return text + "\n    }";
}

/// Normals of the vertices, if all corners of each have the same one.
std::optional<Points> normals_of_vertices(const Mesh& mesh, const Points& of_corners) {
  Points normals = Points::Zero(mesh.num_vertices(), 3);
  std::vector<bool> known(std::size_t(mesh.num_vertices()), false);
  for (std::size_t c = 0; c < mesh.face_vertices.size(); ++c) {
    const Index v = mesh.face_vertices[c];
    if (known[std::size_t(v)] && normals.row(v) != of_corners.row(Eigen::Index(c))) return std::nullopt;
    normals.row(v) = of_corners.row(Eigen::Index(c));
    known[std::size_t(v)] = true;
  }
  return normals;
}

void add_normals(const UsdFlat& flat, PrimEdit& edit) {
  const Mesh& mesh = flat.mesh;
  std::vector<Points> frames = flat.normals;
  if (frames.empty()) {
    Points corners(std::ssize(mesh.face_vertices), 3);
    for (Eigen::Index c = 0; c < corners.rows(); ++c)
      corners.row(c) = mesh.normals.row(mesh.face_normals[std::size_t(c)]);
    frames.push_back(std::move(corners));
  }
  std::vector<Points> of_vertices;
  for (const Points& frame : frames) {
    std::optional<Points> vertices = normals_of_vertices(mesh, frame);
    if (!vertices) break;
    of_vertices.push_back(*std::move(vertices));
  }
  const bool per_vertex = of_vertices.size() == frames.size();
  if (per_vertex) frames = std::move(of_vertices);
  NewProperty normals{"normals",
                      "",
                      "normal3f[]",
                      list_of_rows(frames[0], ValueType::float32),
                      std::string("interpolation = \"") + (per_vertex ? "vertex" : "faceVarying") + "\"",
                      true};
  edit.removed.push_back("normals");
  edit.properties.push_back(normals);
  if (flat.points.empty()) return;
  normals.part = "timeSamples";
  normals.metadata.clear();
  normals.value =
      in_braces(flat.from->times, [&](std::size_t i) { return list_of_rows(frames[i], ValueType::float32); });
  edit.properties.push_back(std::move(normals));
}

void add_points(const UsdFlat& flat, PrimEdit& edit, std::vector<std::string>& warnings) {
  const UsdProperty* const given = declared(*flat.from, "points");
  const auto type = usd_type(given->type);
  const ValueType digits = type && type->numbers == ValueType::float64 ? ValueType::float64 : ValueType::float32;
  edit.removed.push_back("points");
  edit.properties.push_back({"points", "", std::string(given->type), list_of_rows(flat.mesh.positions, digits)});
  if (!flat.points.empty())
    edit.properties.push_back(
        {"points", "timeSamples", std::string(given->type),
         in_braces(flat.from->times, [&](std::size_t i) { return list_of_rows(flat.points[i], digits); })});
  const auto has_default = [](const UsdPrim::Opinion& opinion) {
    const UsdProperty* const points = opinion.spec->property("points");
    return points && !points->value.empty();
  };
  if (!flat.points.empty() && std::ranges::any_of(flat.from->opinions, has_default))
    warnings.push_back(flat.from->place + "points without a time become those of the first time");
  if (!declared(*flat.from, "extent") || flat.mesh.num_vertices() == 0) return;
  Points extent(2, 3);
  extent.row(0) = flat.mesh.positions.colwise().minCoeff();
  extent.row(1) = flat.mesh.positions.colwise().maxCoeff();
  for (const Points& frame : flat.points) {
    extent.row(0) = extent.row(0).cwiseMin(frame.colwise().minCoeff());
    extent.row(1) = extent.row(1).cwiseMax(frame.colwise().maxCoeff());
  }
  edit.removed.push_back("extent");
  edit.properties.push_back({"extent", "", "float3[]", list_of_rows(extent, ValueType::float32)});
}

/// Values of a primvar at the vertices, from those of the mesh.
Points values_of_vertices(const UsdPrimvar& primvar, const Mesh& mesh) {
  Points rows = Points::Zero(mesh.num_vertices(), primvar.type.width);
  for (int c = 0; c < primvar.type.width; ++c) {
    const auto found = std::ranges::find(mesh.vertex_values, component_name(primvar, c), &Mesh::Values::name);
    if (found != mesh.vertex_values.end())
      for (Eigen::Index v = 0; v < rows.rows(); ++v) rows(v, c) = found->values[std::size_t(v)];
  }
  return rows;
}

Points rows_at(const Points& rows, const std::vector<Index>& numbers) {
  Points out(std::ssize(numbers), rows.cols());
  for (Eigen::Index i = 0; i < out.rows(); ++i) out.row(i) = rows.row(numbers[std::size_t(i)]);
  return out;
}

std::string usd_interpolation(Interpolation interpolation) {
  return "interpolation = \"" + std::string(usd_interpolation_words[std::size_t(interpolation)]) + "\"";
}

void add_primvars(const UsdFlat& flat, PrimEdit& edit, std::vector<std::string>& warnings) {
  for (const UsdPrimvar& primvar : flat.from->primvars) {
    if (primvar.interpolation == Interpolation::constant) continue;
    const std::string name = "primvars:" + primvar.name, indices = name + ":indices";
    const UsdProperty* const given = declared(*flat.from, name);
    const bool has_indices = declared(*flat.from, indices);
    const std::string metadata = usd_interpolation(primvar.interpolation);
    const auto add = [&](const Points& rows) {
      edit.removed.push_back(name);
      edit.properties.push_back(
          {name, "", std::string(given->type), list_of_rows(rows, primvar.type.numbers), metadata});
    };
    if (given->part == "timeSamples")
      warnings.push_back(flat.from->place + name + " changes in time; its values are those of the first time");
    if (primvar.interpolation == Interpolation::face_varying) {
      const auto channel = std::ranges::find(flat.mesh.face_varying, primvar.name, &Mesh::FaceVarying::name);
      if (channel == flat.mesh.face_varying.end()) {
        warnings.push_back(flat.from->place + name + " is left out: it has no limit");
        edit.removed.insert(edit.removed.end(), {name, indices});
      } else if (has_indices) {
        add(channel->values);
        edit.removed.push_back(indices);
        edit.properties.push_back({indices, "", "int[]", list_of_indices(channel->indices)});
      } else {
        add(rows_at(channel->values, channel->indices));
      }
      continue;
    }
    if (has_indices) edit.removed.push_back(indices);
    add(primvar.interpolation == Interpolation::uniform ? rows_at(primvar.expanded(), flat.faces)
                                                        : values_of_vertices(primvar, flat.mesh));
  }
  for (const std::string& name : flat.from->left_out) {
    warnings.push_back(flat.from->place + "primvars:" + name + " is left out: its values are not those of triangles");
    edit.removed.insert(edit.removed.end(), {"primvars:" + name, "primvars:" + name + ":indices"});
  }
}

PrimEdit edit_of(const UsdFlat& flat, std::vector<std::string>& warnings) {
  PrimEdit edit;
  add_points(flat, edit, warnings);
  edit.properties.push_back({"faceVertexCounts", "", "int[]", list_of_indices(flat.mesh.face_sizes)});
  edit.properties.push_back({"faceVertexIndices", "", "int[]", list_of_indices(flat.mesh.face_vertices)});
  add_normals(flat, edit);
  edit.properties.push_back({"subdivisionScheme", "", "uniform token", "\"none\""});
  if (flat.from->left_handed) edit.properties.push_back({"orientation", "", "uniform token", "\"rightHanded\""});
  for (const char* const name :
       {"faceVertexCounts", "faceVertexIndices", "primvars:normals", "primvars:normals:indices", "creaseIndices",
        "creaseLengths", "creaseSharpnesses", "cornerIndices", "cornerSharpnesses", "holeIndices",
        "interpolateBoundary", "faceVaryingLinearInterpolation", "triangleSubdivisionRule", "sublimit:creaseMethod",
        "sublimit:knotIntervals", "sublimit:knotIntervalEdges"})
    edit.removed.emplace_back(name);
  for (const char* const name : {"velocities", "accelerations"})
    if (declared(*flat.from, name)) {
      warnings.push_back(flat.from->place + name + " are left out: they are those of the control points");
      edit.removed.emplace_back(name);
    }
  add_primvars(flat, edit, warnings);
  return edit;
}

/// The triangles of each face.
class TrianglesOfFaces {
 public:
  TrianglesOfFaces(const std::vector<Index>& faces, Index num_faces) : first_(std::size_t(num_faces) + 1, 0) {
    for (const Index f : faces) ++first_[std::size_t(f) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    triangles_.resize(faces.size());
    std::vector<std::size_t> next = first_;
    for (std::size_t t = 0; t < faces.size(); ++t) triangles_[next[std::size_t(faces[t])]++] = static_cast<Index>(t);
  }
  std::vector<Index> of(const std::vector<Index>& faces) const {
    std::vector<Index> all;
    for (const Index f : faces)
      all.insert(all.end(), triangles_.begin() + std::ptrdiff_t(first_[std::size_t(f)]),
                 triangles_.begin() + std::ptrdiff_t(first_[std::size_t(f) + 1]));
    std::ranges::sort(all);
    return all;
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<Index> triangles_;
};

class LayerEditor {
 public:
  explicit LayerEditor(const UsdLayer& layer) : layer_(layer), text_(layer.text) {}

  /// Edits a prim where the layer speaks of it, or overrides it.
  void apply(const std::string& path, const UsdSpec* spec, const PrimEdit& edit, const UsdMesh& mesh) {
    if (!spec) spec = find_usd_spec(layer_.root, path);
    std::string more;  // statements that are new
    const std::string indent = spec ? indent_of(spec->text) + "    " : "    ";
    std::unordered_set<const UsdProperty*> replaced;
    const std::unordered_set<std::string_view> removed(edit.removed.begin(), edit.removed.end());
    std::unordered_set<std::string_view> given;
    for (const NewProperty& one : edit.properties) given.insert(one.name);
    for (NewProperty one : edit.properties) {
      one.value = indented(std::move(one.value), indent);
      const UsdProperty* const there = spec ? spec->property(one.name, one.part) : nullptr;
      const bool has_value = there && !there->value.empty();
      if (has_value && !one.replaces_metadata) {
        replace(there->value, one.value);
        replaced.insert(there);
        continue;
      }
      std::string statement = one.type + " " + one.name + (one.part.empty() ? "" : "." + one.part) + " = " + one.value;
      statement += usd_metadata(one.metadata, indent);
      if (there) {
        replace(there->text, statement);
        replaced.insert(there);
      } else {
        more += indent + statement + "\n";
      }
    }
    if (spec)
      for (const UsdProperty& property : spec->properties)
        if (removed.contains(property.name) && !replaced.contains(&property)) remove(property.text);
    // What weaker layers say is hidden.
    for (const std::string& name : edit.removed) {
      if (given.contains(name)) continue;
      for (const UsdPrim::Opinion& opinion : mesh.opinions)
        if (const UsdProperty* const weaker = opinion.spec->property(name);
            weaker && opinion.spec != spec && !weaker->value.empty()) {
          more += indent + (weaker->uniform ? "uniform " : "") + std::string(weaker->type) + " " + name + " = None\n";
          break;
        }
    }
    if (more.empty()) return;
    if (spec)
      insert(*spec, more);
    else
      override(path, more);
  }

  /// Returns the text with all that was asked for.
  std::string finish() {
    for (auto& [spec, node] : overrides_) {
      std::string text;
      write(node, indent_of(spec->text) + (spec == &layer_.root ? "" : "    "), text);
      insert_last(*spec, text);
    }
    // At one place text is put in before other text is taken out.
    std::ranges::stable_sort(
        edits_, [](const Edit& a, const Edit& b) { return a.begin != b.begin ? a.begin < b.begin : a.end < b.end; });
    std::string out;
    std::size_t at = 0;
    for (const Edit& edit : edits_) {
      out += text_.substr(at, edit.begin - at);
      out += edit.text;
      at = edit.end;
    }
    return out += text_.substr(at);
  }

 private:
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  /// Lines behind the first one, which are made for an indent of four, with that of a statement.
  static std::string indented(std::string lines, const std::string& indent) {
    const std::string more = indent.size() > 4 ? indent.substr(4) : "";
    for (std::size_t at = 0; !more.empty() && (at = lines.find('\n', at)) != std::string::npos;)
      lines.insert(at += 1, more);
    return lines;
  }

  struct Override {
    std::string statements = {};
    std::map<std::string, Override> children = {};
  };

  std::size_t offset(std::string_view part) const { return std::size_t(part.data() - text_.data()); }
  std::string indent_of(std::string_view part) const {
    const std::size_t at = offset(part), line = at == 0 ? 0 : text_.rfind('\n', at - 1) + 1;
    std::size_t end = line;
    while (end < at && (text_[end] == ' ' || text_[end] == '\t')) ++end;
    return std::string(text_.substr(line, end - line));
  }
  void replace(std::string_view part, std::string text) {
    edits_.push_back({offset(part), offset(part) + part.size(), std::move(text)});
  }
  /// Takes out a statement with its line, if nothing else is in that.
  void remove(std::string_view part) {
    std::size_t begin = offset(part), end = begin + part.size();
    while (end < text_.size() && (text_[end] == ' ' || text_[end] == '\t' || text_[end] == ';' || text_[end] == '\r'))
      ++end;
    std::size_t line = begin;
    while (line > 0 && (text_[line - 1] == ' ' || text_[line - 1] == '\t')) --line;
    const bool alone = (line == 0 || text_[line - 1] == '\n') && end < text_.size() && text_[end] == '\n';
    edits_.push_back({alone ? line : begin, alone ? end + 1 : end, ""});
  }
  /// Puts statements before all others of a prim.
  void insert(const UsdSpec& spec, const std::string& text) {
    const std::size_t begin = offset(spec.body), first = spec.body.find_first_not_of(" \t\r");
    const bool line_ends = first != std::string_view::npos && spec.body[first] == '\n';
    const std::size_t at = line_ends ? begin + first + 1 : begin;
    edits_.push_back({at, at, line_ends ? text : "\n" + text});
  }
  /// Puts prims behind all others.
  void insert_last(const UsdSpec& spec, const std::string& text) {
    const std::size_t end = offset(spec.body) + spec.body.size();
    std::size_t at = end;
    while (at > offset(spec.body) && (text_[at - 1] == ' ' || text_[at - 1] == '\t')) --at;
    const bool line_begins = at > 0 && text_[at - 1] == '\n';
    edits_.push_back({line_begins ? at : end, line_begins ? at : end, line_begins ? text : "\n" + text});
  }

  /// Overrides a prim that the layer does not speak of, below the last one on its way that it has.
  void override(const std::string& path, const std::string& statements) {
    std::string there = path;
    const UsdSpec* spec = nullptr;
    std::vector<std::string> names;
    while (!spec) {
      const std::size_t slash = there.rfind('/');
      names.push_back(there.substr(slash + 1));
      there.resize(slash);
      spec = there.empty() ? &layer_.root : find_usd_spec(layer_.root, there);
    }
    Override* node = &overrides_[spec];
    for (auto name = names.rbegin(); name != names.rend(); ++name) node = &node->children[*name];
    node->statements += statements;
  }
  static void write(const Override& node, const std::string& indent, std::string& out) {
    for (const auto& [name, child] : node.children) {
      out += indent + "over \"" + name + "\"\n" + indent + "{\n";
      std::string statements = child.statements;
      for (std::size_t at = 0; at < statements.size(); at = statements.find('\n', at) + 1) {
        statements.insert(at, indent);
      }
      out += statements;
      write(child, indent + "    ", out);
      out += indent + "}\n";
    }
  }

  const UsdLayer& layer_;
  std::string_view text_;
  std::vector<Edit> edits_;
  std::map<const UsdSpec*, Override> overrides_;
};

}  // namespace

std::string flattened_layer(const UsdStage& stage, const std::vector<UsdFlat>& flats,
                            std::vector<std::string>& warnings) {
  const UsdLayer& layer = stage.root_layer();
  LayerEditor editor(layer);
  for (const UsdFlat& flat : flats) {
    const UsdSpec* spec = nullptr;  // that the layer has of the prim, in a variant or not
    for (const UsdPrim::Opinion& opinion : flat.from->opinions)
      if (!spec && opinion.layer == &layer && opinion.from.empty() && opinion.to.empty()) spec = opinion.spec;
    for (const UsdPrim::Opinion& opinion : flat.from->opinions)
      if (opinion.layer == &layer && opinion.from.empty() && opinion.spec->property("faceVertexIndices"))
        spec = opinion.spec;
    editor.apply(flat.from->path, spec, edit_of(flat, warnings), *flat.from);
    const TrianglesOfFaces triangles(flat.faces, flat.from->mesh.num_faces());
    std::unordered_map<std::string_view, const UsdSpec*> children;
    if (spec)
      for (const UsdSpec& child : spec->children) children[child.name] = &child;
    for (const UsdSubset& subset : flat.from->subsets) {
      const auto found = children.find(std::string_view(subset.path).substr(subset.path.rfind('/') + 1));
      const UsdSpec* const of_subset = found == children.end() ? nullptr : found->second;
      const std::string indices = list_of_indices(triangles.of(subset.faces));
      editor.apply(subset.path, of_subset, {{{"indices", "", "int[]", indices}}, {}}, UsdMesh());
    }
  }
  return editor.finish();
}

std::string flattened_text(const UsdStage& stage, const std::string& layer, const std::string& name,
                           std::vector<std::string>& warnings) {
  const std::vector<UsdzFile>& files = stage.package();
  constexpr std::size_t most = 5;
  std::string others;
  for (std::size_t i = 1; i < std::min(files.size(), most + 1); ++i) others += (i > 1 ? ", " : "") + files[i].name;
  if (files.size() > most + 1) others += ", ...";
  if (!others.empty())
    warnings.push_back(name + ": the other files of the package are not with it: " + others + "; a .usdz has them");
  return layer;
}

std::string flattened_package(const UsdStage& stage, const std::string& layer, const std::string& name,
                              std::vector<std::string>& warnings) {
  std::vector<UsdzFile> files = stage.package();
  if (files.empty()) {
    if (layer.find('@') != std::string::npos)
      warnings.push_back(
          name + ": files that the scene refers to are not put into the package; a .usda beside them finds them");
    files.push_back({"scene.usda", {}});
  }
  files.front().bytes = layer;
  return format_usdz(files, name);
}

}  // namespace sublimit
