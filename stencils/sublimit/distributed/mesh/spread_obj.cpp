// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/spread_readers.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit {
namespace {

/// A rule of the last rank that has it: the last one in the file wins.
template <class Rule>
void agree(const Ranks& ranks, std::optional<Rule>& rule) {
  const std::int64_t own = rule ? ranks.rank() * 16 + static_cast<int>(*rule) : -1;
  const std::int64_t last = ranks.largest(own);
  rule = last < 0 ? std::nullopt : std::optional(static_cast<Rule>(last % 16));
}

/// Texture coordinates, where every corner of every face has one.
void take_channel(const Ranks& ranks, Mesh& read, SpreadMesh& mesh, const std::string& name) {
  const std::vector<Mesh::FaceVarying>& channels = read.face_varying;
  const bool has_all = !channels.empty() && channels[0].indices.size() == read.face_vertices.size();
  if (!ranks.all(has_all || read.face_vertices.empty())) return;
  SpreadMesh::FaceVarying channel;
  const std::int64_t columns = ranks.largest(channels.empty() ? 0 : channels[0].values.cols());
  if (columns == 0) return;
  channel.name = "uv";
  channel.values.setZero(channels.empty() ? 0 : channels[0].values.rows(), columns);
  if (!channels.empty()) {
    channel.values.leftCols(channels[0].values.cols()) = channels[0].values;
    channel.indices.assign(channels[0].indices.begin(), channels[0].indices.end());
  }
  channel.runs = Runs(ranks, channel.values.rows());
  ranks.together([&] {
    for (const std::int64_t i : channel.indices)
      if (i < 0 || i >= channel.runs.size())
        throw InvalidMesh(fmt::format("{}: texture coordinate {} is out of range; there are {}, 1 to {}", name, i + 1,
                                      channel.runs.size(), channel.runs.size()));
  });
  mesh.face_varying = std::move(channel);
}

/// Where the line begins that a byte is in: behind a line end that no backslash takes back.
std::size_t line_begin(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size()) {
    const std::size_t end = text.find('\n', at - 1);
    if (end == std::string_view::npos) return text.size();
    std::size_t before = end;
    while (before > 0 && std::string_view(" \t\v\f\r").find(text[before - 1]) != std::string_view::npos) --before;
    if (before == 0 || text[before - 1] != '\\') return end + 1;
    at = end + 2;
  }
  return std::min(at, text.size());
}

}  // namespace

SpreadMesh read_obj_parts(const Ranks& ranks, std::string_view text, const std::string& name) {
  const auto cut = [&](int rank) {
    return line_begin(text, text.size() / size_t(ranks.size()) * size_t(rank) +
                                text.size() % size_t(ranks.size()) * size_t(rank) / size_t(ranks.size()));
  };
  const std::size_t begin = cut(ranks.rank()),
                    end = ranks.rank() + 1 == ranks.size() ? text.size() : cut(ranks.rank() + 1);
  const std::string_view part = text.substr(begin, end - begin);
  ObjCounts own;
  ranks.together([&] {
    constexpr double bytes_of_face = 120;  // at least, with its vertex
    check_room(ranks, double(text.size()) / bytes_of_face, name);
    if (part.find('\0') != std::string_view::npos) throw FormatError(name + ": not a text OBJ file");
    own = count_obj(part);
  });
  const ObjCounts before{ranks.sum_before(own.lines), ranks.sum_before(own.vertices),
                         ranks.sum_before(own.texture_coordinates), ranks.sum_before(own.faces)};
  Mesh read;
  ranks.together([&] { read = parse_obj_part(part, name, before); });
  SpreadMesh mesh;
  mesh.vertices = Runs(ranks, read.num_vertices());
  mesh.faces = Runs(ranks, read.num_faces());
  mesh.positions = std::move(read.positions);
  mesh.face_sizes = std::move(read.face_sizes);
  mesh.face_vertices.assign(read.face_vertices.begin(), read.face_vertices.end());
  take_channel(ranks, read, mesh, name);
  const bool has_names =
      !read.face_names().of_face.empty() || !read.materials.of_face.empty() || !read.smoothing_groups.of_face.empty();
  take_tags(ranks, read, mesh);
  if (!ranks.all(!has_names) && ranks.is_first())
    mesh.about.warnings.push_back(name + ": names of faces are left out; `sublimit refine` keeps them");
  agree(ranks, mesh.about.boundary);
  agree(ranks, mesh.about.creasing);
  agree(ranks, mesh.about.triangles);
  agree(ranks, mesh.about.face_varying_interpolation);
  const bool knots = !ranks.all(read.knot_intervals.empty());
  ranks.together([&] {
    if (knots)
      throw InvalidMesh(name + ": knot intervals are those of strips of faces, which no part sees to their ends");
  });
  return mesh;
}

}  // namespace sublimit
