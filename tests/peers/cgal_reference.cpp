// SPDX-License-Identifier: Apache-2.0
#include "peers/cgal_reference.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace sublimit::testing {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using CgalMesh = CGAL::Surface_mesh<Point>;

CgalMesh built(const Mesh& control) {
  CgalMesh mesh;
  std::vector<CgalMesh::Vertex_index> vertices, corners;
  for (Index v = 0; v < control.num_vertices(); ++v)
    vertices.push_back(
        mesh.add_vertex(Point(control.positions(v, 0), control.positions(v, 1), control.positions(v, 2))));
  size_t at = 0;
  for (const Index size : control.face_sizes) {
    corners.clear();
    for (Index i = 0; i < size; ++i) corners.push_back(vertices[control.face_vertices[at++]]);
    if (mesh.add_face(corners) == CgalMesh::null_face()) throw std::runtime_error("CGAL does not take the mesh");
  }
  return mesh;
}

void refine(CgalMesh& mesh, CgalScheme scheme, int levels) {
  namespace method = CGAL::Subdivision_method_3;
  const auto steps = CGAL::parameters::number_of_iterations(unsigned(levels));
  switch (scheme) {
    case CgalScheme::bilinear:
      // Its constructor from a mesh alone does not compile.
      method::PQQ(mesh, CGAL::Linear_mask_3<CgalMesh>(&mesh, get(CGAL::vertex_point, mesh)), steps);
      break;
    case CgalScheme::catmull_clark:
      method::CatmullClark_subdivision(mesh, steps);
      break;
    case CgalScheme::loop:
      if (!CGAL::is_triangle_mesh(mesh)) throw std::runtime_error("CGAL's Loop scheme takes triangles only");
      method::Loop_subdivision(mesh, steps);
      break;
    case CgalScheme::doo_sabin:
      method::DooSabin_subdivision(mesh, steps);
      break;
    case CgalScheme::sqrt3:
      if (!CGAL::is_triangle_mesh(mesh)) throw std::runtime_error("CGAL's sqrt(3) scheme takes triangles only");
      method::Sqrt3_subdivision(mesh, steps);
      break;
  }
}

}  // namespace

std::optional<CgalScheme> cgal_scheme(const std::string& name) {
  if (name == "bilinear") return CgalScheme::bilinear;
  if (name == "catmull-clark") return CgalScheme::catmull_clark;
  if (name == "loop") return CgalScheme::loop;
  if (name == "doo-sabin") return CgalScheme::doo_sabin;
  if (name == "sqrt3") return CgalScheme::sqrt3;
  return std::nullopt;
}

PeerMesh cgal_refine(const Mesh& control, CgalScheme scheme, int levels) {
  CgalMesh mesh = built(control);
  refine(mesh, scheme, levels);
  mesh.collect_garbage();  // elements that were taken away leave gaps in the numbers
  PeerMesh result;
  result.positions.resize(Index(mesh.number_of_vertices()), 3);
  for (const auto v : mesh.vertices())
    for (int c = 0; c < 3; ++c) result.positions(Index(v), c) = mesh.point(v)[c];
  for (const auto f : mesh.faces()) {
    Index size = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      result.face_vertices.push_back(Index(v)), ++size;
    result.face_sizes.push_back(size);
  }
  result.num_edges = Index(mesh.number_of_edges());
  return result;
}

std::function<std::size_t()> cgal_run(const Mesh& control, CgalScheme scheme, int levels) {
  return [mesh = std::make_shared<CgalMesh>(built(control)), scheme, levels]() -> std::size_t {
    refine(*mesh, scheme, levels);
    return mesh->number_of_vertices();
  };
}

}  // namespace sublimit::testing
