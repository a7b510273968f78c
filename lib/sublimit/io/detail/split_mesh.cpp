// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/split_mesh.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sublimit {
namespace {

constexpr double same_normal = 1 - 5e-9;  // cosine of 1e-4

/// Vertices as they are met, those of one source as a list.
class Variants {
 public:
  struct Variant {
    Index source, value, normal, corner, next;
  };
  Variants(Index vertices, const Points& normals) : first_(size_t(vertices), -1), normals_(normals) {}
  Index number(Index source, Index value, Index normal, Index corner) {
    Index* link = &first_[size_t(source)];
    for (; *link >= 0; link = &all_[size_t(*link)].next) {
      const Variant& known = all_[size_t(*link)];
      if (known.value == value && is_same(known.normal, normal)) return *link;
    }
    const Index made = *link = static_cast<Index>(all_.size());
    all_.push_back({source, value, normal, corner, -1});
    return made;
  }
  /// The first corner with the normal of a variant, or -1 where its source has one normal.
  Index side(const Variant& v) const {
    Index first = -1;
    bool is_one = true;
    for (Index k = first_[size_t(v.source)]; k >= 0; k = all_[size_t(k)].next) {
      const bool same = is_same(all_[size_t(k)].normal, v.normal);
      if (same && first < 0) first = all_[size_t(k)].corner;
      is_one = is_one && same;
    }
    return is_one ? -1 : first;
  }
  const std::vector<Variant>& all() const { return all_; }

 private:
  bool is_same(Index a, Index b) const {
    return a == b || (a >= 0 && b >= 0 && normals_.row(a).dot(normals_.row(b)) >= same_normal);
  }
  std::vector<Index> first_;
  const Points& normals_;
  std::vector<Variant> all_;
};

}  // namespace

SplitVertices split_vertices(const Mesh& mesh, const Mesh::FaceVarying* channel) {
  Variants variants(static_cast<Index>(mesh.positions.rows()), mesh.normals);
  SplitVertices split;
  split.corners.reserve(mesh.face_vertices.size());
  for (size_t c = 0; c < mesh.face_vertices.size(); ++c)
    split.corners.push_back(variants.number(mesh.face_vertices[c], channel ? channel->indices[c] : -1,
                                            mesh.face_normals.empty() ? -1 : mesh.face_normals[c],
                                            static_cast<Index>(c)));
  std::vector<Index> order(variants.all().size()), place(order.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index i) { return variants.all()[size_t(i)].source; });
  for (size_t k = 0; k < order.size(); ++k) place[size_t(order[k])] = static_cast<Index>(k);
  for (Index& corner : split.corners) corner = place[size_t(corner)];
  split.vertices.reserve(order.size());
  for (const Index i : order) {
    const Variants::Variant& v = variants.all()[size_t(i)];
    split.vertices.push_back({v.source, v.value, v.normal, v.corner, variants.side(v)});
  }
  return split;
}

SplitMesh split_mesh(Mesh mesh) {
  const bool per_corner = !mesh.face_normals.empty(), has_values = !mesh.face_varying.empty();
  SplitVertices vertices = split_vertices(mesh, has_values ? mesh.face_varying.data() : nullptr);

  SplitMesh split;
  split.mesh = mesh;
  Mesh& out = split.mesh;
  out.face_normals.clear();
  out.face_varying.clear();
  out.face_vertices = std::move(vertices.corners);
  const auto count = std::ssize(vertices.vertices);
  out.positions.resize(count, 3);
  out.normals.resize(mesh.normals.rows() > 0 ? count : 0, 3);
  out.texture = Points::Zero(has_values ? count : 0, 2);
  for (Mesh::Values& one : out.vertex_values) one.values.clear();
  for (Eigen::Index k = 0; k < count; ++k) {
    const SplitVertices::Vertex& v = vertices.vertices[size_t(k)];
    split.sources.push_back(v.source);
    split.sides.push_back(v.side);
    out.positions.row(k) = mesh.positions.row(v.source);
    for (size_t i = 0; i < out.vertex_values.size(); ++i)
      out.vertex_values[i].values.push_back(mesh.vertex_values[i].values[size_t(v.source)]);
    if (mesh.normals.rows() > 0) out.normals.row(k) = mesh.normals.row(per_corner ? v.normal : v.source);
    if (!has_values) continue;
    const Points& values = mesh.face_varying[0].values;
    const Eigen::Index columns = std::min<Eigen::Index>(2, values.cols());
    out.texture.row(k).head(columns) = values.row(v.value).head(columns);
  }
  return split;
}

}  // namespace sublimit
