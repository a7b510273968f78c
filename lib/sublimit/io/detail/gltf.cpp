// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/gltf_file.h"
#include "sublimit/io/detail/gltf_mesh.h"
#include "sublimit/io/detail/gltf_nodes.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

/// True for a map that turns faces: one with a negative determinant.
bool is_mirror(Eigen::Matrix3d map) {
  for (Eigen::Index k = 0; k < 3; ++k) map.col(k).stableNormalize();  // or the product might be beyond numbers
  return map.determinant() < 0;
}

/// All meshes of a scene as one.
class GltfScene {
 public:
  GltfScene(std::string_view bytes, std::string_view name, const std::filesystem::path& folder)
      : file_(bytes, name, folder), root_(file_.root()) {}

  Mesh read() {
    instances_ = gltf_instances(file_, mesh_.notes);
    for (const GltfInstance& instance : instances_) {
      if (instance.node >= 0) reserve_node(root_.element("nodes", instance.node));
      if (!meshes_.contains(instance.mesh))
        meshes_.emplace(instance.mesh, read_gltf_mesh(file_, instance.mesh, reservations_, rows_));
    }
    make_room();
    for (const GltfInstance& instance : instances_) add(instance, meshes_.at(instance.mesh));
    finish();
    return std::move(mesh_);
  }

 private:
  void reserve_node(const GltfObject& node) {
    if (node.has("skin"))
      reservations_.add("its skin is left out; its vertices are where they were bound to joints", node.in_words());
    if (const auto extensions = node.object("extensions"); extensions && extensions->has("EXT_mesh_gpu_instancing"))
      reservations_.add("its copies by EXT_mesh_gpu_instancing are left out", node.in_words());
  }

  /// Checks what all copies take before they are made.
  void make_room() {
    double bytes = 0;
    std::int64_t corners = 0, vertices = 0;
    for (const GltfInstance& instance : instances_) {
      const GltfMesh& one = meshes_.at(instance.mesh);
      corners += std::ssize(one.face_vertices);
      vertices += std::ssize(one.vertices);
      bytes += 8 * static_cast<double>(one.face_sizes.size()) + 8 * static_cast<double>(one.face_vertices.size()) +
               (32 + 8 * static_cast<double>(one.values.size())) * static_cast<double>(one.vertices.size()) +
               24 * static_cast<double>(one.texture.rows().size());
    }
    if (corners == 0) {
      std::string why;
      for (const std::string& message : reservations_.messages(file_.name())) why += "; " + message;
      throw InvalidMesh(file_.name() + ": no triangles; a mesh should have some" + why);
    }
    checked_index(corners, file_.name(), "corners of faces");
    checked_index(vertices, file_.name(), "vertices");
    check_memory(file_.name() + ": " + format_number(corners) + " corners of faces", bytes, "split the file");
  }

  Index object_of(const GltfInstance& instance) {
    std::string name;
    if (instance.node >= 0) name = root_.element("nodes", instance.node).name();
    if (name.empty()) name = root_.element("meshes", instance.mesh).name();
    return objects_.number(clean(std::move(name)), mesh_.objects.names);
  }

  Index material_of(Index number) {
    if (number < 0) return -1;
    if (const auto found = material_numbers_.find(number); found != material_numbers_.end()) return found->second;
    const GltfObject material = root_.element("materials", number);
    note_looks(material);
    std::string name = clean(material.name());
    if (name.empty()) name = "material_" + format_number(number);
    return material_numbers_[number] = materials_.number(std::move(name), mesh_.materials.names);
  }

  void note_looks(const GltfObject& material) {
    const auto has_others = [](const GltfObject& object, std::initializer_list<std::string_view> known) {
      return std::ranges::any_of(object.keys(), [&](const std::string& key) {
        return std::ranges::find(known, std::string_view(key)) == known.end();
      });
    };
    const auto pbr = material.object("pbrMetallicRoughness");
    if (has_others(material, {"name", "pbrMetallicRoughness", "doubleSided", "extras"}) ||
        (pbr && has_others(*pbr, {"metallicFactor", "roughnessFactor", "extras"})))
      has_looks_ = true;
  }

  /// A name that all formats can write.
  std::string clean(std::string name) {
    const std::string given = name;
    for (std::size_t i = 0; i < name.size(); ++i) {
      char& c = name[i];
      const bool is_control = static_cast<unsigned char>(c) < ' ' || c == '\x7f';
      const bool is_comment = c == '#' && (i == 0 || name[i - 1] == ' ');
      if (is_control || is_comment || (c == '\\' && i + 1 == name.size())) c = '_';
    }
    has_cleaned_ = has_cleaned_ || name != given;
    return name;
  }

  void add(const GltfInstance& instance, const GltfMesh& one) {
    if (one.face_sizes.empty()) return;
    const std::vector<Index> vertices = add_vertices(instance, one);
    const bool turned = is_mirror(instance.transform.topLeftCorner<3, 3>());
    const Index object = object_of(instance);
    const auto first_value = static_cast<Index>(texture_.size());
    for (const auto& [vertex, s, t] : one.texture.rows()) texture_.push_back({s, t});
    if (one.corners.empty() && !without_texture_) without_texture_ = in_words(instance);
    has_texture_ = has_texture_ || !one.corners.empty();
    const auto* corner = one.face_vertices.data();
    const auto* value = one.corners.empty() ? nullptr : one.corners.data();
    for (std::size_t f = 0; f < one.face_sizes.size(); ++f) {
      const Index size = one.face_sizes[f];
      for (Index k = 0; k < size; ++k) {
        const Index at = turned && k > 0 ? size - k : k;
        mesh_.face_vertices.push_back(vertices[static_cast<std::size_t>(corner[at])]);
        if (value) values_of_corners_.push_back(first_value + value[at]);
      }
      corner += size;
      if (value) value += size;
      mesh_.face_sizes.push_back(size);
      mesh_.objects.of_face.push_back(object);
      mesh_.materials.of_face.push_back(material_of(one.materials[f]));
    }
  }

  /// Adds the vertices of an instance. Returns their numbers.
  std::vector<Index> add_vertices(const GltfInstance& instance, const GltfMesh& one) {
    file_vertices_ += one.file_vertices;
    std::vector<Index> numbers;
    std::vector<std::size_t> fresh;
    numbers.reserve(one.vertices.size());
    for (std::size_t v = 0; v < one.vertices.size(); ++v) {
      const auto& [x, y, z, number] = one.vertices[v];
      const Eigen::Vector3d moved = (instance.transform * Eigen::Vector4d(x, y, z, 1)).head<3>();
      if (!moved.allFinite())
        throw InvalidMesh(file_.name() + ": " + in_words(instance) +
                          ": a coordinate beyond finite numbers, by the transforms of nodes");
      Index vertex = static_cast<Index>(positions_.size());
      if (number >= 0) {
        const Index shared = shared_.add({moved[0], moved[1], moved[2], number});
        if (shared < std::ssize(shared_vertices_))
          vertex = shared_vertices_[static_cast<std::size_t>(shared)];
        else
          shared_vertices_.push_back(vertex);
      }
      numbers.push_back(vertex);
      if (vertex == std::ssize(positions_)) positions_.push_back({moved[0], moved[1], moved[2]});
    }
    add_values(instance, one, numbers);
    return numbers;
  }

  void add_values(const GltfInstance& instance, const GltfMesh& one, const std::vector<Index>& numbers) {
    for (const GltfValues& values : one.values) {
      const auto [at, is_new] = columns_.emplace(std::pair(values.is_colour, values.name), values_.size());
      if (is_new) values_.push_back({values.name, values.is_colour, values.type});
      GltfValues* const found = &values_[at->second];
      if (found->type != values.type) found->type = ValueType::float32;
      found->values.resize(positions_.size(), std::numeric_limits<double>::quiet_NaN());
      for (std::size_t v = 0; v < numbers.size(); ++v) {
        double& value = found->values[static_cast<std::size_t>(numbers[v])];
        if (!std::isnan(value) && value != values.values[v])
          differing_.emplace(found->is_colour ? "COLOR_0" : "_" + found->name, in_words(instance));
        value = values.values[v];
      }
    }
  }

  std::string in_words(const GltfInstance& instance) const {
    return instance.node >= 0 ? root_.element("nodes", instance.node).in_words()
                              : root_.element("meshes", instance.mesh).in_words();
  }

  void finish_values() {
    bool some_lack_colours = false;
    for (GltfValues& one : values_) {
      one.values.resize(positions_.size(), std::numeric_limits<double>::quiet_NaN());
      const std::string key = one.is_colour ? "COLOR_0" : "_" + one.name;
      if (const auto found = differing_.find(key); found != differing_.end()) {
        reservations_.add(in_quotes(key) + " differs between the faces of a vertex and is left out", found->second);
        continue;
      }
      const bool is_partial = std::ranges::any_of(one.values, [](double x) { return std::isnan(x); });
      if (is_partial && !one.is_colour) {
        reservations_.add("is at some of the meshes alone and is left out", in_quotes(key));
        continue;
      }
      some_lack_colours = some_lack_colours || (is_partial && one.name != colour_names[3]);
      const double most = one.is_colour && one.type == ValueType::uint8    ? 255
                          : one.is_colour && one.type == ValueType::uint16 ? 65535
                                                                           : 1;
      for (double& x : one.values) {
        if (std::isnan(x)) x = 1;
        if (most > 1) x = std::nearbyint(x * most);
      }
      mesh_.vertex_values.push_back({one.name, std::move(one.values), one.type});
    }
    if (some_lack_colours)
      mesh_.notes.push_back(file_.name() + ": some meshes have no colours of vertices: their vertices are white");
  }

  void finish() {
    mesh_.positions.resize(std::ssize(positions_), 3);
    for (std::size_t v = 0; v < positions_.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) mesh_.positions(Eigen::Index(v), Eigen::Index(k)) = positions_[v][k];
    for (Mesh::FaceNames* const names : {&mesh_.objects, &mesh_.materials})
      if (names->names.empty()) names->of_face.clear();
    if (has_texture_ && without_texture_) {
      reservations_.add("it has no texture coordinates, which others have; they are left out", *without_texture_);
    } else if (has_texture_) {
      Points values(std::ssize(texture_), 2);
      for (std::size_t i = 0; i < texture_.size(); ++i) values.row(Eigen::Index(i)) << texture_[i][0], texture_[i][1];
      mesh_.face_varying.push_back({"uv", std::move(values), std::move(values_of_corners_)});
    }
    finish_values();
    if (const std::int64_t animations = root_.size("animations"); animations > 0)
      reservations_.add("animations are left out", format_number(animations));
    const std::string name = file_.name() + ": ";
    if (file_vertices_ != std::ssize(positions_))
      mesh_.notes.push_back(name + "welded " + format_number(file_vertices_) + " vertices of the file to " +
                            format_number(positions_.size()));
    if (has_looks_) mesh_.notes.push_back(name + "of materials the names are kept, not their colours and textures");
    if (has_cleaned_)
      mesh_.notes.push_back(name + "line ends, # behind blanks and a last \\ in names are replaced by _");
    mesh_.warnings = file_.warnings;
    for (std::string& message : reservations_.messages(file_.name())) mesh_.warnings.push_back(std::move(message));
  }

  GltfFile file_;
  const GltfObject& root_;
  Mesh mesh_;
  GltfReservations reservations_;
  std::vector<GltfInstance> instances_;
  std::map<std::int64_t, GltfMesh> meshes_;
  GltfRows rows_;
  ObjNames objects_, materials_;
  std::map<Index, Index> material_numbers_;
  std::vector<std::array<double, 3>> positions_;
  std::vector<std::array<double, 2>> texture_;
  std::vector<Index> values_of_corners_;
  std::vector<GltfValues> values_;
  std::map<std::pair<bool, std::string>, std::size_t> columns_;  // values by whether they are colours, and names
  std::map<std::string, std::string> differing_;                 // attributes, and where
  EqualRowsOf<4> shared_;                                        // coordinates and numbers of vertices that have one
  std::vector<Index> shared_vertices_;
  std::optional<std::string> without_texture_;
  std::int64_t file_vertices_ = 0;
  bool has_texture_ = false, has_looks_ = false, has_cleaned_ = false;
};

}  // namespace

Mesh read_gltf(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  return parse_gltf(read_inflated(path), path.string(), folder.empty() ? "." : folder);
}

Mesh parse_gltf(std::string_view bytes, std::string_view name, const std::filesystem::path& folder) {
  return GltfScene(bytes, name, folder).read();
}

}  // namespace sublimit
