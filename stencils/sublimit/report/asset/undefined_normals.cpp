// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/undefined_normals.h"

#include "sublimit/report/asset/surface_places.h"
#include "sublimit/report/asset/warnings.h"

namespace sublimit::asset {

std::vector<AssetWarning> undefined_normals(const LimitMap& surface, const LimitSurface& bound,
                                            const Inventory& inventory, const Points& points, Index listed) {
  const Topology& t = surface.level().topology();
  using Severity = AssetWarning::Severity;
  WarningGroup degenerate(Severity::warning,
                          "the limit has no normal at this vertex: its control points make the tangents degenerate",
                          "move the points around it apart: several coincide, or lie in one line"),
      unknown(Severity::warning,
              "the limit has no normal at this vertex: its faces give it no tangent plane, or a degenerate one",
              "make the mesh a manifold there, or move the points around it apart");
  constexpr std::int64_t batch = 1 << 16;
  std::vector<Place> samples;
  std::vector<Index> vertices;
  LimitSamples s;
  Index last = -1;
  const auto flush = [&] {
    bound.evaluate(samples, 1, true, s);
    for (size_t i = 0; i < samples.size(); ++i)
      if (s.status[i] == LimitStatus::undefined_normal && vertices[i] != last)
        (inventory.vertices[size_t(vertices[i])].plane == PlaneVerdict::unknown ? unknown : degenerate)
            .add_vertex(last = vertices[i], points, listed);
    samples.clear();
    vertices.clear();
  };
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const VertexKind& kind = inventory.vertices[v];
    if (kind.what == VertexKind::What::in_hole || kind.plane == PlaneVerdict::no) continue;
    if (kind.plane == PlaneVerdict::unknown && kind.what == VertexKind::What::border) continue;
    for (const HalfEdge h : t.fans(Vertex{v})) {
      if (surface.level().holes[index(t.face(h))]) continue;
      samples.push_back(place_at(surface.addresses(), t, h, 0, 0));
      vertices.push_back(v);
    }
    if (std::int64_t(samples.size()) >= batch) flush();
  }
  flush();
  std::vector<AssetWarning> result;
  degenerate.put_into(result);
  unknown.put_into(result);
  return result;
}

}  // namespace sublimit::asset
