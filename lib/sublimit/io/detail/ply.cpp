// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/ply.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sublimit/io/detail/equal_rows.h"
#include "sublimit/io/detail/formats.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/ply_rows.h"
#include "sublimit/io/detail/ply_strips.h"
#include "sublimit/io/detail/ply_values.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr std::string_view not_vertex_values[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::string_view not_face_values[] = {"vertex_indices", "vertex_index", "texcoord"};

/// Reads the elements of a file in the order of its header. `Values` is PlyTextValues or PlyBinaryValues.
template <class Values>
class PlyReader {
 public:
  /// @param names  names of numbers of vertices to read, and nothing else that is no shape; absent: all that is known
  PlyReader(std::string_view bytes, const PlyHeader& header, const std::string& name,
            const std::optional<std::span<const std::string>>& names)
      : header_(header),
        name_(name),
        reads_all_(!names),
        vertex_(require_element(header, name, "vertex", "x, y and z")),
        num_vertices_(checked_index(vertex_.count, name, "vertices")),
        strips_(find_strips()),
        face_(strips_ ? *strips_ : require_element(header, name, "face", "vertex_indices")),
        vertex_names_(names ? std::vector<std::string>(names->begin(), names->end())
                            : names_of_numbers(vertex_, not_vertex_values)),
        face_names_(names || strips_ ? std::vector<std::string>() : names_of_numbers(face_, not_face_values)),
        values_(bytes, header, name) {
    checked_index(face_.count, name, "faces");
  }

  Mesh read() {
    const PlyVertices vertices(vertex_, name_, vertex_names_);
    std::optional<PlyFaces> faces;
    if (!strips_) faces.emplace(face_, name_, num_vertices_, face_names_);
    if (reads_all_) warn_of_others(faces ? faces->texture() : nullptr);
    for (const PlyElement& element : header_.elements) {
      if (&element == &vertex_) {
        read_vertices(vertices);
      } else if (&element != &face_) {
        skip(values_, element);
      } else if (faces) {
        read_faces(*faces);
      } else {
        read_strips();
      }
    }
    if (!values_.at_end()) mesh_.warnings.push_back(values_.place() + "data behind the last element ignored");
    if (reads_all_) {
      drop_not_finite(mesh_.vertex_values, "vertices", vertex_);
      drop_not_finite(mesh_.face_values, "faces", face_);
      add_texture(faces ? faces->texture() : nullptr);
    }
    return std::move(mesh_);
  }

 private:
  /// Strips of a file without faces.
  const PlyElement* find_strips() const {
    const auto filled = [&](const char* name) {
      const auto found = std::ranges::find(header_.elements, name, &PlyElement::name);
      return found == header_.elements.end() || found->count == 0 ? nullptr : &*found;
    };
    return filled("face") ? nullptr : filled("tristrips");
  }

  std::string place(std::int64_t line) const { return name_ + ":" + format_number(line) + ": "; }

  void warn_of_others(const PlyProperty* texture) {
    std::vector<std::string> others;
    std::int64_t first = 0;
    const auto add = [&](std::int64_t line, const std::string& words) {
      if (others.empty()) first = line;
      others.push_back(words);
    };
    const auto add_properties = [&](const PlyElement& element, const char* of, const std::vector<std::string>& kept) {
      const std::size_t list = &element == &face_ ? find_indices(element, name_) : element.properties.size();
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        const bool is_normal =
            &element == &vertex_ && std::ranges::find(not_vertex_values, property.name) != std::end(not_vertex_values);
        if (i == list || &property == texture || (!property.length && is_normal)) continue;
        if (property.length || std::ranges::find(kept, property.name) == kept.end())
          add(property.line, (property.length ? "list " : "number ") + in_quotes(property.name) + " of " + of);
      }
    };
    for (const PlyElement& element : header_.elements) {
      if (&element == &vertex_)
        add_properties(element, "vertices", vertex_names_);
      else if (&element == &face_)
        add_properties(element, strips_ ? "strips" : "faces", face_names_);
      else if (element.count > 0 && !element.properties.empty())
        add(element.line, "element " + in_quotes(element.name));
    }
    if (!others.empty())
      mesh_.warnings.push_back(place(first) + listed(others, "and") +
                               " left out; numbers of vertices and faces and the list 'texcoord' of faces are kept");
  }

  void read_vertices(const PlyVertices& vertices) {
    for (const PlyProperty* const property : vertices.further())
      mesh_.vertex_values.push_back({property->name, std::vector<double>(std::size_t(num_vertices_)), property->type});
    mesh_.positions.resize(num_vertices_, 3);  // the file is long enough for three columns of so many rows
    std::vector<double> row(3 + mesh_.vertex_values.size());
    for (Index v = 0; v < num_vertices_; ++v) {
      vertices.read(values_, v, row);
      std::copy_n(row.begin(), 3, mesh_.positions.row(v).data());
      for (std::size_t i = 0; i < mesh_.vertex_values.size(); ++i)
        mesh_.vertex_values[i].values[std::size_t(v)] = row[3 + i];
    }
  }

  void read_faces(const PlyFaces& faces) {
    for (const PlyProperty* const property : faces.further())
      mesh_.face_values.push_back({property->name, {}, property->type});
    std::vector<double> row(mesh_.face_values.size());
    for (std::int64_t f = 0; f < face_.count; ++f) {
      const std::size_t before = texture_.size();
      const Index size = faces.read(values_, f, mesh_.face_vertices, row, reads_all_ ? &texture_ : nullptr);
      mesh_.face_sizes.push_back(size);
      checked_index(std::ssize(mesh_.face_vertices), name_, "corners of faces");
      for (std::size_t i = 0; i < row.size(); ++i) mesh_.face_values[i].values.push_back(row[i]);
      if (!without_texture_ && reads_all_ && texture_.size() != before + 2 * std::size_t(size)) without_texture_ = f;
      if (without_texture_) texture_.clear();
    }
  }

  void read_strips() {
    const PlyStrips strips(face_, name_, num_vertices_);
    for (std::int64_t i = 0; i < face_.count; ++i) {
      strips.read(values_, i, mesh_.face_vertices);
      checked_index(std::ssize(mesh_.face_vertices), name_, "corners of triangles in strips");
    }
    if (mesh_.face_vertices.empty())
      throw InvalidMesh(place(face_.line) + "no triangles in the strips; a mesh should have some");
    mesh_.face_sizes.assign(mesh_.face_vertices.size() / 3, 3);
  }

  /// Some programs write "not a number" for values that they do not know.
  void drop_not_finite(std::vector<Mesh::Values>& all, const char* of, const PlyElement& element) {
    std::erase_if(all, [&](const Mesh::Values& one) {
      const auto bad = std::ranges::find_if(one.values, [](double x) { return !std::isfinite(x); });
      if (bad == one.values.end()) return false;
      const auto property = std::ranges::find(element.properties, one.name, &PlyProperty::name);
      mesh_.warnings.push_back(place(property->line) + "number " + in_quotes(one.name) + " of " + of + " is " +
                               format_number(*bad) + " at " + format_number(bad - one.values.begin()) +
                               " and is left out; it should be finite everywhere");
      return true;
    });
  }

  void add_texture(const PlyProperty* list) {
    if (!list) return;
    if (without_texture_) {
      mesh_.warnings.push_back(place(list->line) + "list 'texcoord' of face " + format_number(*without_texture_) +
                               " has not two numbers for each corner; texture coordinates are left out");
      return;
    }
    if (!std::ranges::all_of(texture_, [](double x) { return std::isfinite(x); })) {
      mesh_.warnings.push_back(place(list->line) +
                               "list 'texcoord' has numbers that are not finite; texture coordinates are left out");
      return;
    }
    Mesh::FaceVarying& channel = mesh_.face_varying.emplace_back();
    channel.name = "uv";
    EqualRows rows;  // a value of its own for each vertex
    for (std::size_t c = 0; c < mesh_.face_vertices.size(); ++c)
      channel.indices.push_back(rows.add({double(mesh_.face_vertices[c]), texture_[2 * c], texture_[2 * c + 1]}));
    channel.values.resize(std::ssize(rows.rows()), 2);
    for (std::size_t i = 0; i < rows.rows().size(); ++i)
      channel.values.row(Eigen::Index(i)) << rows.rows()[i][1], rows.rows()[i][2];
  }

  const PlyHeader& header_;
  std::string name_;
  bool reads_all_;
  const PlyElement& vertex_;
  Index num_vertices_;
  const PlyElement* strips_;
  const PlyElement& face_;  // or the strips
  std::vector<std::string> vertex_names_, face_names_;
  Values values_;
  Mesh mesh_;
  std::vector<double> texture_;                  // two for each corner
  std::optional<std::int64_t> without_texture_;  // the first such face
};

Mesh parse(std::string_view bytes, std::string_view name, const std::optional<std::span<const std::string>>& names) {
  const PlyHeader header = parse_ply_header(bytes, name);
  const std::string file(name);
  return header.encoding == PlyHeader::Encoding::text ? PlyReader<PlyTextValues>(bytes, header, file, names).read()
                                                      : PlyReader<PlyBinaryValues>(bytes, header, file, names).read();
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path) { return parse_ply(read_inflated(path), path.string()); }

Mesh parse_ply(std::string_view bytes, std::string_view name) { return parse(bytes, name, std::nullopt); }

Mesh read_ply(const std::filesystem::path& path, std::span<const std::string> names) {
  return parse_ply(read_inflated(path), path.string(), names);
}

Mesh parse_ply(std::string_view bytes, std::string_view name, std::span<const std::string> names) {
  return parse(bytes, name, names);
}

}  // namespace sublimit
