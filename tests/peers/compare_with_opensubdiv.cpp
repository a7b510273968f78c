// SPDX-License-Identifier: Apache-2.0
#include "peers/compare_with_opensubdiv.h"

#include <algorithm>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

std::string at_level(int k) { return "level " + std::to_string(k) + ": "; }

/// Faces, holes and sharpness of one level; empty if all agree.
std::string differences(const Level& ours, const ReferenceLevel& theirs, const std::vector<Index>& vertex_map,
                        const std::vector<Index>& face_map) {
  const Topology& t = ours.topology();
  std::vector<Index> first_corner{0};
  for (const Index size : theirs.face_sizes) first_corner.push_back(first_corner.back() + size);
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Index g = face_map[f];
    const std::string where = "face " + std::to_string(f) + " ";
    if (t.size(Face{f}) != theirs.face_sizes[g]) return where + "has another size";
    if (bool(ours.holes[f]) != bool(theirs.face_hole[g])) return where + "differs in being a hole";
    for (Index k = 0; k < t.size(Face{f}); ++k) {
      if (vertex_map[t.vertices(Face{f})[k]] != theirs.face_vertices[first_corner[g] + k])
        return where + "has other vertices";
      const float s = ours.sharpness.edge[index(t.edge(t.corner(Face{f}, k)))];
      const float r = theirs.corner_edge_sharpness[first_corner[g] + k];
      if (s != r && !(is_infinite(s) && is_infinite(r)))
        return where + "edge " + std::to_string(k) + " is " + std::to_string(s) + " sharp, not " + std::to_string(r);
    }
  }
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const float s = ours.sharpness.vertex[v], r = theirs.vertex_sharpness[vertex_map[v]];
    if (s != r && !(is_infinite(s) && is_infinite(r)))
      return "vertex " + std::to_string(v) + " is " + std::to_string(s) + " sharp, not " + std::to_string(r);
  }
  return {};
}

}  // namespace

Scheme<double> scheme_for(const Mesh& mesh, const std::string& name) {
  SchemeOptions options;
  if (name == "catmull-clark" && mesh.triangles == Triangles::smooth) options["triangles"] = "smooth";
  return find_scheme(name, options).value();
}

Comparison compare_with_opensubdiv(const Mesh& mesh, const std::string& scheme_name, int levels) {
  Comparison result;
  const std::vector<ReferenceLevel> expected_levels =
      reference_refine(mesh, reference_options(mesh, scheme_name, levels));
  const Scheme<double> scheme = scheme_for(mesh, scheme_name);
  const std::vector<Level> refined = refine(scheme, mesh, levels);
  const double size = diagonal(mesh.positions);

  Points x = mesh.positions;
  std::vector<Index> vertex_map(mesh.num_vertices()), face_map(mesh.num_faces());
  for (Index v = 0; v < mesh.num_vertices(); ++v) vertex_map[v] = v;
  for (Index f = 0; f < mesh.num_faces(); ++f) face_map[f] = f;
  for (int k = 0; k <= levels; ++k) {
    const Topology& t = refined[k].topology();
    const ReferenceLevel& theirs = expected_levels[k];
    if (t.num_vertices() != theirs.num_vertices() || t.num_faces() != theirs.num_faces()) {
      result.mismatch = at_level(k) + std::to_string(t.num_vertices()) + " vertices and " +
                        std::to_string(t.num_faces()) + " faces, not " + std::to_string(theirs.num_vertices()) +
                        " and " + std::to_string(theirs.num_faces());
      return result;
    }
    if (std::string what = differences(refined[k], theirs, vertex_map, face_map); !what.empty()) {
      result.mismatch = at_level(k) + what;
      return result;
    }
    for (Index v = 0; v < t.num_vertices(); ++v)
      result.error = std::max(result.error, (x.row(v) - theirs.positions.row(vertex_map[v])).norm() / size);
    if (k == levels) break;

    const Refinement& r = refined[k + 1].steps[0];
    std::vector<Index> first_corner{0};
    for (const Index n : theirs.face_sizes) first_corner.push_back(first_corner.back() + n);
    std::vector<Index> child_vertices(r.topology.num_vertices(), -1), child_faces(r.topology.num_faces(), -1);
    for (Index v = 0; v < t.num_vertices(); ++v)
      child_vertices[index(r.child(Vertex{v}))] = theirs.vertex_child[vertex_map[v]];
    for (Index f = 0, child = 0; f < t.num_faces(); ++f) {
      const Index g = face_map[f];
      if (r.from_faces) child_vertices[index(r.child(Face{f}))] = theirs.face_child[g];
      for (Index c = theirs.child_face_offsets[g]; c < theirs.child_face_offsets[g + 1]; ++c)
        child_faces[child++] = theirs.child_faces[c];
      for (Index i = 0; i < t.size(Face{f}); ++i) {
        Index& mapped = child_vertices[index(r.child(t.edge(t.corner(Face{f}, i))))];
        const Index expected = theirs.corner_edge_child[first_corner[g] + i];
        if (mapped >= 0 && mapped != expected) {
          result.mismatch =
              at_level(k) + "edge " + std::to_string(i) + " of face " + std::to_string(f) + " is shared differently";
          return result;
        }
        mapped = expected;
      }
    }
    vertex_map = std::move(child_vertices);
    face_map = std::move(child_faces);
    x = apply(refined[k + 1].S, x);
  }
  result.vertex_map = std::move(vertex_map);
  return result;
}

}  // namespace sublimit::testing
