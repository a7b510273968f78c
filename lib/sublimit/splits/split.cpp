// SPDX-License-Identifier: Apache-2.0
#include "sublimit/splits/split.h"

#include <algorithm>
#include <limits>
#include <string>

#include "sublimit/base/detail/huge_pages.h"
#include "sublimit/base/detail/interruption.h"
#include "sublimit/base/error.h"
#include "sublimit/splits/detail/primal.h"
#include "sublimit/splits/detail/sheets.h"

namespace sublimit {

const char* name(Split split) {
  switch (split) {
    case Split::pqq:
      return "pqq";
    case Split::ptq:
      return "ptq";
    case Split::dqq:
      return "dqq";
    case Split::mid_edge:
      return "mid-edge";
    case Split::sqrt3:
      return "sqrt3";
    case Split::dual:
      return "dual";
    case Split::quads:
      return "quads";
    default:
      return "keep";
  }
}

std::int64_t num_child_half_edges(const Topology& parent, Split split) {
  const std::int64_t corners = parent.num_half_edges(), edges = parent.num_edges();
  switch (split) {
    case Split::sqrt3:
      return 3 * (corners + 4 * std::max<std::int64_t>(0, 2 * edges - corners));
    case Split::mid_edge:
      return 2 * corners + 4 * std::max<std::int64_t>(0, 2 * edges - corners);
    case Split::dual:
    case Split::keep:
      return corners + 2 * std::max<std::int64_t>(0, 2 * edges - corners);
    case Split::quads:
      return 4 * std::max(edges, corners - edges);
    case Split::dqq:
      return 2 * corners + 4 * std::max(edges, corners - edges) + 2 * std::max<std::int64_t>(0, 2 * edges - corners);
    default:
      return 4 * corners;  // pqq: a quad per corner; ptq: four triangles per three corners
  }
}

void check_triangles(const Topology& t) {
  if (t.num_faces() == 0 || t.uniform_face_size() == 3) return;
  Index f = 0;
  while (t.size(Face{f}) == 3) ++f;
  throw UnsupportedTopology("face " + std::to_string(f) + " has " + std::to_string(t.size(Face{f})) +
                            " corners; this scheme takes triangles only: triangulate the mesh or use a scheme for "
                            "polygons, catmull-clark for one");
}

namespace {

void check_size(const Topology& parent, Split split) {
  const std::int64_t count = num_child_half_edges(parent, split);
  if (count > std::numeric_limits<Index>::max())
    throw ResourceError(
        "the next level has " + std::to_string(count) + " face corners, more than 32-bit indices count (" +
        std::to_string(std::numeric_limits<Index>::max()) + "); use fewer levels or refine fewer faces");
}

}  // namespace

Refinement numbering(const Topology& parent, Split split) {
  check_size(parent, split);
  return split == Split::ptq ? ptq_numbering(parent) : pqq_numbering(parent);
}

std::vector<Index> child_corners(const Topology& parent, const Refinement& numbering) {
  std::vector<Index> corners;
  corners.reserve(size_t(num_child_half_edges(parent, numbering.split)));
  prefer_huge_pages(corners.data(), corners.capacity() * sizeof(Index));
  for (const size_t all = corners.capacity(); corners.size() < all;) {
    check_interruption();  // the kernel takes its time to hand out what may be gigabytes
    corners.resize(std::min(all, corners.size() + (size_t{1} << 22)));
  }
  numbering.split == Split::ptq ? set_ptq_corners(parent, numbering, corners)
                                : set_pqq_corners(parent, numbering, corners);
  return corners;
}

Refinement refine(const Topology& parent, Split split, int level) {
  check_size(parent, split);
  switch (split) {
    case Split::pqq:
      return refine_pqq(parent);
    case Split::ptq:
      return refine_ptq(parent);
    case Split::dqq:
      return refine_dqq(parent);
    case Split::mid_edge:
      return refine_mid_edge(parent, level);
    case Split::sqrt3:
      return refine_sqrt3(parent, level);
    case Split::dual:
      return refine_dual(parent);
    case Split::quads:
      return refine_quads(parent);
    default:
      return refine_keep(parent);
  }
}

std::pair<HalfEdge, HalfEdge> Refinement::halves(const Topology& parent, HalfEdge h) const {
  return split == Split::ptq ? ptq_halves(parent, h) : pqq_halves(parent, h);
}

std::vector<bool> refine_holes(const std::vector<bool>& holes, const Topology& parent, const Refinement& r) {
  std::vector<bool> result(r.topology.num_faces(), false);
  if (std::find(holes.begin(), holes.end(), true) == holes.end()) return result;
  for (Index f = 0; f < r.topology.num_faces(); ++f) {
    const Index face = r.face_parent[f];
    result[f] = holes[face];
    if (!result[f] || r.split == Split::pqq || r.split == Split::ptq || r.split == Split::keep) continue;
    if (r.split != Split::sqrt3 && f < r.faces_from_faces) continue;
    // Between holes and the rest: part of the limit. The corners of a face from an edge or vertex know their faces.
    for (const Index v : r.topology.vertices(Face{f})) {
      const Refinement::Origin origin = r.origin(Vertex{v});
      const Index p = r.parent(Vertex{v});
      if (origin == Refinement::Origin::face) result[f] = result[f] && holes[p];
      if (origin == Refinement::Origin::corner || origin == Refinement::Origin::border)
        result[f] = result[f] && holes[index(parent.face(HalfEdge{p}))];
      if (origin == Refinement::Origin::edge)
        for (const HalfEdge h : parent.half_edges(Edge{p})) result[f] = result[f] && holes[index(parent.face(h))];
    }
  }
  return result;
}

}  // namespace sublimit
