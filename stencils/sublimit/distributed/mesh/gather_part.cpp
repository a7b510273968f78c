// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/mesh/gather_part.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Int = std::int64_t;

std::vector<Int> without(const std::vector<Int>& all, const std::vector<Int>& known) {
  std::vector<Int> rest;
  std::ranges::set_difference(all, known, std::back_inserter(rest));
  return rest;
}

std::vector<Int> together_sorted(const std::vector<Int>& a, const std::vector<Int>& b) {
  std::vector<Int> both;
  both.reserve(a.size() + b.size());
  std::ranges::merge(a, b, std::back_inserter(both));
  return both;
}

/// Faces and their corners, asked for ring by ring.
class GrowingPart {
 public:
  GrowingPart(const Ranks& ranks, const SpreadMesh& mesh) : ranks_(ranks), mesh_(mesh) {
    Int at = 0;
    for (const std::int32_t size : mesh.face_sizes) corners_.begins.push_back(at += size);
  }

  void add_faces(const std::vector<Int>& added) {
    const Lists lists = fetch_lists(ranks_, mesh_.faces, added, [&](Int f) {
      const Int own = f - mesh_.faces.begin(ranks_.rank());
      const auto begin = size_t(corners_.begins[size_t(own)]);
      return std::span(mesh_.face_vertices).subspan(begin, size_t(corners_.begins[size_t(own) + 1]) - begin);
    });
    std::vector<Int> vertices = lists.items;
    sort_unique(vertices);
    new_vertices = without(vertices, all_vertices);
    all_vertices = together_sorted(all_vertices, new_vertices);
    merge(added, lists);
  }

  std::vector<Int> all_faces, all_vertices, new_vertices;
  Lists face_vertices;  // of all faces

 private:
  void merge(const std::vector<Int>& added, const Lists& lists) {
    Lists merged;
    merged.items.reserve(face_vertices.items.size() + lists.items.size());
    size_t i = 0, j = 0;
    while (i < all_faces.size() || j < added.size()) {
      const bool old = j == added.size() || (i < all_faces.size() && all_faces[i] < added[j]);
      const std::span<const Int> list = old ? face_vertices[Int(i++)] : lists[Int(j++)];
      merged.items.insert(merged.items.end(), list.begin(), list.end());
      merged.begins.push_back(std::ssize(merged.items));
    }
    face_vertices = std::move(merged);
    all_faces = together_sorted(all_faces, added);
  }

  const Ranks& ranks_;
  const SpreadMesh& mesh_;
  Lists corners_;  // where those of the own run begin
};

Index position(const std::vector<Int>& sorted, Int number) {
  return static_cast<Index>(std::ranges::lower_bound(sorted, number) - sorted.begin());
}

/// Values of the corners of all faces of the part, each once, in the order of the whole.
void fetch_channel(const Ranks& ranks, const SpreadMesh& spread, MeshPart& part) {
  const SpreadMesh::FaceVarying& channel = *spread.face_varying;
  std::vector<Int> begins{0};
  for (const std::int32_t size : spread.face_sizes) begins.push_back(begins.back() + size);
  const Int first_face = spread.faces.begin(ranks.rank()), first = channel.runs.begin(ranks.rank());
  const Lists corners = fetch_lists(ranks, spread.faces, part.faces, [&](Int f) {
    const auto begin = size_t(begins[size_t(f - first_face)]);
    return std::span(channel.indices).subspan(begin, size_t(begins[size_t(f - first_face) + 1]) - begin);
  });
  std::vector<Int> numbers = corners.items;
  sort_unique(numbers);
  using Row = std::array<double, 3>;
  const auto columns = channel.values.cols();
  const std::vector<Row> rows = fetch<Row>(ranks, channel.runs, numbers, [&](Int i) {
    Row row{};
    for (Eigen::Index c = 0; c < columns; ++c) row[size_t(c)] = channel.values(i - first, c);
    return row;
  });
  Mesh::FaceVarying own{channel.name, Points(Eigen::Index(rows.size()), columns), {}};
  for (size_t i = 0; i < rows.size(); ++i)
    for (Eigen::Index c = 0; c < columns; ++c) own.values(Eigen::Index(i), c) = rows[i][size_t(c)];
  for (const Int i : corners.items) own.indices.push_back(position(numbers, i));
  part.mesh.face_varying = {std::move(own)};
  part.mesh.face_varying_interpolation = spread.about.face_varying_interpolation;
}

float sharpness(Int bits) { return std::bit_cast<float>(static_cast<std::int32_t>(bits)); }

void fetch_tags(const Ranks& ranks, const SpreadMesh& spread, const Incidence& incidence, MeshPart& part) {
  const Int first = spread.vertices.begin(ranks.rank());
  Mesh& mesh = part.mesh;
  if (incidence.has_creases) {
    const Lists creases =
        fetch_lists(ranks, spread.vertices, part.vertices, [&](Int v) { return incidence.creases[v - first]; });
    std::vector<std::pair<Index, Index>> edges;  // both ends may be there, and the edge be one of faces that are not
    const Index* corner = mesh.face_vertices.data();
    for (const Index size : mesh.face_sizes) {
      for (Index k = 0; k < size && !creases.items.empty(); ++k)
        edges.push_back(std::minmax(corner[k], corner[(k + 1) % size]));
      corner += size;
    }
    std::ranges::sort(edges);
    for (Int v = 0; v < creases.size(); ++v)
      for (size_t i = 0; i < creases[v].size(); i += 2) {
        const Index head = position(part.vertices, creases[v][i]);
        if (size_t(head) < part.vertices.size() && part.vertices[size_t(head)] == creases[v][i] &&
            std::ranges::binary_search(edges, std::pair(static_cast<Index>(v), head)))
          mesh.creases.push_back({static_cast<Index>(v), head, sharpness(creases[v][i + 1])});
      }
  }
  if (incidence.has_corners) {
    const Lists corners =
        fetch_lists(ranks, spread.vertices, part.vertices, [&](Int v) { return incidence.corners[v - first]; });
    for (Int v = 0; v < corners.size(); ++v)
      for (const Int bits : corners[v]) mesh.corners.push_back({static_cast<Index>(v), sharpness(bits)});
  }
  if (incidence.has_holes) {
    const Int first_face = spread.faces.begin(ranks.rank());
    const auto holes =
        fetch<char>(ranks, spread.faces, part.faces, [&](Int f) { return incidence.is_hole[size_t(f - first_face)]; });
    for (size_t f = 0; f < holes.size(); ++f)
      if (holes[f]) mesh.holes.push_back(static_cast<Index>(f));
  }
}

}  // namespace

MeshPart gather_part(const Ranks& ranks, const SpreadMesh& spread, const Incidence& incidence,
                     std::span<const Int> owned, int rings, bool isolated) {
  GrowingPart growing(ranks, spread);
  growing.add_faces({owned.begin(), owned.end()});
  const Int first = spread.vertices.begin(ranks.rank());
  for (int ring = 0; ring < rings; ++ring) {
    Lists faces =
        fetch_lists(ranks, spread.vertices, growing.new_vertices, [&](Int v) { return incidence.faces[v - first]; });
    sort_unique(faces.items);
    growing.add_faces(without(faces.items, growing.all_faces));
  }
  std::vector<std::vector<Int>> to(size_t(ranks.size()));
  const std::vector<Int> takes = ranks.each(isolated);
  for (size_t r = 0; r < to.size(); ++r)
    if (takes[r]) to[r] = incidence.isolated;
  for (const std::vector<Int>& from : exchange(ranks, std::move(to)))
    growing.all_vertices = together_sorted(growing.all_vertices, from);

  MeshPart part;
  part.vertices = std::move(growing.all_vertices), part.faces = std::move(growing.all_faces);
  Mesh& mesh = part.mesh;
  mesh.boundary = spread.about.boundary, mesh.creasing = spread.about.creasing, mesh.triangles = spread.about.triangles;
  ranks.together([&] {
    constexpr Int most = std::numeric_limits<Index>::max();
    if (std::ssize(growing.face_vertices.items) > most || std::ssize(part.vertices) > most)
      throw ResourceError("a part has more corners of faces than 32-bit indices count; use more ranks or shards");
  });
  using Row = std::array<double, 3>;
  const std::vector<Row> rows = fetch<Row>(ranks, spread.vertices, part.vertices, [&](Int v) {
    return Row{spread.positions(v - first, 0), spread.positions(v - first, 1), spread.positions(v - first, 2)};
  });
  mesh.positions.resize(Eigen::Index(rows.size()), 3);
  for (size_t v = 0; v < rows.size(); ++v) mesh.positions.row(Eigen::Index(v)) << rows[v][0], rows[v][1], rows[v][2];
  mesh.face_vertices.reserve(growing.face_vertices.items.size());
  for (Int f = 0; f < growing.face_vertices.size(); ++f) {
    mesh.face_sizes.push_back(static_cast<Index>(growing.face_vertices[f].size()));
    for (const Int v : growing.face_vertices[f]) mesh.face_vertices.push_back(position(part.vertices, v));
  }
  part.is_owned.assign(part.faces.size(), false);
  for (const Int f : owned) part.is_owned[size_t(position(part.faces, f))] = true;
  fetch_tags(ranks, spread, incidence, part);
  if (spread.face_varying) fetch_channel(ranks, spread, part);
  return part;
}

}  // namespace sublimit
