// SPDX-License-Identifier: Apache-2.0
// Limits at places that never come to be alone among regular points, and what is said where there is none: sheets that
// meet along edges that end inside them, faces back to back, vertices of two faces.
#include "sublimit/limit/detail/limit_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "meshes/meshes.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/detail/vertex_limits.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/neighborhood/control_place.h"
#include "sublimit/neighborhood/vertex_sides.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Points in general position.
Mesh sheets(Index num_vertices, const std::vector<std::vector<Index>>& faces) {
  std::vector<Eigen::Vector3d> points;
  for (Index i = 0; i < num_vertices; ++i)
    points.push_back({std::cos(2.0 * i), std::sin(3.0 * i), std::cos(1.0 + 5.0 * i)});
  return make_mesh(points, faces);
}

struct NamedSheets {
  std::string name;
  Mesh mesh;
};

std::vector<NamedSheets> odd_meshes() {
  return {{"faces back to back", sheets(7, {{0, 1, 2}, {2, 1, 0}, {3, 4, 5, 6}, {6, 5, 4, 3}})},
          // Edge (0,1) has four faces, two of them back to back: it begins and ends inside their sheet.
          {"an edge that ends inside", sheets(6, {{0, 1, 2, 3}, {3, 2, 1, 0}, {0, 1, 4}, {1, 0, 5}})},
          {"two edges of three faces", sheets(7, {{0, 1, 2, 3}, {1, 0, 4, 5}, {0, 1, 6}, {0, 3, 2}, {3, 0, 5}})},
          // Vertex 0 is on the curve 1 0 4, of which each of its four sides sees one edge.
          {"sides of one edge of a curve",
           sheets(7, {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 4}, {0, 4, 6}, {0, 6, 4}})},
          // The first vertex splits an edge of a tetrahedron: it has two faces.
          {"a vertex of two faces", sheets(5, {{1, 0, 2, 3}, {2, 0, 1, 4}, {2, 4, 3}, {1, 3, 4}})},
          {"fans that meet in a vertex", sheets(7, {{0, 1, 2}, {0, 2, 1}, {0, 3, 4, 5}, {0, 5, 6, 3}})}};
}

/// Where a place is after levels of refinement.
Eigen::RowVector3d seen(const Level& level, const Points& x, const Centre& centre) {
  const Topology& t = level.topology();
  if (centre.kind == Centre::Kind::vertex) return x.row(index(t.tail(centre.start)));
  if (centre.kind != Centre::Kind::face)
    return (x.row(index(t.tail(centre.start))) + x.row(index(t.head(centre.start)))) / 2;
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const Index v : t.vertices(t.face(centre.start))) sum += x.row(v);
  return sum / t.size(t.face(centre.start));
}

Eigen::RowVector3d position(const LimitRows& rows, const Points& x) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const auto& [column, weight] : rows.position()) sum += weight * x.row(column);
  return sum;
}

class EverySchemesRows : public ::testing::TestWithParam<std::pair<std::string, SchemeOptions>> {
 protected:
  const Scheme<double> scheme = find_scheme(GetParam().first, GetParam().second).value();
  Mesh taken(const Mesh& mesh) const { return scheme.face_size() == 3 ? triangulated(mesh) : mesh; }
};

TEST_P(EverySchemesRows, AreWhereRefinementGoes) {
  // From level 2 to level 6 the rest shrinks by 2 and more a level, or a period of two.
  constexpr int before = 2, after = 6;
  const double shrinking = std::pow(0.5, (after - before) / scheme.period - 1);
  for (const NamedSheets& named : odd_meshes()) {
    const Mesh mesh = taken(named.mesh);
    const double size = diagonal(mesh.positions);
    const std::vector<Level> levels = refine(scheme, mesh, after);
    std::vector<Points> x{mesh.positions};
    for (int k = 1; k <= after; ++k) x.push_back(apply(levels[k].S, x.back()));
    LimitCache cache(scheme);
    const VertexSides sides = vertex_sides(levels[0]);
    std::vector<LimitRows> rows;
    ASSERT_NO_THROW(rows = limit_rows(levels[0], cache, sides.centres)) << named.name;
    for (size_t s = 0; s < rows.size(); ++s) {
      const auto rest = [&](int k) {
        const Centre there = descendant(sides.centres[s], std::span(levels).first(size_t(k) + 1));
        return (seen(levels[k], x[k], there) - position(rows[s], mesh.positions)).norm();
      };
      EXPECT_LE(rest(after), shrinking * rest(before) + other_route * size)
          << named.name << ", vertex " << sides.vertex[s] << ", side " << s;
    }
  }
}

// The one answer of limits at vertices and limits at places: the corners of faces.
TEST_P(EverySchemesRows, AreThoseOfTheSurface) {
  for (const NamedSheets& named : odd_meshes()) {
    const Mesh mesh = taken(named.mesh);
    const LimitMap surface(scheme, mesh);
    const Topology& t = surface.level().topology();
    LimitCache cache(scheme);
    const VertexSides sides = vertex_sides(surface.level());
    const std::vector<LimitRows> rows = limit_rows(surface.level(), cache, sides.centres);
    for (Index a = 0; a < surface.addresses().size(); ++a) {
      const Addresses::FaceCorner place = surface.addresses().place(a);
      const HalfEdge corner = t.corner(place.face, std::max<Index>(place.corner, 0));
      // Left to do: at a vertex of two faces the parameters of mid-edge surfaces lead to the middle of the face
      // opposite.
      const HalfEdge other = t.ccw(corner);
      const bool two_faces = exists(other) && other != corner && t.ccw(other) == corner;
      if (scheme.name.starts_with("mid-edge") && two_faces) continue;
      const LimitStencil at = surface.stencil({a, 0, 0}, 0);
      Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
      for (size_t j = 0; j < at.vertices.size(); ++j) point += at.weights(0, j) * mesh.positions.row(at.vertices[j]);
      const Index side = sides.corner_side[index(corner)];
      EXPECT_LE((point - position(rows[side], mesh.positions)).norm(), other_route * diagonal(mesh.positions))
          << named.name << ", vertex " << sides.vertex[side] << ", place " << a;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EverySchemesRows, ::testing::ValuesIn([] {
                           std::vector<std::pair<std::string, SchemeOptions>> all;
                           for (const Scheme<double>& scheme : all_schemes()) all.push_back({scheme.name, {}});
                           for (const char* degree : {"2", "4", "5"})
                             all.push_back({"averaging", {{"degree", degree}}});
                           return all;
                         }()),
                         [](const auto& tested) {
                           std::string name = tested.param.first;
                           for (const auto& [option, value] : tested.param.second) name += "_" + option + value;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Which faces are cut before the first level depends on the whole mesh: L_0 = L_1 S_0, also far from the triangle.
TEST(LimitRows, KnowThatThePreparationComesFirst) {
  const Scheme<double> scheme = find_scheme("kobbelt").value();
  Mesh mesh = jittered(grid(9, 9));
  const Index corner = mesh.face_vertices[0];  // of the first face: it loses one of its corners
  ASSERT_EQ(corner, 0);
  mesh.face_vertices.erase(mesh.face_vertices.begin());
  mesh.face_sizes[0] = 3;
  const std::vector<Level> levels = refine(scheme, mesh, 1);
  LimitCache cache(scheme);
  const LimitMatrices coarse = limit_matrices(levels[0], cache), fine = limit_matrices(levels[1], cache);
  const Points x = apply(levels[1].S, mesh.positions);
  const LimitPoints at_0 = limit_points(coarse, levels[0].topology(), mesh.positions);
  const LimitPoints at_1 = limit_points(fine, levels[1].topology(), x);
  const auto side_of = [](const LimitMatrices& limit, Index v) {
    return std::lower_bound(limit.side_vertex.begin(), limit.side_vertex.end(), v) - limit.side_vertex.begin();
  };
  const Index middle = 55;  // of 10 x 10
  const Eigen::RowVector3d a = at_0.normal.row(side_of(coarse, middle)), b = at_1.normal.row(side_of(fine, middle));
  EXPECT_NEAR(a.norm(), 1, rounding(4));
  EXPECT_LE((a - b).norm(), reference_angle);
}

// Weights that sum to one, but leave the vertex the farther the more often they are applied.
TEST(LimitRows, NameTheFirstVertexThatHasNoLimit) {
  for (const char* name : {"catmull-clark", "averaging"}) {
    Scheme<double> scheme = find_scheme(name).value();
    Step<double>& step = scheme.steps.back();
    const auto vertex = step.masks.vertex;
    step.masks.vertex = [=](const Ring<double>& v) {
      return v.valence() == 5 ? 3 * v.center() - 2 * v.neighbor_mean() : vertex(v);
    };
    const Mesh mesh = disjoint_union(cube(), fan(5, 4, 2));
    const std::vector<Level> levels = refine(scheme, mesh, 1);
    LimitCache cache(scheme);
    expect_error<NoLimit>([&] { limit_matrices(levels[0], cache); }, {"no limit at vertex 8:", "eigenvalue 1"});
    expect_error<NoLimit>([&] { limit_matrices(levels, cache); }, {"no limit at vertex 8:", "eigenvalue 1"});
    try {
      limit_matrices(levels, cache);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unsupported_topology);  // at each door: the scheme has no limit of this mesh
    }
    expect_error<NoLimit>([&] { limit_matrices(levels[1], cache); }, {"no limit at vertex 8 of level 1:"});
    const LimitMap surface(scheme, mesh);
    expect_error<NoLimit>(
        [&] {
          surface.stencil({6, 0, 0}, 0);
        },
        {"no limit at some place of face 6:", "eigenvalue 1"});
  }
}

TEST(ControlPlace, IsAVertexOrAFace) {
  for (const char* name : {"catmull-clark", "doo-sabin", "mid-edge"}) {
    const std::vector<Level> levels = refine(find_scheme(name).value(), cube(), 2);
    const Topology& t = levels[2].topology();
    std::set<std::string> places;
    for (Index v = 0; v < t.num_vertices(); ++v) places.insert(control_place(levels, Vertex{v}));
    for (const std::string& place : places)
      EXPECT_TRUE(place.starts_with("vertex ") || place.starts_with("a point in face ")) << place;
  }
  const std::vector<Level> levels = refine(find_scheme("catmull-clark").value(), cube(), 2);
  for (Index v = 0; v < 8; ++v) EXPECT_EQ(control_place(levels, Vertex{v}), "vertex " + std::to_string(v));
  for (Index f = 0; f < 6; ++f)  // face points of level 1
    EXPECT_EQ(control_place(levels, Vertex{8 + f}), "a point in face " + std::to_string(f));
}

// Rows have the square of a face's corners as entries, which is said before they are made.
TEST(LimitMemory, LargeFacesAreRefusedBeforeTheyTakeIt) {
  std::vector<Index> corners;
  for (Index i = 0; i < 500; ++i) corners.push_back(i);
  const Mesh mesh = sheets(500, {corners});
  const Scheme<double> scheme = *find_scheme("catmull-clark");
  LimitCache cache(scheme);
  const std::vector<Level> levels = refine(scheme, mesh, 0);
  limit_memory(1e7);  // 500 * 500 * 48 is 1.2e7
  expect_error<ResourceError>(
      [&] { (void)limit_matrices(levels, cache); },
      {"limits of 500 vertices in faces of up to 500 corners take about 12.0 MB", "cut large faces, or refine first"});
  limit_memory(2e7);
  EXPECT_EQ(limit_matrices(levels, cache).position.rows(), 500);
  limit_memory(std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace sublimit::testing
