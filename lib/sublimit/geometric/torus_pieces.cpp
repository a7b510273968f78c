// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/torus_pieces.h"

#include <array>
#include <cmath>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/geometric/torus_edge.h"
#include "sublimit/splits/split.h"

namespace sublimit {
namespace {

/// How much better than the regular cut another one must be, relative to the perimeters: what is equal up to rounding
/// stays regular, so that turning a mesh changes nothing.
constexpr double better = 1e-9;

EdgePoint edge_point(const CurvatureMesh& mesh, const Topology& topology, Edge e) {
  std::array<const SurfacePoint*, 2> opposite;
  size_t count = 0;
  const HalfEdge first = topology.half_edge(e);
  for (const HalfEdge h : {first, topology.twin(first)})
    if (exists(h)) opposite[count++] = &mesh.points[index(topology.tail(topology.prev(h)))];
  return torus_edge(mesh.points[index(topology.tail(e))], mesh.points[index(topology.head(e))],
                    std::span(opposite).first(count));
}

/// The children of a face are three corners and a middle; cuts one corner and the middle along the other diagonal where
/// that is better.
void cut_by_perimeter(CurvatureMesh& mesh, Index* children) {
  const auto distance = [&](Index a, Index b) { return (mesh.points[a].position - mesh.points[b].position).norm(); };
  std::array<Index, 3> corner, opposite;  // child i has corner i first; the middle has the points opposite to them
  for (int i = 0; i < 3; ++i) {
    corner[i] = children[3 * i + i];
    opposite[i] = children[9 + i];
  }
  int best = -1;
  double least = std::numeric_limits<double>::infinity(), perimeter = 0;
  for (int i = 0; i < 3; ++i) {
    const Index p = corner[i], m = opposite[i], a = opposite[(i + 2) % 3], b = opposite[(i + 1) % 3];
    const double pa = distance(p, a), pb = distance(p, b), ma = distance(m, a), mb = distance(m, b);
    perimeter = std::max(perimeter, pa + pb + ma + mb);
    least = std::min(least, std::abs(pa + pb - ma - mb));  // the diagonal AB belongs to both parts
  }
  double limit = least - better * perimeter;
  for (int i = 0; i < 3; ++i) {
    const Index p = corner[i], m = opposite[i], a = opposite[(i + 2) % 3], b = opposite[(i + 1) % 3];
    const double difference = std::abs(distance(p, a) + distance(m, a) - distance(p, b) - distance(m, b));
    if (difference >= limit) continue;
    limit = difference;
    best = i;
  }
  if (best < 0) return;
  const Index p = corner[best], m = opposite[best], a = opposite[(best + 2) % 3], b = opposite[(best + 1) % 3];
  const std::array<Index, 3> first{p, a, m}, second{p, m, b};
  std::copy(first.begin(), first.end(), children + 3 * best);
  std::copy(second.begin(), second.end(), children + 9);
}

CurvatureMesh refined(const CurvatureMesh& mesh, bool by_perimeter) {
  const Topology topology(view(mesh));
  const double vertices = double(topology.num_vertices()) + topology.num_edges();
  check_memory("refined triangles, " + format_number(4.0 * topology.num_faces()) + " of them,",
               vertices * sizeof(SurfacePoint) + 4.0 * topology.num_faces() * 80, "use fewer levels");
  const Refinement refinement = refine(topology, Split::ptq);

  CurvatureMesh child;
  child.points = mesh.points;
  child.points.resize(refinement.topology.num_vertices());
  parallel_for_blocks(
      topology.num_edges(),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t e = begin; e < end; ++e)
          child.points[index(refinement.child(Edge(static_cast<Index>(e))))] =
              edge_point(mesh, topology, Edge(static_cast<Index>(e))).point;
      },
      64);
  child.triangles.resize(static_cast<size_t>(3) * refinement.topology.num_faces());
  for (Index f = 0; f < refinement.topology.num_faces(); ++f)
    std::ranges::copy(refinement.topology.vertices(Face{f}), child.triangles.begin() + 3 * std::ptrdiff_t{f});
  if (by_perimeter)
    for (Index f = 0; f < topology.num_faces(); ++f)
      cut_by_perimeter(child, child.triangles.data() + 12 * std::ptrdiff_t{f});
  child.original = mesh.original.empty() ? std::vector<bool>(mesh.points.size(), true) : mesh.original;
  child.original.resize(child.points.size(), false);
  return child;
}

std::vector<std::string> notes(const CurvatureMesh& mesh) {
  const Topology topology(view(mesh));
  Index count = 0, first = -1;
  for (Index e = 0; e < topology.num_edges(); ++e)
    if (edge_point(mesh, topology, Edge{e}).fell_back && ++count == 1) first = e;
  if (count == 0) return {};
  const Edge e{first};
  return {
      format_number(count) + " of " + format_number(topology.num_edges()) +
      " edges get the middle of their chord, flat: no torus piece fits their ends, whose normals cancel or run along "
      "the edge (the first is between vertices " +
      format_number(index(topology.tail(e))) + " and " + format_number(index(topology.head(e))) + ")"};
}

}  // namespace

GeometricSurfaceScheme torus_pieces(const SchemeOptions& options) {
  const OptionInfo cut{.name = "cut",
                       .values = {"regular", "perimeter"},
                       .meaning = "triangles in four, or by the diagonal of least difference of perimeters"};
  const bool by_perimeter = option(options, cut) == "perimeter";
  return {.name = "torus-pieces",
          .source = "Valasek 2008, diploma thesis, ELTE (slides), completed",
          .checked = [](CurvatureMesh mesh) { return checked(std::move(mesh)); },
          .refine = [by_perimeter](const CurvatureMesh& mesh) { return refined(mesh, by_perimeter); },
          .notes = notes,
          .claims = {.regular = std::nullopt,
                     .interpolates = true,
                     .reproduces = "planes, spheres, cylinders, tori",
                     .limit = "not known in closed form",
                     .exponent = "not known"},
          .options = {cut}};
}

}  // namespace sublimit
