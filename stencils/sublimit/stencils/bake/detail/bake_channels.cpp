// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/bake_channels.h"

#include <cassert>

#include "sublimit/base/detail/memory.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/stencils/bake/detail/lattice_cells.h"
#include "sublimit/stencils/formats/rule_of_word.h"

namespace sublimit {
namespace {

/// First half-edges of the faces of the last level, as the table has them.
std::vector<HalfEdge> faces_in_order(const std::vector<Level>& levels, std::span<const std::int8_t> turn,
                                     const BakedTable<double>& table) {
  const Level& last = levels.back();
  std::vector<HalfEdge> faces;
  if (table.lattices) {
    const Lattice& lattice = table.lattices->lattice();
    size_t steps = 0;
    while (Index{1} << steps < lattice.n) ++steps;
    const std::span<const Level> descent = std::span(levels).last(steps + 1);
    faces = lattice_cells(descent, lattice.triangle, turn);
  } else {
    for (Index f = 0; f < last.topology().num_faces(); ++f) faces.push_back(last.topology().first(Face{f}));
  }
  std::erase_if(faces, [&](HalfEdge h) { return last.holes[index(last.topology().face(h))]; });
  return faces;
}

/// Corners of these faces, one after the other.
std::vector<HalfEdge> corners_of(const Topology& t, std::span<const HalfEdge> faces) {
  std::vector<HalfEdge> corners;
  corners.reserve(faces.size() * 4);
  for (const HalfEdge first : faces) {
    HalfEdge h = first;
    do corners.push_back(h);
    while ((h = t.next(h)) != first);
  }
  return corners;
}

FaceVaryingValues refined_values(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                 const Mesh::FaceVarying& given, const std::vector<Level>& levels, bool limit,
                                 std::span<const HalfEdge> corners) {
  const std::vector<FaceVaryingLevel> channel = refine_face_varying(scheme, interpolation, given, levels);
  Points values = refined_values(channel, given.values);
  if (limit) {
    LimitCache cache(face_varying_scheme(scheme, interpolation));
    values = apply(limit_matrices(channel.back().level, cache).position, values);
  }
  const Topology& t = channel.back().level.topology();
  std::vector<std::int32_t> indices;
  indices.reserve(corners.size());
  for (const HalfEdge h : corners) indices.push_back(index(t.tail(h)));
  return {.name = given.name,
          .channels = static_cast<std::int32_t>(values.cols()),
          .values = std::vector<double>(values.data(), values.data() + values.size()),
          .indices = std::move(indices)};
}

TableTags tags_left(const Level& level, const Mesh& mesh, const SubdivisionOptions& options,
                    std::span<const HalfEdge> corners, const FaceList& faces) {
  const Topology& t = level.topology();
  // Of holes there are no points, or none that a face joins.
  std::vector<std::int32_t> point(t.num_vertices(), -1);
  std::vector<bool> is_there(t.num_edges());
  assert(corners.size() == faces.corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    point[index(t.tail(corners[i]))] = faces.corners[i];
    is_there[index(t.edge(corners[i]))] = true;
  }
  const RemainingTags left = remaining_tags(level, mesh, options);
  std::vector<std::int32_t> creases, at;
  std::vector<float> crease_sharpness, corner_sharpness;
  for (const Edge e : left.creases) {
    if (!is_there[index(e)]) continue;
    creases.insert(creases.end(), {point[index(t.tail(e))], point[index(t.head(e))]});
    crease_sharpness.push_back(level.sharpness.edge[index(e)]);
  }
  for (const Vertex v : left.corners) {
    if (point[index(v)] < 0) continue;
    at.push_back(point[index(v)]);
    corner_sharpness.push_back(level.sharpness.vertex[index(v)]);
  }
  return {.creases = std::move(creases),
          .crease_sharpness = std::move(crease_sharpness),
          .corners = std::move(at),
          .corner_sharpness = std::move(corner_sharpness),
          .boundary = word(left.boundary),
          .creasing = word(level.sharpness.creasing)};
}

}  // namespace

FaceVaryingInterpolation interpolation_of(const BakeRequest& request, const Mesh& mesh) {
  return request.face_varying_interpolation.value_or(
      mesh.face_varying_interpolation.value_or(FaceVaryingInterpolation::all));
}

double predicted_channel_bytes(const Scheme<double>& scheme, const Topology& control, const Mesh& mesh,
                               const BakeRequest& request) {
  if (!needs_refined_mesh(request)) return 0;
  const double channels = request.face_varying ? double(mesh.face_varying.size()) : 0;
  return (1 + channels) * predicted_bytes(scheme, control, request.level);
}

void add_channels(const Scheme<double>& scheme, const Mesh& mesh, const Level& control, const BakeRequest& request,
                  const SubdivisionOptions& options, std::span<const std::int8_t> turn, BakedTable<double>& table) {
  const std::vector<Level> levels = refine(scheme, control, request.level);
  check_memory("face-varying channels and tags of level " + std::to_string(request.level),
               predicted_channel_bytes(scheme, levels[0].topology(), mesh, request) -
                   predicted_bytes(scheme, levels[0].topology(), request.level),
               "use fewer levels, or leave them out");
  const Topology& t = levels.back().topology();
  const std::vector<HalfEdge> corners = corners_of(t, faces_in_order(levels, turn, table));
  if (request.face_varying && !corners.empty() && !mesh.face_varying.empty()) {
    const FaceVaryingInterpolation interpolation = interpolation_of(request, mesh);
    table.channels.interpolation = word(interpolation);
    for (const Mesh::FaceVarying& given : mesh.face_varying)
      table.channels.list.push_back(
          refined_values(scheme, interpolation, given, levels, request.rows == TableRows::limit, corners));
  }
  if (request.tags) table.tags = tags_left(levels.back(), mesh, options, corners, faces_of(table));
  if (!request.order) return;
  const FaceList faces = faces_of(table);
  assert(corners.size() == faces.corners.size());
  std::vector<std::int64_t> points(size_t(t.num_vertices()), -1);
  for (size_t i = 0; i < corners.size(); ++i) points[size_t(index(t.tail(corners[i])))] = faces.corners[i];
  table.refined_points = std::move(points);
}

}  // namespace sublimit
