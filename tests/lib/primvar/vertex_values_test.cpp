// SPDX-License-Identifier: Apache-2.0
// What meshes carry to their levels and limits: values of vertices, names and values of faces.
#include "sublimit/primvar/vertex_values.h"

#include <gtest/gtest.h>

#include <numeric>

#include "meshes/irregular_meshes.h"
#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/primvar/linear_scheme.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Coordinates as values, in another order, and a constant; each face has names and a value of its own.
Mesh carrying(Mesh mesh) {
  for (const Eigen::Index axis : {2, 0, 1}) {
    const auto column = mesh.positions.col(axis);
    mesh.vertex_values.push_back({std::string(1, char('x' + axis)), {column.begin(), column.end()}});
  }
  mesh.vertex_values.push_back({"one", std::vector<double>(size_t(mesh.num_vertices()), 1), ValueType::uint8});
  std::vector<Index> own(size_t(mesh.num_faces()));
  std::iota(own.begin(), own.end(), 0);
  std::vector<std::string> words;
  for (const Index f : own) words.push_back("face " + std::to_string(f));
  mesh.materials = {words, own};
  mesh.groups = {{"even", "third"}, own};
  for (Index& name : mesh.groups.of_face) name = name % 2 == 0 ? 0 : name % 3 == 0 ? 1 : -1;
  mesh.face_values = {{"number", {own.begin(), own.end()}, ValueType::int16}};
  mesh.material_files = {"scene.mtl"};
  return mesh;
}

/// Rounding of sums of a few values, which are coordinates.
double of_sums(const Mesh& mesh) { return rounding(40, mesh.positions.cwiseAbs().maxCoeff()); }

std::vector<Mesh> meshes(const Scheme<double>& scheme) {
  if (scheme.face_size() == 3) return {jittered(icosahedron()), jittered(triangle_grid(4, 3))};
  if (scheme.face_size() == 4) return {jittered(cube()), jittered(grid(4, 3))};
  return {jittered(prism(5)), jittered(polygon_ring({5, 4, 3, 6, 4}))};
}

void for_each_case(const auto& body) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const Mesh& mesh : meshes(scheme)) {
      SCOPED_TRACE(scheme.name);
      body(scheme, carrying(mesh));
    }
}

/// Values under the names and types of the control mesh, close to the coordinates.
void expect_coordinates(const Mesh& out, const Mesh& control, const Points& positions, double tolerance) {
  ASSERT_EQ(out.vertex_values.size(), 4u);
  for (size_t k = 0; k < 4; ++k) {
    const Mesh::Values& found = out.vertex_values[k];
    EXPECT_EQ(found.name, control.vertex_values[k].name);
    EXPECT_EQ(found.type, control.vertex_values[k].type);
    ASSERT_EQ(std::ssize(found.values), positions.rows());
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
      const double right = k == 3 ? 1 : positions(v, (Eigen::Index(k) + 2) % 3);
      EXPECT_NEAR(found.values[size_t(v)], right, tolerance);
    }
  }
}

void expect_faces(const Mesh& out, const Mesh& control, const std::vector<Index>& parents) {
  EXPECT_EQ(out.material_files, control.material_files);
  EXPECT_EQ(out.materials.of_face, parents);
  EXPECT_EQ(out.materials.names, control.materials.names);
  ASSERT_EQ(out.face_values.size(), 1u);
  EXPECT_EQ(out.face_values[0].type, ValueType::int16);
  ASSERT_EQ(out.groups.of_face.size(), parents.size());
  for (size_t f = 0; f < parents.size(); ++f) {
    EXPECT_EQ(out.groups.of_face[f], control.groups.of_face[size_t(parents[f])]);
    EXPECT_EQ(out.face_values[0].values[f], parents[f]);
  }
}

// Smooth values that are the coordinates stay these, by both ways to a level.
TEST(VertexValues, AreRefinedAsPositionsAndFacesFollowTheirParents) {
  for_each_case([](const Scheme<double>& scheme, const Mesh& mesh) {
    const double tolerance = of_sums(mesh);
    for (int k = 0; k <= 2; ++k) {
      const std::vector<Level> levels = refine(scheme, mesh, k);
      const Mesh fast = refined_mesh(scheme, mesh, k);
      expect_coordinates(fast, mesh, fast.positions, tolerance);
      expect_faces(fast, mesh, control_faces(levels));
      Points points = mesh.positions;
      for (size_t i = 1; i < levels.size(); ++i) points = apply(levels[i].S, points);
      Mesh slow = level_mesh(levels.back(), points, mesh);
      carry_attributes(mesh, levels, refined_vertex_values(scheme, mesh, levels), slow);
      expect_coordinates(slow, mesh, points, tolerance);
      expect_faces(slow, mesh, control_faces(levels));
      const Refiner refiner(scheme, mesh, k);
      expect_coordinates(refiner.mesh(), mesh, fast.positions, tolerance);
      expect_faces(refiner.mesh(), mesh, control_faces(levels));
    }
  });
}

// On a flat grid faces lie where they come from; triangles of sqrt3 lie in two faces after one step and in one after
// two.
TEST(VertexValues, NamesStayWhereTheyAre) {
  Mesh mesh = triangle_grid(7, 7);
  for (Index v = 0; v < mesh.num_vertices(); ++v) mesh.positions.row(v) << v % 8, v / 8, 0;
  mesh = carrying(mesh);
  size_t inside = 0;
  for (const char* const name : {"loop", "sqrt3", "interpolatory-sqrt3", "butterfly"})
    for (const int levels : {2, 4}) {
      const Mesh fine = refined_mesh(*find_scheme(name), mesh, levels);
      for (size_t f = 0; f < size_t(fine.num_faces()); ++f) {
        Eigen::RowVector3d middle(0, 0, 0);
        for (size_t k = 0; k < 3; ++k) middle += fine.positions.row(fine.face_vertices[3 * f + k]) / 3;
        if ((middle.array() < 2).head(2).any() || (middle.array() > 5).head(2).any()) continue;  // far from the border
        const Index parent = fine.materials.of_face[f];
        const auto corner = [&](Index k) {
          return Eigen::RowVector3d(mesh.positions.row(mesh.face_vertices[size_t(3 * parent + k)]));
        };
        for (Index k = 0; k < 3; ++k) {
          const Eigen::RowVector3d a = corner((k + 1) % 3) - corner(k), b = middle - corner(k);
          EXPECT_GT(a[0] * b[1] - a[1] * b[0], 0) << name << " " << levels;
        }
        ++inside;
      }
    }
  EXPECT_GT(inside, 1000u);
}

// Positions have the same bits with and without attributes.
TEST(VertexValues, ChangeNoPosition) {
  for_each_case([](const Scheme<double>& scheme, const Mesh& mesh) {
    Mesh plain = mesh;
    plain.attributes = Attributes::drop;
    const Mesh dropped = refined_mesh(scheme, plain, 2);
    EXPECT_EQ(refined_mesh(scheme, mesh, 2).positions, dropped.positions);
    EXPECT_TRUE(dropped.vertex_values.empty() && dropped.face_values.empty() && dropped.materials.of_face.empty() &&
                dropped.material_files.empty());
  });
}

// Linear values are those of the linear scheme, which the positions are not; on a level and on the limit.
TEST(VertexValues, LinearOnesAreThoseOfTheLinearScheme) {
  int kept = 0, refused = 0;
  for_each_case([&](const Scheme<double>& scheme, Mesh mesh) {
    mesh.attributes = Attributes::linear;
    if (!keeps_elements(scheme.steps) || !keeps_elements(scheme.preparation)) {
      expect_error<InvalidOption>([&] { refined_vertex_values(scheme, mesh, 1); },
                                  {"linear attributes", "which " + scheme.name + " does not keep", "smooth or drop"});
      ++refused;
      return;
    }
    ++kept;
    EXPECT_TRUE(refined_mesh(scheme, mesh, 1).vertex_values.empty());  // as its header says
    const Points values = refined_vertex_values(scheme, mesh, 1);
    const std::vector<Level> levels = refine(scheme, mesh, 1);
    EXPECT_EQ(refined_vertex_values(scheme, mesh, levels), values);
    const Refinement& step = levels[1].steps[0];
    if (levels[1].steps.size() > 1 || step.split == Split::keep || !scheme.preparation.empty()) return;
    const Topology& t = levels[0].topology();
    for (Index e = 0; e < t.num_edges(); ++e) {
      const Eigen::RowVectorXd mean =
          (vertex_values(mesh).row(index(t.tail(Edge{e}))) + vertex_values(mesh).row(index(t.head(Edge{e})))) / 2;
      EXPECT_LT((values.row(index(step.child(Edge{e}))) - mean).norm(), of_sums(mesh));
    }
    for (Index v = 0; v < t.num_vertices(); ++v)
      EXPECT_EQ(values.row(index(step.child(Vertex{v}))), vertex_values(mesh).row(v));
  });
  EXPECT_GT(std::min(kept, refused), 3);
}

TEST(VertexValues, OfTheLimitAreTheLimitOfTheValues) {
  const std::vector<Place> places{{0, 0.25, 0.5}, {3, 0, 0}, {1, 0.125, 0.875}};
  for (const char* const name : {"catmull-clark", "doo-sabin"}) {
    const Scheme<double> scheme = *find_scheme(name);
    Mesh mesh = carrying(jittered(cube()));
    const LimitMap surface(scheme, mesh);
    const Points right = surface.evaluate(mesh.positions, places).position;
    const Points found = limit_vertex_values(scheme, mesh, surface, places);
    ASSERT_EQ(found.cols(), 4);
    for (Eigen::Index i = 0; i < found.rows(); ++i) {
      EXPECT_EQ(found.row(i).head(3), Eigen::RowVector3d(right(i, 2), right(i, 0), right(i, 1)));
      EXPECT_NEAR(found(i, 3), 1, of_sums(mesh));
    }
    mesh.attributes = Attributes::linear;
    if (scheme.name == "doo-sabin") continue;
    const Points linear = limit_vertex_values(scheme, mesh, surface, places);
    const Points given = vertex_values(mesh);
    const auto corner = [&](Index k) { return Eigen::RowVectorXd(given.row(mesh.face_vertices[size_t(k)])); };
    const Eigen::RowVectorXd bilinear =
        (corner(0) * 3 + corner(1)) / 8 + (corner(3) * 3 + corner(2)) / 8;  // u = 1/4, v = 1/2 of face 0
    EXPECT_LT((linear.row(0) - bilinear).norm(), of_sums(mesh));
  }
}

TEST(VertexValues, MissingOnesAreRefused) {
  const Scheme<double> scheme = *find_scheme("catmull-clark");
  Mesh mesh = carrying(cube());
  mesh.vertex_values[1].values.pop_back();
  expect_error<InvalidMesh>([&] { (void)refined_mesh(scheme, mesh, 1); }, {"value 'x' has 7 numbers for 8 vertices"});
  mesh = carrying(cube());
  mesh.face_values[0].values.push_back(1);
  expect_error<InvalidMesh>([&] { (void)refined_mesh(scheme, mesh, 1); }, {"value 'number' has 7 numbers for 6 faces"});
  mesh = carrying(cube());
  mesh.groups.of_face.pop_back();
  expect_error<InvalidMesh>([&] { (void)refined_mesh(scheme, mesh, 1); }, {"5 faces have names"});
}

}  // namespace
}  // namespace sublimit::testing
