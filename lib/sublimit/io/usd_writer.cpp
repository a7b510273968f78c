// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/usd.h"
#include "sublimit/io/detail/usd_text.h"
#include "sublimit/io/detail/usdz.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

/// A mesh of a file: a whole one, or the faces of an object.
struct UsdPart {
  std::string name;
  Mesh mesh;
};

/// Rows of a list that some of a mesh use, numbered anew in the order of the list.
struct Kept {
  explicit Kept(std::size_t count) : number(count, -1) {}
  void finish() {
    for (std::size_t i = 0; i < number.size(); ++i)
      if (number[i] >= 0) {
        number[i] = static_cast<Index>(rows.size());
        rows.push_back(static_cast<Index>(i));
      }
  }
  std::vector<Index> number;  ///< of each row, -1 for one that is not used
  std::vector<Index> rows;
};

Points taken_rows(const Points& from, const std::vector<Index>& rows) {
  Points out(std::ssize(rows), from.cols());
  for (Eigen::Index i = 0; i < out.rows(); ++i) out.row(i) = from.row(rows[std::size_t(i)]);
  return out;
}

template <class T>
std::vector<T> taken_values(const std::vector<T>& from, const std::vector<Index>& rows) {
  std::vector<T> out;
  if (from.empty()) return out;
  out.reserve(rows.size());
  for (const Index i : rows) out.push_back(from[std::size_t(i)]);
  return out;
}

/// The faces of an object and all that is theirs.
Mesh part_of(const Mesh& mesh, const std::vector<Index>& faces, const std::vector<std::int64_t>& first) {
  Mesh part;
  Kept vertices(std::size_t(mesh.num_vertices()));
  std::vector<Index> corners;  // of the whole mesh
  for (const Index f : faces)
    for (std::int64_t c = first[std::size_t(f)]; c < first[std::size_t(f) + 1]; ++c) {
      corners.push_back(static_cast<Index>(c));
      vertices.number[std::size_t(mesh.face_vertices[std::size_t(c)])] = 0;
    }
  vertices.finish();
  std::vector<Index> face_number(std::size_t(mesh.num_faces()), -1);
  for (std::size_t i = 0; i < faces.size(); ++i) face_number[std::size_t(faces[i])] = static_cast<Index>(i);
  const auto vertex = [&](Index v) { return vertices.number[std::size_t(v)]; };

  part.positions = taken_rows(mesh.positions, vertices.rows);
  part.face_sizes = taken_values(mesh.face_sizes, faces);
  part.face_vertices = taken_values(mesh.face_vertices, corners);
  for (Index& v : part.face_vertices) v = vertex(v);
  for (const Mesh::Crease& c : mesh.creases)
    if (vertex(c.tail) >= 0 && vertex(c.head) >= 0)
      part.creases.push_back({vertex(c.tail), vertex(c.head), c.sharpness});
  for (const Mesh::Corner& c : mesh.corners)
    if (vertex(c.vertex) >= 0) part.corners.push_back({vertex(c.vertex), c.sharpness});
  for (const Mesh::KnotInterval& k : mesh.knot_intervals)
    if (vertex(k.tail) >= 0 && vertex(k.head) >= 0)
      part.knot_intervals.push_back({vertex(k.tail), vertex(k.head), k.length});
  for (const Index hole : mesh.holes)
    if (face_number[std::size_t(hole)] >= 0) part.holes.push_back(face_number[std::size_t(hole)]);
  part.scheme = mesh.scheme;
  part.boundary = mesh.boundary, part.creasing = mesh.creasing, part.triangles = mesh.triangles;
  part.face_varying_interpolation = mesh.face_varying_interpolation;
  for (const Mesh::FaceVarying& channel : mesh.face_varying) {
    Mesh::FaceVarying taken{channel.name, {}, taken_values(channel.indices, corners)};
    Kept values(std::size_t(channel.values.rows()));
    for (const Index i : taken.indices) values.number[std::size_t(i)] = 0;
    values.finish();
    taken.values = taken_rows(channel.values, values.rows);
    for (Index& i : taken.indices) i = values.number[std::size_t(i)];
    part.face_varying.push_back(std::move(taken));
  }
  for (const auto names : {&Mesh::groups, &Mesh::materials, &Mesh::smoothing_groups}) {
    (part.*names).names = (mesh.*names).names;
    (part.*names).of_face = taken_values((mesh.*names).of_face, faces);
  }
  if (mesh.normals.rows() > 0 && mesh.face_normals.empty()) part.normals = taken_rows(mesh.normals, vertices.rows);
  if (!mesh.face_normals.empty()) {
    part.normals = mesh.normals;
    part.face_normals = taken_values(mesh.face_normals, corners);
  }
  if (mesh.texture.rows() > 0) part.texture = taken_rows(mesh.texture, vertices.rows);
  part.face_ids = taken_values(mesh.face_ids, faces);
  for (const Mesh::Values& values : mesh.vertex_values)
    part.vertex_values.push_back({values.name, taken_values(values.values, vertices.rows), values.type});
  for (const Mesh::Values& values : mesh.face_values)
    part.face_values.push_back({values.name, taken_values(values.values, faces), values.type});
  part.attributes = mesh.attributes;
  return part;
}

/// The objects of a mesh if none shares a vertex with another one or with faces of none; else the whole mesh.
std::vector<UsdPart> parts_of(const Mesh& mesh) {
  std::vector<UsdPart> parts;
  const std::vector<Index>& object = mesh.objects.of_face;
  if (object.empty()) return parts;
  std::vector<std::int64_t> first{0};
  for (const Index size : mesh.face_sizes) first.push_back(first.back() + size);
  constexpr Index nobody = -2;
  std::vector<Index> owner(std::size_t(mesh.num_vertices()), nobody);
  for (std::size_t f = 0; f < object.size(); ++f)
    for (std::int64_t c = first[f]; c < first[f + 1]; ++c) {
      Index& of = owner[std::size_t(mesh.face_vertices[std::size_t(c)])];
      if (of != nobody && of != object[f]) return parts;
      of = object[f];
    }
  if (std::ranges::find(owner, nobody) != owner.end()) return parts;  // vertices of no face would be lost
  std::vector<std::vector<Index>> faces(mesh.objects.names.size() + 1);
  for (std::size_t f = 0; f < object.size(); ++f) faces[std::size_t(object[f] + 1)].push_back(static_cast<Index>(f));
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (!faces[i].empty())
      parts.push_back({i == 0 ? unnamed_usd_mesh : mesh.objects.names[i - 1], part_of(mesh, faces[i], first)});
  return parts;
}

/// Properties of a prim.
class UsdArrays {
 public:
  UsdArrays(RowWriter& out, std::string indent) : out_(out), indent_(std::move(indent)) {}

  /// Writes `declaration = [...]`, with what metadata say.
  /// @param append  append(text, i) appends value i
  template <class Append>
  void write(const std::string& declaration, std::int64_t count, const Append& append,
             const std::string& metadata = {}) {
    out_.write(indent_ + declaration + " = ");
    write_usd_list(out_, indent_, count, append);
    out_.write(usd_metadata(metadata, indent_) + "\n");
  }

  void write_rows(const std::string& declaration, const Points& rows, const std::string& metadata = {}) {
    write(
        declaration, rows.rows(), [&](std::string& text, std::int64_t i) { append_usd_row<double>(text, rows.row(i)); },
        metadata);
  }

  void write_indices(const std::string& declaration, const std::vector<Index>& numbers) {
    write(declaration, std::ssize(numbers),
          [&](std::string& text, std::int64_t i) { append_number(text, numbers[std::size_t(i)]); });
  }

  void write_token(const std::string& declaration, std::string_view token) {
    out_.write(indent_ + declaration + " = \"" + std::string(token) + "\"\n");
  }

 private:
  RowWriter& out_;
  std::string indent_;
};

std::string scalar_name(ValueType type) {
  switch (type) {
    case ValueType::float32:
      return "float";
    case ValueType::float64:
      return "double";
    case ValueType::uint8:
      return "uchar";
    case ValueType::uint16:
    case ValueType::uint32:
      return "uint";
    default:
      return "int";
  }
}

void append_value(std::string& text, const Mesh::Values& values, std::int64_t i, bool as_colour) {
  const double value = as_colour ? colour_in_unit(values, std::size_t(i)) : values.values[std::size_t(i)];
  if (values.type == ValueType::float64)
    append_number(text, value);
  else if (values.type == ValueType::float32 || as_colour)
    append_number(text, static_cast<float>(value));
  else
    append_number(text, static_cast<std::int64_t>(std::round(value)));
}

/// Values as primvars: colours by their names in USD, and NAME_0, NAME_1, ... as one of several numbers.
void write_values(const std::vector<Mesh::Values>& values, const std::string& interpolation, bool with_colours,
                  UsdArrays& arrays, UsdNames& names) {
  const std::string metadata = "interpolation = \"" + interpolation + "\"";
  const auto write = [&](const std::string& type, const std::string& name,
                         const std::vector<const Mesh::Values*>& parts, bool as_colour) {
    arrays.write(
        type + "[] primvars:" + names.unique(name), std::ssize(parts[0]->values),
        [&](std::string& text, std::int64_t i) {
          if (parts.size() > 1) text += '(';
          for (std::size_t k = 0; k < parts.size(); ++k) {
            if (k > 0) text += ", ";
            append_value(text, *parts[k], i, as_colour);
          }
          if (parts.size() > 1) text += ')';
        },
        metadata);
  };
  std::vector<bool> done(values.size(), false);
  if (const auto colours = with_colours ? find_colours(values) : std::nullopt) {
    std::vector<const Mesh::Values*> rgb;
    for (std::size_t k = 0; k < 3; ++k) {
      rgb.push_back(&values[std::size_t((*colours)[k])]);
      done[std::size_t((*colours)[k])] = true;
    }
    write("color3f", "displayColor", rgb, true);
    if (const Index alpha = (*colours)[3]; alpha >= 0) {
      write("float", "displayOpacity", {&values[std::size_t(alpha)]}, true);
      done[std::size_t(alpha)] = true;
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (done[i]) continue;
    std::vector<const Mesh::Values*> parts{&values[i]};
    const std::string& name = values[i].name;
    const bool may_be_many = name.ends_with("_0") && name.size() > 2 &&
                             (values[i].type == ValueType::float32 || values[i].type == ValueType::float64 ||
                              values[i].type == ValueType::int32);
    const std::string base = name.substr(0, name.size() - std::min<std::size_t>(2, name.size()));
    while (may_be_many && parts.size() < 4 && i + parts.size() < values.size() && !done[i + parts.size()] &&
           values[i + parts.size()].name == base + "_" + format_number(parts.size()) &&
           values[i + parts.size()].type == values[i].type)
      parts.push_back(&values[i + parts.size()]);
    const std::string type = scalar_name(values[i].type);
    if (parts.size() == 1)
      write(type, name, parts, false);
    else
      write(type + format_number(parts.size()), base, parts, false);
    i += parts.size() - 1;
  }
}

std::string_view scheme_token(const Mesh& mesh) {
  if (mesh.scheme == "catmull-clark") return "catmullClark";
  if (mesh.scheme == "loop" || mesh.scheme == "bilinear") return mesh.scheme;
  // A mesh with tags is there to be subdivided.
  const bool tags = !mesh.creases.empty() || !mesh.corners.empty() || !mesh.holes.empty() || mesh.boundary ||
                    mesh.triangles || mesh.face_varying_interpolation;
  return mesh.scheme.empty() && tags ? "catmullClark" : "none";
}

void write_rules(const Mesh& mesh, UsdArrays& arrays) {
  arrays.write_token("uniform token subdivisionScheme", scheme_token(mesh));
  if (mesh.boundary) arrays.write_token("token interpolateBoundary", usd_boundary_words[std::size_t(*mesh.boundary)]);
  if (mesh.triangles)
    arrays.write_token("token triangleSubdivisionRule", usd_triangles_words[std::size_t(*mesh.triangles)]);
  // A channel without a rule is linear in `Mesh`, but not in USD.
  if (mesh.face_varying_interpolation || !mesh.face_varying.empty())
    arrays.write_token(
        "token faceVaryingLinearInterpolation",
        usd_face_varying_words[std::size_t(mesh.face_varying_interpolation.value_or(FaceVaryingInterpolation::all))]);
  if (mesh.creasing)
    arrays.write_token("custom uniform token sublimit:creaseMethod", usd_creasing_words[std::size_t(*mesh.creasing)]);
}

void append_usd_sharpness(std::string& text, float sharpness) {
  append_number(text, std::isinf(sharpness) ? 10.0F : sharpness);
}

void write_tags(const Mesh& mesh, UsdArrays& arrays) {
  if (!mesh.creases.empty()) {
    arrays.write("int[] creaseIndices", std::ssize(mesh.creases), [&](std::string& text, std::int64_t i) {
      append_number(text, mesh.creases[std::size_t(i)].tail);
      text += ", ";
      append_number(text, mesh.creases[std::size_t(i)].head);
    });
    arrays.write("int[] creaseLengths", std::ssize(mesh.creases), [](std::string& text, std::int64_t) { text += '2'; });
    arrays.write("float[] creaseSharpnesses", std::ssize(mesh.creases), [&](std::string& text, std::int64_t i) {
      append_usd_sharpness(text, mesh.creases[std::size_t(i)].sharpness);
    });
  }
  if (!mesh.corners.empty()) {
    arrays.write("int[] cornerIndices", std::ssize(mesh.corners),
                 [&](std::string& text, std::int64_t i) { append_number(text, mesh.corners[std::size_t(i)].vertex); });
    arrays.write("float[] cornerSharpnesses", std::ssize(mesh.corners), [&](std::string& text, std::int64_t i) {
      append_usd_sharpness(text, mesh.corners[std::size_t(i)].sharpness);
    });
  }
  if (!mesh.holes.empty()) arrays.write_indices("int[] holeIndices", mesh.holes);
  if (mesh.knot_intervals.empty()) return;
  arrays.write("custom int[] sublimit:knotIntervalEdges", std::ssize(mesh.knot_intervals),
               [&](std::string& text, std::int64_t i) {
                 append_number(text, mesh.knot_intervals[std::size_t(i)].tail);
                 text += ", ";
                 append_number(text, mesh.knot_intervals[std::size_t(i)].head);
               });
  arrays.write(
      "custom double[] sublimit:knotIntervals", std::ssize(mesh.knot_intervals),
      [&](std::string& text, std::int64_t i) { append_number(text, mesh.knot_intervals[std::size_t(i)].length); });
}

void write_normals(const Mesh& mesh, UsdArrays& arrays) {
  if (mesh.normals.rows() == 0) return;
  if (mesh.face_normals.empty())
    return arrays.write_rows("normal3f[] normals", mesh.normals, "interpolation = \"vertex\"");
  // Corners without a normal have a zero.
  Points normals = mesh.normals;
  std::vector<Index> indices = mesh.face_normals;
  if (std::ranges::find(indices, -1) != indices.end()) {
    normals.conservativeResize(normals.rows() + 1, Eigen::NoChange);
    normals.bottomRows(1).setZero();
    std::ranges::replace(indices, Index{-1}, static_cast<Index>(normals.rows() - 1));
  }
  arrays.write_rows("normal3f[] primvars:normals", normals, "interpolation = \"faceVarying\"");
  arrays.write_indices("int[] primvars:normals:indices", indices);
}

/// Numbers of a face-varying value as a type.
std::string channel_type(Eigen::Index width) {
  if (width == 1) return "float";
  return width == 2 ? "texCoord2f" : "float" + format_number(width);
}

void write_channels(const Mesh& mesh, UsdArrays& arrays, UsdNames& names) {
  for (const Mesh::FaceVarying& channel : mesh.face_varying) {
    const std::string name = names.unique(channel.name.empty() ? "st" : channel.name);
    arrays.write_rows(channel_type(channel.values.cols()) + "[] primvars:" + name, channel.values,
                      "interpolation = \"faceVarying\"");
    arrays.write_indices("int[] primvars:" + name + ":indices", channel.indices);
  }
  if (mesh.texture.rows() > 0)
    arrays.write_rows("texCoord2f[] primvars:" + names.unique("st"), mesh.texture, "interpolation = \"vertex\"");
}

/// Writes one layer.
class UsdWriter {
 public:
  UsdWriter(const Mesh& mesh, RowWriter& out) : mesh_(mesh), out_(out), parts_(parts_of(mesh)) {}

  void write() {
    // The prims of the root, and those below them, as a tree of names.
    Node root;
    root.names.unique("Looks");
    for (std::size_t i = 0; i < std::max<std::size_t>(parts_.size(), 1); ++i)
      place(root, parts_.empty() ? unnamed_usd_mesh : parts_[i].name, static_cast<int>(i));
    for (const std::string& name : mesh_.materials.names) materials_.push_back(material_names_.unique(name));
    out_.write("#usda 1.0\n(\n    defaultPrim = \"" + root.children[0].identifier + "\"\n");
    if (!mesh_.comments.empty()) {
      std::string all;
      for (const std::string& comment : mesh_.comments) all += (all.empty() ? "" : "\n") + comment;
      out_.write("    doc = " + usd_text(all) + "\n");
    }
    out_.write(")\n");
    for (const Node& child : root.children) write(child, "");
    if (materials_.empty()) return;
    out_.write("\ndef Scope \"Looks\"\n{\n");
    for (std::size_t i = 0; i < materials_.size(); ++i)
      out_.write("    def Material \"" + materials_[i] + "\"" +
                 shown(materials_[i], mesh_.materials.names[i], {}, "    ") + "\n    {\n    }\n");
    out_.write("}\n");
  }

 private:
  struct Node {
    std::string identifier = {}, name = {};
    int part = -1;
    std::vector<Node> children = {};
    UsdNames names = {};
  };

  /// Puts a part where its name says, `World/Cage` below `World`.
  static void place(Node& root, const std::string& name, int part) {
    Node* at = &root;
    std::size_t begin = 0;
    for (std::size_t end; (end = name.find('/', begin)) != std::string::npos; begin = end + 1) {
      const std::string word = name.substr(begin, end - begin);
      if (word.empty()) continue;
      const auto found =
          std::ranges::find_if(at->children, [&](const Node& node) { return node.part < 0 && node.name == word; });
      at = found == at->children.end() ? &add(*at, word) : &*found;
    }
    add(*at, name.substr(begin)).part = part;
  }
  static Node& add(Node& to, const std::string& name) {
    to.children.push_back({.identifier = to.names.unique(name), .name = name});
    return to.children.back();
  }

  /// Metadata of a prim: the name that is shown, where it is no identifier, and further ones.
  static std::string shown(const std::string& identifier, const std::string& name, const std::string& more,
                           const std::string& indent) {
    std::string all = more;
    if (identifier != name) all += (all.empty() ? "" : "\n") + ("displayName = " + usd_text(name));
    return usd_metadata(all, indent);
  }

  void write(const Node& node, const std::string& indent, bool is_first = false) {
    const Mesh* const mesh = node.part < 0 ? nullptr : parts_.empty() ? &mesh_ : &parts_[std::size_t(node.part)].mesh;
    const bool bound = mesh && !mesh->materials.of_face.empty();
    out_.write((is_first ? "" : "\n") + indent + "def " + (mesh ? "Mesh" : "Xform") + " \"" + node.identifier + "\"" +
               shown(node.identifier, node.name, bound ? "prepend apiSchemas = [\"MaterialBindingAPI\"]" : "", indent) +
               "\n" + indent + "{\n");
    if (mesh) write_mesh(*mesh, indent + "    ");
    for (const Node& child : node.children) write(child, indent + "    ", !mesh && &child == &node.children.front());
    out_.write(indent + "}\n");
  }

  void write_mesh(const Mesh& mesh, const std::string& indent) {
    UsdArrays arrays(out_, indent);
    write_rules(mesh, arrays);
    arrays.write_token("uniform token orientation", "rightHanded");
    if (mesh.num_vertices() > 0) {
      Points extent(2, 3);
      extent.row(0) = mesh.positions.colwise().minCoeff();
      extent.row(1) = mesh.positions.colwise().maxCoeff();
      arrays.write_rows("float3[] extent", extent);
    }
    arrays.write_rows("point3f[] points", mesh.positions);
    arrays.write_indices("int[] faceVertexCounts", mesh.face_sizes);
    arrays.write_indices("int[] faceVertexIndices", mesh.face_vertices);
    write_normals(mesh, arrays);
    write_tags(mesh, arrays);
    UsdNames names;
    names.unique("normals");
    const bool vertex_colours = find_colours(mesh.vertex_values).has_value();
    write_channels(mesh, arrays, names);
    write_values(mesh.vertex_values, mesh.attributes == Attributes::linear ? "varying" : "vertex", true, arrays, names);
    write_values(mesh.face_values, "uniform", !vertex_colours, arrays, names);
    if (!mesh.face_ids.empty())
      arrays.write(
          "int[] primvars:" + names.unique("face_id"), std::ssize(mesh.face_ids),
          [&](std::string& text, std::int64_t i) { append_number(text, mesh.face_ids[std::size_t(i)]); },
          "interpolation = \"uniform\"");
    UsdNames subsets;
    write_subsets(mesh.materials, "materialBind", indent, subsets);
    write_subsets(mesh.groups, "group", indent, subsets);
    write_subsets(mesh.smoothing_groups, "smoothingGroup", indent, subsets);
    if (parts_.empty()) write_subsets(mesh.objects, "object", indent, subsets);
  }

  void write_subsets(const Mesh::FaceNames& names, const std::string& family, const std::string& indent,
                     UsdNames& used) {
    if (names.of_face.empty()) return;
    std::vector<std::vector<Index>> faces(names.names.size());
    for (std::size_t f = 0; f < names.of_face.size(); ++f)
      if (names.of_face[f] >= 0) faces[std::size_t(names.of_face[f])].push_back(static_cast<Index>(f));
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces[i].empty()) continue;
      const bool is_material = family == "materialBind";
      const std::string identifier = used.unique(names.names[i]);
      out_.write("\n" + indent + "def GeomSubset \"" + identifier + "\"" +
                 shown(identifier, names.names[i], is_material ? "prepend apiSchemas = [\"MaterialBindingAPI\"]" : "",
                       indent) +
                 "\n" + indent + "{\n");
      UsdArrays arrays(out_, indent + "    ");
      arrays.write_token("uniform token elementType", "face");
      arrays.write_token("uniform token familyName", family);
      arrays.write_indices("int[] indices", faces[i]);
      if (is_material) out_.write(indent + "    rel material:binding = </Looks/" + materials_[i] + ">\n");
      out_.write(indent + "}\n");
    }
  }

  const Mesh& mesh_;
  RowWriter& out_;
  std::vector<UsdPart> parts_;
  std::vector<std::string> materials_;  // identifiers
  UsdNames material_names_;
};

void check_usd(const Mesh& mesh, const std::string& name) {
  check_output(mesh, name);
  for (const Mesh::FaceVarying& channel : mesh.face_varying)
    if (channel.values.cols() < 1 || channel.values.cols() > 4)
      throw InvalidParameter(name + ": a face-varying channel has " + format_number(channel.values.cols()) +
                             " columns; USD has room for 1 to 4");
}

}  // namespace

std::string format_usda(const Mesh& mesh) {
  check_usd(mesh, "USD");
  std::string text;
  RowWriter out(text);
  UsdWriter(mesh, out).write();
  return text;
}

void write_usdz(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress) {
  check_usd(mesh, path.string());
  const std::string layer = format_usda(mesh);
  const std::string bytes = format_usdz({{"scene.usda", layer}}, path.string());
  AtomicFile file(path, progress);
  file.write(bytes);
  file.commit();
}

void write_usda(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress) {
  check_usd(mesh, path.string());
  AtomicFile file(path, progress);
  RowWriter out(file);
  UsdWriter(mesh, out).write();
  file.commit();
}

}  // namespace sublimit
