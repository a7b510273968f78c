// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/base64.h"
#include "sublimit/io/detail/gltf.h"
#include "sublimit/io/detail/gltf_accessor.h"
#include "sublimit/io/detail/gltf_layout.h"
#include "sublimit/io/detail/gltf_mesh.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::int64_t gltf_rows_per_block = 8190;  // a multiple of three
constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr double most_float = std::numeric_limits<float>::max();

/// Appends the low bytes of a number, least first.
void append_low_bytes(std::string& out, std::uint32_t bits, int bytes) {
  for (int k = 0; k < bytes; ++k) out += static_cast<char>(bits >> (8 * k) & 0xff);
}
void append_float(std::string& out, double value) {
  append_low_bytes(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
}
std::string word(std::uint64_t bits) {
  std::string out;
  append_low_bytes(out, static_cast<std::uint32_t>(bits), 4);
  return out;
}

/// Rows of the buffer: appends those of [begin, end).
struct Section {
  std::int64_t rows;
  std::function<void(std::string&, std::int64_t, std::int64_t)> append;
};

/// How a file keeps numbers that have a type: those of 32 bits are floats, as it has no others.
GltfType file_type(ValueType type) {
  switch (type) {
    case ValueType::int8:
      return GltfType::int8;
    case ValueType::uint8:
      return GltfType::uint8;
    case ValueType::int16:
      return GltfType::int16;
    case ValueType::uint16:
      return GltfType::uint16;
    default:
      return GltfType::float32;
  }
}

int size_of(GltfType type) {
  return type == GltfType::int8 || type == GltfType::uint8 ? 1 : type == GltfType::float32 ? 4 : 2;
}

/// Returns the whole number of a type that is nearest.
double nearest_in(GltfType type, double value) {
  const auto within = [&](double least, double most) { return std::clamp(std::nearbyint(value), least, most); };
  switch (type) {
    case GltfType::int8:
      return within(-128, 127);
    case GltfType::uint8:
      return within(0, 255);
    case GltfType::int16:
      return within(-32768, 32767);
    default:
      return within(0, 65535);
  }
}

/// Appends a number in a type, the nearest that it has.
void append_as(std::string& out, GltfType type, double value) {
  if (type == GltfType::float32) return append_float(out, value);
  const auto number = static_cast<std::int32_t>(nearest_in(type, value));
  append_low_bytes(out, static_cast<std::uint32_t>(number), size_of(type));
}

void check_gltf(const Mesh& mesh, const std::string& name) {
  check_output(mesh, name);
  if (mesh.positions.size() > 0 && mesh.positions.cwiseAbs().maxCoeff() > most_float)
    throw InvalidMesh(name + ": a coordinate is beyond the numbers of 32 bits that a glTF file has; write a .ply");
  for (const Mesh::FaceVarying& channel : mesh.face_varying)
    if (channel.values.size() > 0 && channel.values.cwiseAbs().maxCoeff() > most_float)
      throw InvalidMesh(name +
                        ": a texture coordinate is beyond the numbers of 32 bits that a glTF file has; write an .obj");
  for (const Mesh::Values& one : mesh.vertex_values) {
    const auto bad = std::ranges::find_if(one.values, [](double x) { return !(std::abs(x) <= most_float); });
    if (bad != one.values.end())
      throw InvalidMesh(name + ": value '" + one.name + "' of vertex " + format_number(bad - one.values.begin()) +
                        " is " + format_number(*bad) +
                        "; a glTF file has finite numbers of 32 bits; write a .ply, or leave the values out");
  }
}

/// The JSON of a file, and the rows of its buffer.
class GltfOutput {
 public:
  /// @param name  of the node of faces that have no object
  GltfOutput(const Mesh& mesh, const std::string& name) : mesh_(mesh), layout_(mesh) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "sublimit"}};
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", OrderedJson::array()}}};
    name_attributes();
    for (const GltfNode& node : layout_.nodes()) add_node(node, name);
    if (layout_.nodes().empty()) add_empty_node(name);
    if (json_.contains("accessors")) {
      json_["meshes"] = std::move(meshes_);
      if (!materials_.empty()) json_["materials"] = std::move(materials_);
      if (layout_.has_polygons()) json_["extensionsUsed"] = {"FB_ngon_encoding"};
      json_["buffers"] = {{{"byteLength", size_}}};
    }
  }

  /// Returns the JSON as text. It ends with the only buffer, if there is one: `{"byteLength":12}]}`.
  std::string text() const { return json_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace); }
  std::uint64_t size() const { return size_; }
  /// Writes the buffer.
  void write(RowWriter& out) const {
    for (const Section& section : sections_) out.rows(section.rows, gltf_rows_per_block, section.append);
  }

 private:
  const SplitVertices::Vertex& vertex(Index v) const { return layout_.vertices()[static_cast<std::size_t>(v)]; }

  void add_empty_node(const std::string& name) {
    json_["scenes"][0]["nodes"].push_back(0);
    json_["nodes"] = {{{"name", name}}};
  }

  /// Gives values names of attributes that differ.
  void name_attributes() {
    std::set<std::string> taken{std::string(gltf_vertex_attribute)};
    const auto colours = find_colours(mesh_.vertex_values);
    for (std::size_t i = 0; i < mesh_.vertex_values.size(); ++i) {
      if (colours && std::ranges::find(*colours, static_cast<Index>(i)) != colours->end()) continue;
      std::string name = "_" + mesh_.vertex_values[i].name;
      while (!taken.insert(name).second) name += '_';
      values_.emplace_back(i, std::move(name));
    }
    if (colours)
      for (const Index i : *colours)
        if (i >= 0) colours_.push_back(&mesh_.vertex_values[static_cast<std::size_t>(i)]);
  }

  int add_section(int target, std::int64_t stride, OrderedJson accessor, std::int64_t rows, int row_bytes,
                  auto append) {
    const int number = static_cast<int>(json_["accessors"].size());
    OrderedJson view{{"buffer", 0}, {"byteOffset", size_}, {"byteLength", rows * stride}};
    if (row_bytes != stride) view["byteStride"] = stride;
    view["target"] = target;
    json_["bufferViews"].push_back(std::move(view));
    accessor["bufferView"] = number;
    json_["accessors"].push_back(std::move(accessor));
    size_ += static_cast<std::uint64_t>(rows * stride);
    sections_.push_back({rows, std::move(append)});
    return number;
  }

  /// Adds a row for each vertex of a node; rows are padded to four bytes.
  /// @param put  put(out, v) appends the row of vertex v of the layout
  int add_rows(const GltfNode& node, GltfType type, int columns, bool normalized, auto put) {
    constexpr std::array shapes{"SCALAR", "VEC2", "VEC3", "VEC4"};
    const int row_bytes = columns * size_of(type), stride = (row_bytes + 3) / 4 * 4;
    OrderedJson accessor{{"componentType", static_cast<int>(type)},
                         {"count", node.vertices.size()},
                         {"type", shapes[static_cast<std::size_t>(columns - 1)]}};
    if (normalized) accessor["normalized"] = true;
    return add_section(array_buffer, stride, std::move(accessor), std::ssize(node.vertices), row_bytes,
                       [&node, put, padding = static_cast<std::size_t>(stride - row_bytes)](
                           std::string& out, std::int64_t begin, std::int64_t end) {
                         for (std::int64_t i = begin; i < end; ++i) {
                           put(out, node.vertices[static_cast<std::size_t>(i)]);
                           out.append(padding, '\0');
                         }
                       });
  }

  int add_positions(const GltfNode& node) {
    const int number = add_rows(node, GltfType::float32, 3, false, [this, &node](std::string& out, Index v) {
      for (const float x : GltfLayout::position(node, mesh_.positions, vertex(v).source)) append_float(out, double{x});
    });
    std::array<float, 3> low = GltfLayout::position(node, mesh_.positions, vertex(node.vertices[0]).source), high = low;
    for (const Index v : node.vertices) {
      const std::array<float, 3> point = GltfLayout::position(node, mesh_.positions, vertex(v).source);
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], point[k]);
        high[k] = std::max(high[k], point[k]);
      }
    }
    OrderedJson& bounds = json_["accessors"][static_cast<std::size_t>(number)];
    for (std::size_t k = 0; k < 3; ++k) {
      bounds["min"].push_back(double{low[k]});
      bounds["max"].push_back(double{high[k]});
    }
    return number;
  }

  /// Appends the first two columns, of one column with 0.
  static void put_texture(std::string& out, const Points& values, Index row) {
    append_float(out, values.cols() > 0 ? values(row, 0) : 0);
    append_float(out, 1 - (values.cols() > 1 ? values(row, 1) : 0));
  }

  int add_colours(const GltfNode& node) {
    const bool is_one_type =
        std::ranges::all_of(colours_, [&](const Mesh::Values* one) { return one->type == colours_[0]->type; });
    const GltfType type = is_one_type && colours_[0]->type == ValueType::uint8    ? GltfType::uint8
                          : is_one_type && colours_[0]->type == ValueType::uint16 ? GltfType::uint16
                                                                                  : GltfType::float32;
    return add_rows(node, type, static_cast<int>(colours_.size()), type != GltfType::float32,
                    [this, type](std::string& out, Index v) {
                      const auto source = static_cast<std::size_t>(vertex(v).source);
                      for (const Mesh::Values* const one : colours_)
                        append_as(out, type,
                                  type == GltfType::float32 ? std::clamp(colour_in_unit(*one, source), 0.0, 1.0)
                                                            : one->values[source]);
                    });
  }

  OrderedJson add_attributes(const GltfNode& node) {
    OrderedJson attributes;
    attributes["POSITION"] = add_positions(node);
    if (mesh_.normals.rows() > 0)
      attributes["NORMAL"] = add_rows(node, GltfType::float32, 3, false, [this](std::string& out, Index v) {
        for (const double x : layout_.normal(v)) append_float(out, x);
      });
    int channels = 0;
    const auto add_texture = [&](auto put) {
      attributes["TEXCOORD_" + format_number(channels++)] = add_rows(node, GltfType::float32, 2, false, put);
    };
    if (const Mesh::FaceVarying* const channel = layout_.channel())
      add_texture([this, channel](std::string& out, Index v) { put_texture(out, channel->values, vertex(v).value); });
    if (mesh_.texture.rows() > 0)
      add_texture([this](std::string& out, Index v) { put_texture(out, mesh_.texture, vertex(v).source); });
    if (!colours_.empty()) attributes["COLOR_0"] = add_colours(node);
    for (const auto& [i, name] : values_) {
      const Mesh::Values& one = mesh_.vertex_values[i];
      const GltfType type = file_type(one.type);
      attributes[name] = add_rows(node, type, 1, false, [this, &one, type](std::string& out, Index v) {
        append_as(out, type, one.values[static_cast<std::size_t>(vertex(v).source)]);
      });
    }
    if (layout_.needs_numbers())
      attributes[std::string(gltf_vertex_attribute)] =
          add_rows(node, GltfType::uint16, 2, false, [this](std::string& out, Index v) {
            append_low_bytes(out, static_cast<std::uint32_t>(vertex(v).source), 4);
          });
    return attributes;
  }

  int material_of(Index material) {
    const auto [at, is_new] = material_numbers_.emplace(material, static_cast<int>(materials_.size()));
    if (is_new)  // the default of the format is metal
      materials_.push_back({{"name", mesh_.materials.names[static_cast<std::size_t>(material)]},
                            {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    return at->second;
  }

  void add_node(const GltfNode& node, const std::string& name) {
    const std::size_t number = meshes_.size();
    json_["scenes"][0]["nodes"].push_back(number);
    OrderedJson made, mesh;
    if (node.object >= 0)
      made["name"] = mesh["name"] = mesh_.objects.names[static_cast<std::size_t>(node.object)];
    else if (mesh_.objects.of_face.empty())
      made["name"] = mesh["name"] = name;
    if (json_.contains("nodes"))
      json_["nodes"].push_back(nullptr);
    else
      json_["nodes"] = {nullptr};
    const OrderedJson attributes = add_attributes(node);
    for (const GltfPrimitive& primitive : node.primitives) {
      const std::int64_t count = std::ssize(primitive.corners);
      const int indices = add_section(
          element_array_buffer, 4,
          {{"componentType", static_cast<int>(GltfType::uint32)}, {"count", count}, {"type", "SCALAR"}}, count, 4,
          [&primitive](std::string& out, std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i)
              append_low_bytes(out, static_cast<std::uint32_t>(primitive.corners[static_cast<std::size_t>(i)]), 4);
          });
      OrderedJson one{{"attributes", attributes}, {"indices", indices}, {"mode", 4}};
      if (primitive.material >= 0) one["material"] = material_of(primitive.material);
      if (layout_.has_polygons()) one["extensions"] = {{"FB_ngon_encoding", OrderedJson::object()}};
      mesh["primitives"].push_back(std::move(one));
    }
    if (!node.origin.isZero(0)) made["translation"] = {node.origin[0], node.origin[1], node.origin[2]};
    made["mesh"] = number;
    json_["nodes"][number] = std::move(made);
    meshes_.push_back(std::move(mesh));
  }

  const Mesh& mesh_;
  GltfLayout layout_;
  OrderedJson json_, meshes_ = OrderedJson::array(), materials_ = OrderedJson::array();
  std::map<Index, int> material_numbers_;
  std::vector<const Mesh::Values*> colours_;                 // red, green, blue, and alpha if there is one
  std::vector<std::pair<std::size_t, std::string>> values_;  // others, with their attributes
  std::vector<Section> sections_;
  std::uint64_t size_ = 0;
};

void emit_glb(const GltfOutput& output, const std::string& name, RowWriter out) {
  std::string text = output.text();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::uint64_t total = 12 + 8 + text.size() + (output.size() > 0 ? 8 + output.size() : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw ResourceError(name + ": binary glTF files have less than 4 GB; this one would have " + format_number(total) +
                        " bytes; write a .ply, or a coarser mesh");
  out.write("glTF" + word(2) + word(total) + word(text.size()) + "JSON" + text);
  if (output.size() == 0) return;
  out.write(word(output.size()) + std::string("BIN\0", 4));
  output.write(out);
}

}  // namespace

std::vector<std::string> changes_in_gltf(const Mesh& mesh) {
  std::vector<std::string> changes;
  const auto colours = find_colours(mesh.vertex_values);
  std::int64_t cut = 0;
  for (std::size_t i = 0; i < mesh.vertex_values.size(); ++i) {
    const Mesh::Values& one = mesh.vertex_values[i];
    if (colours && std::ranges::find(*colours, static_cast<Index>(i)) != colours->end()) {
      for (std::size_t v = 0; v < one.values.size(); ++v) {
        const double colour = colour_in_unit(one, v);
        cut += !(colour >= 0 && colour <= 1);
      }
      continue;
    }
    const GltfType type = file_type(one.type);
    const bool is_float = type == GltfType::float32,
               is_whole = one.type != ValueType::float32 && one.type != ValueType::float64;
    const auto changed = std::ranges::count_if(one.values, [&](double x) {
      if (is_float) return is_whole && double{static_cast<float>(x)} != x;
      return std::nearbyint(x) != nearest_in(type, x);
    });
    if (changed > 0)
      changes.push_back("values " + in_quotes(one.name) + " beyond " +
                        (is_float ? "the whole numbers that floats have, " : "their type, ") + format_number(changed) +
                        " of them, are " + (is_float ? "rounded" : "cut off"));
  }
  if (cut > 0)
    changes.push_back("numbers of colours of vertices beyond 0 to 1, " + format_number(cut) +
                      " of them, are cut off; a .ply of type float or double keeps them");
  return changes;
}

std::string format_glb(const Mesh& mesh) {
  check_gltf(mesh, "glTF");
  std::string bytes;
  emit_glb(GltfOutput(mesh, "mesh"), "glTF", RowWriter(bytes));
  return bytes;
}

void write_glb(const std::filesystem::path& path, const Mesh& mesh, const std::function<void(std::int64_t)>& progress) {
  check_gltf(mesh, path.string());
  const GltfOutput output(mesh, path.stem().string());
  AtomicFile file(path, progress);
  emit_glb(output, path.string(), RowWriter(file));
  file.commit();
}

void write_gltf(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress) {
  check_gltf(mesh, path.string());
  const GltfOutput output(mesh, path.stem().string());
  const std::string text = output.text();
  AtomicFile file(path, progress);
  RowWriter out(file);
  if (output.size() == 0) {
    out.write(text);
    return file.commit();
  }
  constexpr std::string_view end = "}]}";  // of the buffer, of all buffers, of the whole
  std::string buffer;
  RowWriter collected(buffer);
  output.write(collected);
  out.write(std::string_view(text).substr(0, text.size() - end.size()));
  out.write(",\"uri\":\"data:application/octet-stream;base64,");
  constexpr std::int64_t bytes_per_row = 12;
  out.rows((std::ssize(buffer) + bytes_per_row - 1) / bytes_per_row, gltf_rows_per_block,
           [&](std::string& letters, std::int64_t begin, std::int64_t stop) {
             const auto first = static_cast<std::size_t>(begin * bytes_per_row);
             append_base64(letters, std::string_view(buffer).substr(
                                        first, static_cast<std::size_t>((stop - begin) * bytes_per_row)));
           });
  out.write("\"" + std::string(end));
  file.commit();
}

}  // namespace sublimit
