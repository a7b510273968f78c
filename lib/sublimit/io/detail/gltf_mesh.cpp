// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/gltf_accessor.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t triangles_mode = 4, strip_mode = 5, fan_mode = 6;

ValueType value_type(const GltfAccessor& accessor) {
  if (accessor.is_normalized()) return ValueType::float32;
  switch (accessor.type()) {
    case GltfType::int8:
      return ValueType::int8;
    case GltfType::uint8:
      return ValueType::uint8;
    case GltfType::int16:
      return ValueType::int16;
    case GltfType::uint16:
      return ValueType::uint16;
    case GltfType::uint32:
      return ValueType::uint32;
    default:
      return ValueType::float32;
  }
}

/// Triangles of one material: corners are rows of its accessors.
struct Primitive {
  GltfObject object, attributes;
  std::int64_t mode, material, positions, numbers;  // numbers: of accessors, -1 for none
  std::optional<GltfAccessor> indices;
  bool has_polygons;
  std::int64_t count = 0;  ///< of corners in the file, before strips and fans are cut

  std::int64_t row(std::int64_t i) const { return indices ? static_cast<std::int64_t>(indices->raw(i, 0)) : i; }
  /// Calls visit(a, b, c) with the rows of each triangle.
  template <class Visit>
  void triangles(const Visit& visit) const {
    if (mode == triangles_mode) {
      for (std::int64_t i = 0; i + 2 < count; i += 3) visit(row(i), row(i + 1), row(i + 2));
    } else {
      for (std::int64_t i = 0; i + 2 < count; ++i) {
        if (mode == strip_mode)
          visit(row(i), row(i + 1 + i % 2), row(i + 2 - i % 2));
        else
          visit(row(i + 1), row(i + 2), row(0));
      }
    }
  }
};

/// A column of an accessor, and where its values go.
struct Source {
  const GltfAccessor* accessor;
  int column;
  std::size_t values;
};

class MeshReader {
 public:
  MeshReader(GltfFile& file, std::int64_t number, GltfReservations& reservations, GltfRows& rows)
      : file_(file),
        object_(file.root().element("meshes", number)),
        reservations_(reservations),
        vertex_of_(rows.vertex),
        last_user_(rows.last_user) {}

  GltfMesh read() {
    // Primitives that share positions share their vertices in the order of these.
    std::vector<std::vector<Primitive>> groups;
    std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> group_of;
    bool has_targets = false;
    for (std::int64_t i = 0; i < object_.size("primitives"); ++i) {
      std::optional<Primitive> primitive = read_primitive(i);
      if (!primitive) continue;
      has_targets = has_targets || primitive->object.size("targets") > 0;
      const auto [at, is_new] = group_of.emplace(std::pair(primitive->positions, primitive->numbers), groups.size());
      if (is_new) groups.emplace_back();
      groups[at->second].push_back(std::move(*primitive));
    }
    if (has_targets) reservations_.add("its morph targets are left out", object_.in_words());
    for (std::vector<Primitive>& group : groups) read_group(group);
    finish();
    return std::move(mesh_);
  }

 private:
  std::optional<Primitive> read_primitive(std::int64_t i) {
    const GltfObject object = object_.element("primitives", i);
    const std::int64_t mode = object.integer("mode", triangles_mode);
    if (mode > fan_mode) object.fail("mode", format_number(mode) + "; 0 to 6 are modes");
    const auto leave_out = [&](const char* what) {
      reservations_.add(what, object_.in_words());
      return std::nullopt;
    };
    if (mode < triangles_mode) return leave_out("points or lines, which are left out");
    const std::optional<GltfObject> attributes = object.object("attributes");
    if (!attributes || !attributes->has("POSITION"))
      return leave_out("a primitive without POSITION, which is left out");
    const std::int64_t accessors = file_.root().size("accessors");
    const std::optional<GltfObject> extensions = object.object("extensions");
    Primitive primitive{object,
                        *attributes,
                        mode,
                        object.index("material", file_.root().size("materials"), "materials"),
                        attributes->index("POSITION", accessors, "accessors"),
                        attributes->index(gltf_vertex_attribute.data(), accessors, "accessors"),
                        std::nullopt,
                        mode == triangles_mode && extensions && extensions->has("FB_ngon_encoding")};
    if (const std::int64_t indices = object.index("indices", accessors, "accessors"); indices >= 0) {
      primitive.indices.emplace(file_, indices);
      if (primitive.indices->columns() != 1 || primitive.indices->is_normalized() ||
          (primitive.indices->type() != GltfType::uint8 && primitive.indices->type() != GltfType::uint16 &&
           primitive.indices->type() != GltfType::uint32))
        throw FormatError(primitive.indices->place() + ": indices should be whole numbers without sign, one a row");
    }
    return primitive;
  }

  void read_group(std::vector<Primitive>& group) {
    const GltfAccessor positions(file_, group[0].positions);
    if (positions.columns() != 3) throw FormatError(positions.place() + ": POSITION should have 3 columns");
    std::optional<GltfAccessor> numbers;
    if (group[0].numbers >= 0) numbers.emplace(file_, group[0].numbers);
    if (numbers && (numbers->columns() != 2 || numbers->type() != GltfType::uint16 || numbers->is_normalized() ||
                    numbers->count() != positions.count()))
      numbers.reset();  // an attribute of another program
    const auto rows = static_cast<std::size_t>(positions.count());
    if (vertex_of_.size() < rows) vertex_of_.resize(rows, -1), last_user_.resize(rows, -1);

    for (Primitive& primitive : group) {
      primitive.count = primitive.indices ? primitive.indices->count() : positions.count();
      if (primitive.mode == triangles_mode && primitive.count % 3 != 0)
        reservations_.add("corners behind the last triangle are left out", primitive.object.in_words());
      primitive.triangles([&](std::int64_t a, std::int64_t b, std::int64_t c) {
        for (const std::int64_t row : {a, b, c}) use(row, positions.count(), primitive);
      });
    }
    std::ranges::sort(used_);
    mesh_.file_vertices += std::ssize(used_);
    for (const Index row : used_) {
      EqualRowsOf<4>::Row vertex{};
      for (int k = 0; k < 3; ++k) {
        vertex[static_cast<std::size_t>(k)] = positions.value(row, k);
        if (!std::isfinite(vertex[static_cast<std::size_t>(k)]))
          throw InvalidMesh(positions.place() + ": a coordinate of row " + format_number(row) + " is " +
                            format_number(positions.value(row, k)) + "; it should be a finite number");
      }
      vertex[3] = numbers ? numbers->raw(row, 0) + 65536 * numbers->raw(row, 1) : -1;
      vertex_of_[static_cast<std::size_t>(row)] = welded_.add(vertex);
    }
    checked_index(std::ssize(welded_.rows()), file_.name(), "vertices");
    for (const Primitive& primitive : group) read_faces(primitive, positions.count(), numbers.has_value());
    for (const Index row : used_)
      vertex_of_[static_cast<std::size_t>(row)] = last_user_[static_cast<std::size_t>(row)] = -1;
    used_.clear();
  }

  void use(std::int64_t row, std::int64_t count, const Primitive& primitive) {
    if (row >= count)
      throw InvalidMesh((primitive.indices ? primitive.indices->place() : file_.name()) + ": index " +
                        format_number(row) + " is out of range; " + primitive.object.in_words() + " has " +
                        format_number(count) + " vertices");
    Index& vertex = vertex_of_[static_cast<std::size_t>(row)];
    if (vertex >= 0) return;
    vertex = 0;
    used_.push_back(static_cast<Index>(row));
  }

  /// The accessors of values that become values at vertices, and those of texture coordinates.
  struct Attributes {
    std::vector<GltfAccessor> accessors = {};
    std::vector<Source> sources = {};
    std::optional<GltfAccessor> texture = {};
  };

  std::size_t values_named(const std::string& name, bool is_colour, ValueType type) {
    const auto [at, is_new] = columns_.emplace(std::pair(is_colour, name), mesh_.values.size());
    if (is_new) {
      const auto columns = static_cast<double>(mesh_.values.size() + 1);
      check_memory(file_.name() + ": values at vertices", columns * 8 * static_cast<double>(welded_.rows().size()),
                   "leave some of them out");
      mesh_.values.push_back({name, is_colour, type});
    }
    GltfValues& found = mesh_.values[at->second];
    if (found.type != type) found.type = ValueType::float32;
    return at->second;
  }

  Attributes read_attributes(const Primitive& primitive, std::int64_t count, bool numbers_taken) {
    Attributes read;
    std::vector<std::pair<std::size_t, int>> places;  // in accessors
    const std::int64_t accessors = file_.root().size("accessors");
    const std::vector<std::string> keys = primitive.attributes.keys();
    const bool has_colours = primitive.attributes.has("COLOR_0");
    for (const std::string& key : keys) {
      if (key == "POSITION" || key == "NORMAL" || key == "TANGENT" || key.starts_with("JOINTS_") ||
          key.starts_with("WEIGHTS_") || (key == gltf_vertex_attribute && numbers_taken))
        continue;
      const auto leave_out = [&](const std::string& why) {
        reservations_.add(in_quotes(key) + " is left out" + why, object_.in_words());
      };
      const bool is_colour = key == "COLOR_0", is_texture = key == "TEXCOORD_0";
      if (!is_colour && !is_texture && !key.starts_with('_')) {
        leave_out("");
        continue;
      }
      GltfAccessor accessor(file_, primitive.attributes.index(key.c_str(), accessors, "accessors"));
      if (accessor.count() != count)
        throw FormatError(accessor.place() + ": " + format_number(accessor.count()) + " rows of " + in_quotes(key) +
                          " for " + format_number(count) + " vertices of " + primitive.object.in_words());
      const int columns = accessor.columns();
      if (is_texture) {
        if (columns != 2) throw FormatError(accessor.place() + ": TEXCOORD_0 should have 2 columns");
        read.texture.emplace(std::move(accessor));
      } else if (is_colour) {
        if (columns != 3 && columns != 4) throw FormatError(accessor.place() + ": COLOR_0 should have 3 or 4 columns");
        const ValueType type = accessor.type() == GltfType::uint8    ? ValueType::uint8
                               : accessor.type() == GltfType::uint16 ? ValueType::uint16
                                                                     : ValueType::float32;
        for (int k = 0; k < columns; ++k) {
          read.sources.push_back({nullptr, k, values_named(colour_names[static_cast<std::size_t>(k)], true, type)});
          places.emplace_back(read.accessors.size(), k);
        }
        read.accessors.push_back(std::move(accessor));
      } else if (columns != 1) {
        leave_out(": it has " + format_number(columns) + " numbers at each vertex, not one");
      } else {
        std::string name = key.substr(1);
        if (has_colours && std::ranges::find(colour_names, name) != colour_names.end()) name = key;
        read.sources.push_back({nullptr, 0, values_named(name, false, value_type(accessor))});
        places.emplace_back(read.accessors.size(), 0);
        read.accessors.push_back(std::move(accessor));
      }
    }
    for (std::size_t i = 0; i < places.size(); ++i) read.sources[i].accessor = &read.accessors[places[i].first];
    return read;
  }

  /// A colour as 0 to 1, another value as it is.
  static double number_of(const Source& source, bool is_colour, std::int64_t row) {
    const GltfAccessor& accessor = *source.accessor;
    if (!is_colour || accessor.is_normalized() || accessor.type() == GltfType::float32)
      return accessor.value(row, source.column);
    return accessor.raw(row, source.column) / (accessor.type() == GltfType::uint16 ? 65535 : 255);
  }

  void set_values(const Attributes& attributes, std::int64_t row, Index vertex) {
    for (const Source& source : attributes.sources) {
      GltfValues& one = mesh_.values[source.values];
      if (one.values.size() < welded_.rows().size()) one.values.resize(welded_.rows().size(), no_value);
      const double number = number_of(source, one.is_colour, row);
      double& value = one.values[static_cast<std::size_t>(vertex)];
      if (!std::isfinite(number))
        leave_out(one, "is not a finite number somewhere");
      else if (std::isnan(value))
        value = number;
      else if (value != number)
        leave_out(one, "differs between the faces of a vertex");
    }
  }

  void leave_out(const GltfValues& values, const std::string& why) {
    left_out_.emplace(values.is_colour ? "COLOR_0" : "_" + values.name, why);
  }

  void read_faces(const Primitive& primitive, std::int64_t count, bool numbers_taken) {
    const Attributes attributes = read_attributes(primitive, count, numbers_taken);
    if (attributes.texture ? has_texture_ == false : has_texture_ == true) texture_is_partial_ = true;
    has_texture_ = attributes.texture.has_value();
    std::vector<std::int64_t> face;
    const auto add = [&] {
      if (!face.empty()) add_face(primitive, attributes, face);
      face.clear();
    };
    const Index user = num_users_++;
    primitive.triangles([&](std::int64_t a, std::int64_t b, std::int64_t c) {
      if (!attributes.sources.empty())
        for (const std::int64_t row : {a, b, c})
          if (std::exchange(last_user_[static_cast<std::size_t>(row)], user) != user)
            set_values(attributes, row, vertex_of_[static_cast<std::size_t>(row)]);
      // Triangles of one polygon begin at the same corner, and those of the next one at another.
      if (primitive.has_polygons && !face.empty() && face.front() == a && face.back() == b) {
        face.push_back(c);
      } else {
        add();
        face = {a, b, c};
      }
    });
    add();
  }

  void add_face(const Primitive& primitive, const Attributes& attributes, const std::vector<std::int64_t>& rows) {
    const auto vertex = [&](std::size_t i) { return vertex_of_[static_cast<std::size_t>(rows[i % rows.size()])]; };
    std::size_t size = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) size += vertex(i) != vertex(i + 1);
    if (size < 3) {
      if (primitive.mode == triangles_mode)  // strips and fans jump so
        reservations_.add("a triangle with two equal corners, which is left out", primitive.object.in_words());
      return;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (vertex(i) == vertex(i + 1)) continue;
      mesh_.face_vertices.push_back(vertex(i));
      if (!attributes.texture) continue;
      const double s = attributes.texture->value(rows[i], 0), t = 1 - attributes.texture->value(rows[i], 1);
      const bool is_finite = std::isfinite(s) && std::isfinite(t);
      if (!is_finite) left_out_.emplace("TEXCOORD_0", "is not a finite number somewhere");
      mesh_.corners.push_back(is_finite ? mesh_.texture.add({static_cast<double>(vertex(i)), s, t}) : 0);
    }
    checked_index(std::ssize(mesh_.face_vertices), file_.name(), "corners of faces");
    mesh_.face_sizes.push_back(static_cast<Index>(size));
    mesh_.materials.push_back(static_cast<Index>(primitive.material));
  }

  /// Leaves out vertices of triangles that have been left out.
  void keep_vertices_of_faces() {
    std::vector<Index> number(welded_.rows().size(), -1);
    for (const Index v : mesh_.face_vertices) number[static_cast<std::size_t>(v)] = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      const std::size_t place = mesh_.vertices.size();
      number[v] = static_cast<Index>(place);
      mesh_.vertices.push_back(welded_.rows()[v]);
      for (GltfValues& one : mesh_.values) one.values[place] = one.values[v];
    }
    for (GltfValues& one : mesh_.values) one.values.resize(mesh_.vertices.size());
    for (Index& v : mesh_.face_vertices) v = number[static_cast<std::size_t>(v)];
  }

  void finish() {
    for (GltfValues& one : mesh_.values) one.values.resize(welded_.rows().size(), no_value);
    keep_vertices_of_faces();
    bool some_lack_colours = false;
    for (GltfValues& one : mesh_.values) {
      if (std::ranges::none_of(one.values, [](double x) { return std::isnan(x); })) continue;
      if (!one.is_colour) {
        leave_out(one, "is at some of the vertices alone");
        continue;
      }
      some_lack_colours = some_lack_colours || one.name != colour_names[3];
      for (double& x : one.values)
        if (std::isnan(x)) x = 1;
    }
    if (some_lack_colours) reservations_.add("some vertices have no colour; they are white", object_.in_words());
    if (texture_is_partial_) left_out_.emplace("TEXCOORD_0", "is at some of the corners alone");
    for (const auto& [key, why] : left_out_)
      reservations_.add(in_quotes(key) + " " + why + " and is left out", object_.in_words());
    if (left_out_.contains("TEXCOORD_0")) mesh_.corners.clear();
    std::erase_if(mesh_.values, [&](const GltfValues& one) {
      return left_out_.contains(one.is_colour ? "COLOR_0" : "_" + one.name);
    });
  }

  GltfFile& file_;
  GltfObject object_;
  GltfReservations& reservations_;
  GltfMesh mesh_;
  EqualRowsOf<4> welded_;                      // its vertices, also those in no face
  std::vector<Index>&vertex_of_, &last_user_;  // of rows of the accessors of a group
  std::vector<Index> used_;
  Index num_users_ = 0;
  std::map<std::pair<bool, std::string>, std::size_t> columns_;  // values by whether they are colours, and names
  std::optional<bool> has_texture_;
  bool texture_is_partial_ = false;
  std::map<std::string, std::string> left_out_;  // attributes, and why
};

}  // namespace

void GltfReservations::add(const std::string& what, const std::string& place) {
  const auto found = std::ranges::find(kinds_, what, &Kind::what);
  if (found == kinds_.end())
    kinds_.push_back({what, place, 1});
  else
    ++found->count;
}

std::vector<std::string> GltfReservations::messages(const std::string& file) const {
  std::vector<std::string> all;
  for (const Kind& kind : kinds_)
    all.push_back(file + ": " + kind.first + ": " + kind.what +
                  (kind.count > 1 ? "; so " + format_number(kind.count) + " times in the file" : ""));
  return all;
}

GltfMesh read_gltf_mesh(GltfFile& file, std::int64_t number, GltfReservations& reservations, GltfRows& rows) {
  return MeshReader(file, number, reservations, rows).read();
}

}  // namespace sublimit
