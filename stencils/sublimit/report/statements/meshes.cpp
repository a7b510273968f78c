// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/meshes.h"

#include <Eigen/Eigenvalues>

#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/limit/limit_points.h"
#include "sublimit/report/statements/small_meshes.h"
#include "sublimit/scheme/prepare.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes.h"

namespace sublimit::report {
namespace {

Scheme<double> named(const std::string& name, const SchemeOptions& options = {}) {
  return find_scheme(name, options).value();
}

int num_polygons(const Topology& t) {
  int count = 0;
  for (Index f = 0; f < t.num_faces(); ++f) count += t.size(Face{f}) != 4;
  return count;
}

}  // namespace

Finding need_quads(const std::vector<std::string>& schemes) {
  const ControlMesh mesh = prism(5);
  std::vector<bool> is_so;
  Finding f;
  for (const std::string& name : schemes) {
    try {
      const Level level = refine(named(name), mesh, 1)[1];
      is_so.push_back(false);
      f.numbers[name + ", faces"] = level.topology().num_faces();
    } catch (const UnsupportedTopology&) {
      is_so.push_back(true);
      f.numbers[name + ", faces"] = "refused";
    }
  }
  f.fate = fate(is_so);
  f.computed = "one step of a prism with two pentagons";
  return f;
}

Finding polygons_stay_from(const std::string& scheme, int step) {
  constexpr int most = 4;
  std::vector<int> counts;
  for (const Level& level : refine(named(scheme), prism(5), most)) counts.push_back(num_polygons(level.topology()));
  int first = most;
  while (first > 0 && counts[static_cast<size_t>(first) - 1] == counts[most]) --first;
  Finding f{fate(first == step), "faces that are no quads, counted over 4 steps from a prism with two pentagons"};
  f.numbers["faces that are no quads"] = counts;
  return f;
}

Finding vertex_faces_have_four_corners(const std::string& scheme) {
  const std::vector<Level> levels = refine(named(scheme), prism(5), 1);
  const Topology &control = levels[0].topology(), &child = levels[1].topology();
  // Faces come from faces, edges and vertices, in this order.
  const Index before = control.num_faces() + control.num_edges();
  std::vector<bool> is_so;
  bool valence = true;
  for (Index v = 0; v < control.num_vertices(); ++v) {
    const Index corners = child.size(Face{before + v});
    is_so.push_back(corners == 4);
    valence = valence && corners == control.num_faces(Vertex{v});
  }
  Finding f{fate(is_so), "the faces that one step makes of the vertices of a prism, which have valence 3"};
  f.numbers["as many corners as the valence"] = valence;
  return f;
}

Finding border_vertices_have_edges(int edges) {
  const Topology t(view(grid(3, 3)));
  std::vector<bool> is_so;
  int with = 0, corners = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) {
    if (!t.is_boundary(Vertex{v})) continue;
    const Index count = t.num_faces(Vertex{v}) + 1;
    is_so.push_back(count == edges);
    with += count == edges;
    corners += count == 2;
  }
  Finding f{fate(is_so), "border vertices of a grid of quads, counted"};
  f.numbers["with " + std::to_string(edges) + " edges"] = with;
  f.numbers["corners, with 2"] = corners;
  return f;
}

Finding only_spheres_are_regular() {
  Finding f;
  std::vector<bool> is_so;
  for (const auto& [name, mesh] : {std::pair<std::string, ControlMesh>{"torus", torus(4, 5)}, {"cube", prism(4)}}) {
    const Topology t(view(mesh));
    const Index euler = t.num_vertices() - t.num_edges() + t.num_faces();
    int extraordinary = num_polygons(t);
    for (Index v = 0; v < t.num_vertices(); ++v) extraordinary += t.num_faces(Vertex{v}) != 4;
    is_so.push_back((euler == 2) == (extraordinary == 0));
    f.numbers[name + ", V - E + F"] = euler;
    f.numbers[name + ", extraordinary points"] = extraordinary;
  }
  f.fate = fate(is_so);
  f.computed = "points, edges and faces of nets of quads, counted: where all are regular V - E + F = 0, a sphere has 2";
  return f;
}

Finding border_depends_on_inside(const std::string& rule) {
  const Scheme<double> scheme = named("modified-butterfly", {{"boundary-rule", rule}});
  SubdivisionOptions options;
  options.boundary = Boundary::edge_only;
  const std::vector<Level> levels = refine(scheme, triangulated(grid(3, 3)), 1, options);
  const Topology &parent = levels[0].topology(), &child = levels[1].topology();
  int reaching = 0;
  for (Index r = 0; r < levels[1].S.rows(); ++r) {
    bool reaches = false;
    for (SparseMatrix::InnerIterator it(levels[1].S, r); it; ++it)
      reaches =
          reaches || (child.is_boundary(Vertex{r}) && !parent.is_boundary(Vertex{Index(it.col())}) && it.value() != 0);
    reaching += reaches;
  }
  Finding f{fate(reaching > 0), "rows of new border points of a grid cut into triangles"};
  f.numbers[rule + ", border points that depend on points inside"] = reaching;
  return f;
}

Finding interpolation_is_solvable(const std::vector<std::pair<std::string, ControlMesh>>& meshes,
                                  const std::string& scheme) {
  const Scheme<double> rules = named(scheme);
  LimitTypes cache(rules);
  std::vector<bool> is_so;
  Finding f;
  for (const auto& [name, mesh] : meshes) {
    const Eigen::MatrixXd L(limit_matrices(control_level(rules, mesh), cache).position);
    const Eigen::VectorXd values = L.jacobiSvd().singularValues();
    constexpr double rounding = 1e-12;
    is_so.push_back(values.minCoeff() > rounding);
    f.numbers[name + ", least singular value"] = drawn(is_so.back() ? values.minCoeff() : 0);
  }
  f.fate = fate(is_so);
  f.computed = "singular values of the matrix from control points to limit points";
  return f;
}

Finding same_points(const Scheme<double>& a, const Scheme<double>& b, const ControlMesh& mesh) {
  const std::vector<Level> levels = refine(a, mesh, 1);
  const Eigen::MatrixXd x = Eigen::MatrixXd(levels[1].S) * mesh.positions;
  const auto next = [&](const Scheme<double>& scheme) -> Eigen::MatrixXd {
    return next_level(scheme, levels[1]).S * x;
  };
  const double most = (next(a) - next(b)).cwiseAbs().maxCoeff();
  constexpr double rounding = 1e-12;
  Finding f{fate(most < rounding), "both rules on a cube that was refined once"};
  f.numbers["largest distance on the cube"] = drawn(most < rounding ? 0 : most);
  return f;
}

}  // namespace sublimit::report
