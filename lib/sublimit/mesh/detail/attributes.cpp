// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/detail/attributes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr std::array<Mesh::FaceNames Mesh::*, 4> kinds_of_names{&Mesh::groups, &Mesh::objects, &Mesh::materials,
                                                                &Mesh::smoothing_groups};

template <class T>
std::vector<T> picked(const std::vector<T>& from, std::span<const Index> parents) {
  std::vector<T> result;
  if (from.empty()) return result;
  result.reserve(parents.size());
  for (const Index f : parents) result.push_back(from[static_cast<size_t>(f)]);
  return result;
}

void check_values(const std::vector<Mesh::Values>& all, size_t count, const char* of) {
  for (const Mesh::Values& one : all)
    if (one.values.size() != count)
      throw InvalidMesh("value '" + one.name + "' has " + std::to_string(one.values.size()) + " numbers for " +
                        std::to_string(count) + " " + of);
}

}  // namespace

std::optional<std::array<Index, 4>> find_colours(const std::vector<Mesh::Values>& values) {
  std::array<Index, 4> found{-1, -1, -1, -1};
  for (size_t i = 0; i < values.size(); ++i)
    for (size_t k = 0; k < found.size(); ++k)
      if (values[i].name == colour_names[k]) found[k] = static_cast<Index>(i);
  if (found[0] < 0 || found[1] < 0 || found[2] < 0) return std::nullopt;
  return found;
}

bool has_face_attributes(const Mesh& mesh) {
  if (mesh.attributes == Attributes::drop) return false;
  return !mesh.face_values.empty() || !mesh.material_files.empty() ||
         std::ranges::any_of(kinds_of_names, [&](const auto kind) { return !(mesh.*kind).of_face.empty(); });
}

void carry_faces(const Mesh& from, std::span<const Index> parents, Mesh& to) {
  if (from.attributes == Attributes::drop) return;
  check_attributes(from);
  for (const auto kind : kinds_of_names)
    to.*kind = {(from.*kind).of_face.empty() ? std::vector<std::string>{} : (from.*kind).names,
                picked((from.*kind).of_face, parents)};
  to.face_values.clear();
  for (const Mesh::Values& one : from.face_values)
    to.face_values.push_back({one.name, picked(one.values, parents), one.type});
  to.material_files = from.material_files;
}

void carry_faces(const Mesh& from, Mesh& to) {
  std::vector<Index> same(static_cast<size_t>(from.num_faces()));
  std::iota(same.begin(), same.end(), 0);
  carry_faces(from, same, to);
}

Points vertex_values(const Mesh& mesh) {
  check_attributes(mesh);
  const bool none = mesh.attributes == Attributes::drop;
  Points columns(mesh.num_vertices(), none ? 0 : std::ssize(mesh.vertex_values));
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    for (Eigen::Index v = 0; v < columns.rows(); ++v)
      columns(v, k) = mesh.vertex_values[static_cast<size_t>(k)].values[static_cast<size_t>(v)];
  return columns;
}

void set_vertex_values(Mesh& to, const Mesh& named, const Points& columns) {
  to.vertex_values.clear();
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const Mesh::Values& as = named.vertex_values[static_cast<size_t>(k)];
    const auto column = columns.col(k);
    to.vertex_values.push_back({as.name, {column.begin(), column.end()}, as.type});
  }
}

void check_attributes(const Mesh& mesh) {
  for (const auto kind : kinds_of_names) {
    const Mesh::FaceNames& names = mesh.*kind;
    if (!names.of_face.empty() && names.of_face.size() != mesh.face_sizes.size())
      throw InvalidMesh(std::to_string(names.of_face.size()) + " faces have names; all of the " +
                        std::to_string(mesh.face_sizes.size()) + " should, or none");
    for (const Index name : names.of_face)
      if (name < -1 || name >= std::ssize(names.names))
        throw InvalidMesh("a face has the name number " + std::to_string(name) + "; there are " +
                          std::to_string(names.names.size()) + ", from 0, and -1 is none");
  }
  check_values(mesh.vertex_values, static_cast<size_t>(mesh.num_vertices()), "vertices");
  check_values(mesh.face_values, static_cast<size_t>(mesh.num_faces()), "faces");
}

}  // namespace sublimit
