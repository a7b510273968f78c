// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usd.h"

#include <Eigen/Dense>
#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/io/detail/usd_mesh.h"
#include "sublimit/io/detail/usd_text.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

using Interpolation = UsdPrimvar::Interpolation;

bool is_of_vertices(const UsdPrimvar& primvar) {
  return primvar.interpolation == Interpolation::vertex || primvar.interpolation == Interpolation::varying;
}

/// Names for subsets of one family.
void name_faces(const std::vector<Index>& faces, const std::string& name, ObjNames& numbers, Index num_faces,
                Mesh::FaceNames& names) {
  if (names.of_face.empty()) names.of_face.assign(std::size_t(num_faces), -1);
  const Index number = numbers.number(name, names.names);
  for (const Index f : faces)
    if (names.of_face[std::size_t(f)] < 0) names.of_face[std::size_t(f)] = number;
}

void add_subsets(const UsdMesh& one, const std::function<std::string(const std::string&)>& name_of, Mesh& mesh) {
  ObjNames materials, groups, objects, smoothing;
  for (const UsdSubset& subset : one.subsets) {
    if (!subset.material.empty() || subset.family == "materialBind")
      name_faces(subset.faces, subset.material.empty() ? subset.name : name_of(subset.material), materials,
                 mesh.num_faces(), mesh.materials);
    else if (subset.family == "smoothingGroup")
      name_faces(subset.faces, subset.name, smoothing, mesh.num_faces(), mesh.smoothing_groups);
    else if (subset.family == "object")
      name_faces(subset.faces, subset.name, objects, mesh.num_faces(), mesh.objects);
    else
      name_faces(subset.faces, subset.name, groups, mesh.num_faces(), mesh.groups);
  }
  if (one.material.empty()) return;
  std::vector<Index> all(std::size_t(mesh.num_faces()));
  for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<Index>(f);
  name_faces(all, name_of(one.material), materials, mesh.num_faces(), mesh.materials);
}

void add_values(const UsdPrimvar& primvar, Index elements, std::vector<Mesh::Values>& to) {
  const bool one = primvar.interpolation == Interpolation::constant;
  for (int c = 0; c < primvar.type.width; ++c) {
    Mesh::Values values{component_name(primvar, c), {}, primvar.type.numbers};
    values.values.reserve(std::size_t(elements));
    for (Index i = 0; i < elements; ++i)
      values.values.push_back(primvar.values(primvar.indices[one ? 0 : std::size_t(i)], c));
    to.push_back(std::move(values));
  }
}

void add_primvars(const UsdMesh& one, Mesh& mesh) {
  for (const UsdPrimvar& primvar : one.primvars) {
    if (primvar.interpolation == Interpolation::face_varying)
      mesh.face_varying.push_back({primvar.name, primvar.values, primvar.indices});
    else if (is_of_vertices(primvar))
      add_values(primvar, mesh.num_vertices(), mesh.vertex_values);
    else
      add_values(primvar, mesh.num_faces(), mesh.face_values);
  }
  // Programs take the first channel for texture coordinates.
  std::stable_partition(mesh.face_varying.begin(), mesh.face_varying.end(),
                        [](const Mesh::FaceVarying& channel) { return channel.values.cols() == 2; });
  const auto smooth = std::ranges::count(one.primvars, Interpolation::vertex, &UsdPrimvar::interpolation);
  const auto linear = std::ranges::count(one.primvars, Interpolation::varying, &UsdPrimvar::interpolation);
  if (linear > 0 && smooth == 0) mesh.attributes = Attributes::linear;
  if (linear > 0 && smooth > 0)
    mesh.notes.push_back(one.place + "values of vertices are vertex and varying ones; all are refined by one rule");
}

Points in_world(const UsdMesh& one, const Points& points) {
  if (one.to_world == Eigen::Matrix4d::Identity()) return points;
  return (points * one.to_world.topLeftCorner<3, 3>().transpose()).rowwise() +
         one.to_world.topRightCorner<3, 1>().transpose();
}

/// Adds meshes one behind the other.
class Merger {
 public:
  void add(const UsdMesh& one, Mesh mesh) {
    check_rules(one, mesh);
    const Index vertices = num_vertices(), faces = all.num_faces();
    if (one.to_world != Eigen::Matrix4d::Identity()) {
      mesh.positions = in_world(one, mesh.positions);
      // Normals are those of the surface outside of a mirror, too.
      const Eigen::Matrix3d linear = one.to_world.topLeftCorner<3, 3>();
      if (mesh.normals.rows() > 0 && linear.determinant() != 0)
        mesh.normals = (mesh.normals * linear.inverse()).rowwise().normalized().eval();
      if (linear.determinant() < 0) turn_faces(mesh);
    }
    add_normals(mesh);
    checked_index(std::ssize(all.face_vertices) + std::ssize(mesh.face_vertices), one.place, "corners of faces");
    checked_index(std::int64_t{vertices} + mesh.num_vertices(), one.place, "points");
    add_rows(mesh.positions, positions_);
    for (const Index v : mesh.face_vertices) all.face_vertices.push_back(vertices + v);
    append(mesh.face_sizes, all.face_sizes);
    for (const Mesh::Crease& c : mesh.creases)
      all.creases.push_back({vertices + c.tail, vertices + c.head, c.sharpness});
    for (const Mesh::Corner& c : mesh.corners) all.corners.push_back({vertices + c.vertex, c.sharpness});
    for (const Mesh::KnotInterval& k : mesh.knot_intervals)
      all.knot_intervals.push_back({vertices + k.tail, vertices + k.head, k.length});
    for (const Index hole : mesh.holes) all.holes.push_back(faces + hole);
    const Index after = all.num_faces();
    add_objects(one, mesh, faces);
    add_names(mesh.groups, groups_, faces, after, all.groups);
    add_names(mesh.materials, materials_, faces, after, all.materials);
    add_names(mesh.smoothing_groups, smoothing_, faces, after, all.smoothing_groups);
    add_values(one, mesh.vertex_values, vertices, num_vertices(), all.vertex_values);
    add_values(one, mesh.face_values, faces, after, all.face_values);
    add_channels(one, mesh);
    if (mesh.attributes && (vertices == 0 || all.attributes)) all.attributes = mesh.attributes;
    append(mesh.warnings, all.warnings);
    append(mesh.notes, all.notes);
  }

  Mesh finish() {
    const auto rows = [](const std::vector<double>& numbers, Eigen::Index width) {
      Points points(std::ssize(numbers) / width, width);
      std::ranges::copy(numbers, points.data());
      return points;
    };
    all.positions = rows(positions_, 3);
    if (has_normals_) all.normals = rows(normals_, 3);
    for (std::size_t i = 0; i < channels_.size(); ++i)
      all.face_varying[i].values = rows(channels_[i].numbers, channels_[i].width);
    return std::move(all);
  }

  Mesh all;  ///< but for its positions and the values of channels

 private:
  struct Channel {
    Eigen::Index width;
    std::vector<double> numbers;
    Index num_values() const { return static_cast<Index>(std::ssize(numbers) / width); }
  };

  Index num_vertices() const { return static_cast<Index>(positions_.size() / 3); }
  template <class T>
  static void append(const std::vector<T>& from, std::vector<T>& to) {
    to.insert(to.end(), from.begin(), from.end());
  }
  static void add_rows(const Points& rows, std::vector<double>& to) {
    to.insert(to.end(), rows.data(), rows.data() + rows.size());
  }

  void check_rules(const UsdMesh& one, const Mesh& mesh) {
    const auto differs = [&](const char* rule) {
      throw InvalidMesh(one.place + rule + " is not that of " + first_ +
                        "; a mesh has one of each rule. `flatten` takes each prim by its own");
    };
    if (first_.empty()) {
      first_ = one.path;
      all.scheme = mesh.scheme;
      all.boundary = mesh.boundary, all.triangles = mesh.triangles, all.creasing = mesh.creasing;
      all.face_varying_interpolation = mesh.face_varying_interpolation;
      return;
    }
    if (all.scheme != mesh.scheme) {
      all.notes.push_back(one.place + "its scheme is " + (mesh.scheme.empty() ? "none" : mesh.scheme) +
                          ", not that of " + first_);
      all.scheme.clear();
    }
    const Boundary boundary = Boundary::edge_and_corner;
    if (all.boundary.value_or(boundary) != mesh.boundary.value_or(boundary)) differs("interpolateBoundary");
    if (all.creasing.value_or(Creasing::uniform) != mesh.creasing.value_or(Creasing::uniform))
      differs("sublimit:creaseMethod");
    if (all.triangles.value_or(Triangles::catmark) != mesh.triangles.value_or(Triangles::catmark))
      differs("triangleSubdivisionRule");
    if (!all.face_varying_interpolation) all.face_varying_interpolation = mesh.face_varying_interpolation;
    if (mesh.face_varying_interpolation && all.face_varying_interpolation != mesh.face_varying_interpolation)
      differs("faceVaryingLinearInterpolation");
  }

  /// Normals at corners; faces of meshes without them have their own.
  void add_normals(const Mesh& mesh) {
    if (!mesh.face_normals.empty() && !has_normals_) {
      has_normals_ = true;
      std::size_t first = 0;
      for (const Index size : all.face_sizes) {
        add_normal_of_face(&all.face_vertices[first], size, positions_.data());
        first += std::size_t(size);
      }
    }
    if (!has_normals_) return;
    const auto shift = static_cast<Index>(normals_.size() / 3);
    if (!mesh.face_normals.empty()) {
      add_rows(mesh.normals, normals_);
      for (const Index i : mesh.face_normals) all.face_normals.push_back(i < 0 ? -1 : shift + i);
      return;
    }
    std::size_t first = 0;
    for (const Index size : mesh.face_sizes) {
      add_normal_of_face(&mesh.face_vertices[first], size, mesh.positions.data());
      first += std::size_t(size);
    }
  }
  /// The normal of a polygon by its area (Newell).
  void add_normal_of_face(const Index* vertices, Index size, const double* points) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const auto at = [&](Index k) { return Eigen::Vector3d(points + 3 * std::ptrdiff_t(vertices[k])); };
    for (Index k = 0; k < size; ++k) normal += at(k).cross(at(k + 1 < size ? k + 1 : 0));
    normal = normal.norm() > 0 ? Eigen::Vector3d(normal.normalized()) : Eigen::Vector3d(0, 0, 1);
    all.face_normals.insert(all.face_normals.end(), std::size_t(size), static_cast<Index>(normals_.size() / 3));
    normals_.insert(normals_.end(), normal.data(), normal.data() + 3);
  }

  /// A prim is an object, but for the one that a mesh without objects is written as.
  void add_objects(const UsdMesh& one, const Mesh& mesh, Index before) {
    const std::vector<Index>& named = mesh.objects.of_face;
    for (Index f = 0; f < mesh.num_faces(); ++f) {
      const Index own = named.empty() ? -1 : named[std::size_t(f)];
      objects_.set(own >= 0                       ? mesh.objects.names[std::size_t(own)]
                   : one.name == unnamed_usd_mesh ? ""
                                                  : one.name,
                   all.objects);
      objects_.add_face(std::size_t(before + f), all.objects);
    }
  }
  /// Faces of meshes without names have none.
  static void add_names(const Mesh::FaceNames& from, ObjNames& numbers, Index before, Index after,
                        Mesh::FaceNames& to) {
    if (from.of_face.empty() && to.of_face.empty()) return;
    to.of_face.resize(std::size_t(before), -1);
    for (const Index name : from.of_face)
      to.of_face.push_back(name < 0 ? -1 : numbers.number(from.names[std::size_t(name)], to.names));
    to.of_face.resize(std::size_t(after), -1);
  }
  /// Values that only some meshes have are 0 elsewhere, colours 1, which is said.
  void add_values(const UsdMesh& one, const std::vector<Mesh::Values>& from, Index before, Index after,
                  std::vector<Mesh::Values>& to) {
    const auto missing = [&](const std::string& name) {
      const bool colour = std::ranges::find(colour_names, name) != colour_names.end();
      if (noted_.insert(name).second)
        all.notes.push_back(one.place + "not all meshes have values '" + name + "'; elsewhere they are " +
                            (colour ? "1" : "0"));
      return colour ? 1.0 : 0.0;
    };
    for (const Mesh::Values& values : from) {
      auto found = std::ranges::find(to, values.name, &Mesh::Values::name);
      if (found == to.end()) {
        to.push_back({values.name, {}, values.type});
        found = to.end() - 1;
        if (before > 0) found->values.assign(std::size_t(before), missing(values.name));
      }
      if (std::ssize(found->values) == before) append(values.values, found->values);
    }
    for (Mesh::Values& values : to)
      if (std::ssize(values.values) < after) values.values.resize(std::size_t(after), missing(values.name));
  }

  void add_channels(const UsdMesh& one, const Mesh& mesh) {
    const std::size_t corners = all.face_vertices.size(), before = corners - mesh.face_vertices.size();
    const auto fill = [&](std::size_t number) {
      const std::string& name = all.face_varying[number].name;
      if (noted_.insert(name).second)
        all.notes.push_back(one.place + "not all meshes have '" + name + "' at corners; elsewhere it is 0");
      Channel& channel = channels_[number];
      const Index zero = channel.num_values();
      channel.numbers.resize(channel.numbers.size() + std::size_t(channel.width), 0.0);
      return zero;
    };
    for (const Mesh::FaceVarying& from : mesh.face_varying) {
      const auto number = static_cast<std::size_t>(
          std::ranges::find(all.face_varying, from.name, &Mesh::FaceVarying::name) - all.face_varying.begin());
      if (number == all.face_varying.size()) {
        all.face_varying.push_back({from.name, {}, {}});
        channels_.push_back({from.values.cols(), {}});
        if (before > 0) all.face_varying[number].indices.assign(before, fill(number));
      }
      std::vector<Index>& indices = all.face_varying[number].indices;
      Channel& channel = channels_[number];
      if (channel.width != from.values.cols()) {
        all.warnings.push_back(one.place + "'" + from.name + "' has " + format_number(from.values.cols()) +
                               " numbers at a corner, not " + format_number(channel.width) +
                               " as elsewhere; it is left out");
        continue;
      }
      if (indices.size() != before) continue;  // two channels of one name
      const Index shift = checked_index(std::ssize(channel.numbers) / channel.width + from.values.rows(), one.place,
                                        "values at corners") -
                          static_cast<Index>(from.values.rows());
      add_rows(from.values, channel.numbers);
      for (const Index i : from.indices) indices.push_back(shift + i);
    }
    for (std::size_t number = 0; number < channels_.size(); ++number)
      if (std::vector<Index>& indices = all.face_varying[number].indices; indices.size() < corners)
        indices.resize(corners, fill(number));
  }

  std::string first_;
  ObjNames objects_, groups_, materials_, smoothing_;
  std::vector<double> positions_, normals_;
  bool has_normals_ = false;
  std::vector<Channel> channels_;
  std::unordered_set<std::string> noted_;
};

Mesh read_stage(UsdStage stage, const std::string& name) {
  std::vector<std::string> warnings;
  const std::vector<UsdMesh> meshes = usd_meshes(stage, warnings);
  if (meshes.empty()) {
    std::string why;
    for (const std::string& warning : warnings) why += "\n  " + warning;
    throw InvalidMesh(name + ": no Mesh prim with points that is seen" + why);
  }
  return merged(meshes, stage, std::move(warnings));
}

/// Names of materials by their paths: the last one of a path, or where two have the same the whole path.
std::unordered_map<std::string, std::string> material_names(const std::vector<UsdMesh>& meshes, UsdStage& stage) {
  std::unordered_map<std::string, std::string> names;
  const auto add = [&](const std::string& path) {
    if (!path.empty()) names.emplace(path, path.substr(path.rfind('/') + 1));
  };
  for (const UsdMesh& mesh : meshes) {
    add(mesh.material);
    for (const UsdSubset& subset : mesh.subsets) add(subset.material);
  }
  if (names.empty()) return names;
  stage.visit([&](const UsdPrim& prim) {
    if (const auto found = names.find(prim.path); found != names.end()) found->second = prim.shown_name();
    return true;
  });
  std::unordered_map<std::string, int> uses;
  for (const auto& [path, name] : names) ++uses[name];
  for (auto& [path, name] : names)
    if (uses[name] > 1) name = path.substr(1);
  return names;
}

}  // namespace

Mesh mesh_of(const UsdMesh& one, const std::function<std::string(const std::string&)>& name_of) {
  Mesh mesh = one.mesh;
  add_subsets(one, name_of, mesh);
  add_primvars(one, mesh);
  return mesh;
}

Mesh merged(const std::vector<UsdMesh>& meshes, UsdStage& stage, std::vector<std::string> warnings,
            const std::function<const Mesh*(const UsdMesh&)>& instead) {
  const auto names = material_names(meshes, stage);
  Merger merger;
  merger.all.warnings = std::move(warnings);
  const auto name_of = [&](const std::string& path) {
    const auto found = names.find(path);
    return found == names.end() ? path : found->second;
  };
  for (const UsdMesh& one : meshes) {
    const Mesh* const other = instead ? instead(one) : nullptr;
    Mesh mesh = other ? *other : mesh_of(one, name_of);
    if (other)
      for (std::string& name : mesh.materials.names) name = name_of(name);
    merger.add(one, std::move(mesh));
  }
  return merger.finish();
}

Mesh read_usd(const std::filesystem::path& path) { return read_stage(UsdStage(path), path.string()); }

UsdFrames read_usd_frames(const std::filesystem::path& path) {
  const auto stage = std::make_shared<UsdStage>(path);
  std::vector<std::string> none;
  std::vector<double> times;
  for (const UsdMesh& mesh : usd_meshes(*stage, none)) {
    times.insert(times.end(), mesh.times.begin(), mesh.times.end());
    times.insert(times.end(), mesh.transform_times.begin(), mesh.transform_times.end());
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return {std::max<std::int64_t>(std::ssize(times), 1), [stage, times](std::int64_t frame) {
            std::vector<std::string> told;
            const auto time = times.empty() ? std::nullopt : std::optional(times[std::size_t(frame)]);
            std::vector<double> numbers;
            for (const UsdMesh& mesh : usd_meshes(*stage, told, time)) {
              const Points points = in_world(mesh, mesh.mesh.positions);
              numbers.insert(numbers.end(), points.data(), points.data() + points.size());
            }
            Points all(std::ssize(numbers) / 3, 3);
            std::ranges::copy(numbers, all.data());
            return all;
          }};
}

Mesh parse_usd(std::string_view bytes, std::string_view name) {
  return read_stage(UsdStage(std::string(bytes), std::string(name)), std::string(name));
}

}  // namespace sublimit
