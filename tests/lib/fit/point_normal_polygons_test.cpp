// SPDX-License-Identifier: Apache-2.0
// Points and normals by polygons: what the construction says is checked by limits that know nothing of it.
#include "sublimit/fit/detail/point_normal_polygons.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

#include "meshes/irregular_meshes.h"
#include "meshes/places.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

/// What is promised: positions relative to the bounding box, normals in radians.
constexpr double fitted_position = 1e-13, fitted_normal = 1e-12;
/// As normals are evaluated from derivatives: those of mid-edge's pieces are as exact as first derivatives are
/// promised.
double evaluated_normal(const Scheme<double>& scheme) {
  return scheme.name == "mid-edge" ? first_derivative : fitted_normal;
}

Vector3d random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double x = unit(random), y = unit(random), z = unit(random);
  return {x, y, z};
}

/// Every vertex moved, with a normal up to a right angle away from the mesh's own.
std::vector<VertexTarget> random_targets(const Mesh& mesh, unsigned seed, double amount = 0.1) {
  std::mt19937 random(seed);
  std::vector<Vector3d> own(mesh.num_vertices(), Vector3d::Zero());
  size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    Vector3d area = Vector3d::Zero();
    const auto corner = [&](Index i) -> Vector3d { return mesh.positions.row(mesh.face_vertices[first + i % size]); };
    for (Index i = 0; i < size; ++i) area += corner(i).cross(corner(i + 1));
    for (Index i = 0; i < size; ++i) own[mesh.face_vertices[first + i]] += area;
    first += size;
  }
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    Vector3d normal = random_vector(random);
    if (normal.dot(own[v]) < 0) normal = -normal;
    targets.push_back({v, Vector3d(mesh.positions.row(v).transpose()) + amount * random_vector(random), normal});
  }
  return targets;
}

/// The middle of a face, or of its border edge.
Place place_of(const LimitMap& surface, Face face) {
  const Topology& t = surface.level().topology();
  for (Index i = 0; i < t.size(face); ++i)
    if (!exists(t.twin(t.corner(face, i)))) return on_edge(t, surface.addresses(), t.corner(face, i), 0.5);
  const Index first = surface.addresses().first(face);
  return t.size(face) == 4 ? Place{first, 0.5, 0.5} : Place{first, 1, 1};
}

double angle(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The points as the control mesh of their own that they are.
Mesh control_mesh(const Topology& t, const Points& points) {
  Mesh mesh;
  mesh.positions = points;
  for (Index f = 0; f < t.num_faces(); ++f) {
    mesh.face_sizes.push_back(t.size(Face{f}));
    for (const Index v : t.vertices(Face{f})) mesh.face_vertices.push_back(v);
  }
  return mesh;
}

/// Largest deviations of the limit from the targets.
struct Deviation {
  double position = 0, normal = 0;
};
Deviation deviation(const LimitMap& surface, const PointNormalMesh& fit, const std::vector<VertexTarget>& targets) {
  std::vector<Place> places;
  for (const Index face : fit.faces) places.push_back(place_of(surface, Face{face}));
  const LimitSamples limit = surface.evaluate(fit.points, places, 1);
  Deviation most;
  for (size_t i = 0; i < targets.size(); ++i) {
    const Vector3d position = limit.position.row(Index(i)), normal = limit.normal.row(Index(i));
    most.position = std::max(most.position, (position - targets[i].position).norm() / diagonal(fit.points));
    if (!targets[i].normal) continue;
    EXPECT_NEAR(normal.norm(), 1, rounding(8)) << "no normal at vertex " << targets[i].vertex;
    most.normal = std::max(most.normal, angle(normal, *targets[i].normal));
  }
  return most;
}

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> list{{"cube", {}, cube()}, {"icosahedron", {}, icosahedron()}};
  for (Index n = 3; n <= 8; ++n) list.push_back({"bipyramid " + std::to_string(n), {}, bipyramid(n)});
  list.push_back({"polygons", {}, jittered(merged(flipped(triangle_torus(6, 5), 60), 25), 0.02)});
  return list;
}

class PointNormalPolygons : public ::testing::TestWithParam<std::string> {
 protected:
  const Scheme<double> scheme_ = *find_scheme(GetParam());
  LimitMap surface(const Level& level) const { return {scheme_, level, types_}; }
  LimitMap surface(const Mesh& mesh) const { return {scheme_, mesh, {}, types_}; }

 private:
  const std::shared_ptr<LimitCache> types_ = std::make_shared<LimitCache>(scheme_);
};
INSTANTIATE_TEST_SUITE_P(All, PointNormalPolygons,
                         ::testing::Values("doo-sabin", "doo-sabin-averaging", "mid-edge", "mid-edge-habib-warren"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(PointNormalPolygons, TheLimitHasTheirPointsAndNormals) {
  for (const NamedMesh& named : meshes()) {
    SCOPED_TRACE(named.name);
    const std::vector<VertexTarget> targets = random_targets(named.mesh, 1);
    const PointNormalMesh fit = point_normal_mesh(scheme_, named.mesh, targets);
    EXPECT_LE(fit.position_residual.maxCoeff(), fitted_position * diagonal(fit.points));
    EXPECT_LE(fit.normal_residual.maxCoeff(), fitted_normal);
    const Deviation here = deviation(surface(fit.level), fit, targets);
    EXPECT_LE(here.position, fitted_position);
    EXPECT_LE(here.normal, evaluated_normal(scheme_));
    // Also as a control mesh that forgot where it came from.
    const Deviation alone = deviation(surface(control_mesh(fit.level.topology(), fit.points)), fit, targets);
    EXPECT_LE(alone.position, fitted_position);
    EXPECT_LE(alone.normal, evaluated_normal(scheme_));
  }
}

TEST_P(PointNormalPolygons, StayInTheirPlanesLevelByLevel) {
  const Mesh mesh = jittered(merged(flipped(triangle_torus(6, 5), 60), 25), 0.02);
  const std::vector<VertexTarget> targets = random_targets(mesh, 2);
  const PointNormalMesh fit = point_normal_mesh(scheme_, mesh, targets);
  Level level = fit.level;
  Points x = fit.points;
  for (int step = 0; step < 6; ++step) {
    level = next_level(scheme_, level);
    x = level.S * x;
    for (size_t i = 0; i < targets.size(); ++i) {  // a face's own child has the face's number
      const std::span<const Index> corners = level.topology().vertices(Face{fit.faces[i]});
      Vector3d centroid = Vector3d::Zero(), area = Vector3d::Zero();
      for (const Index v : corners) centroid += x.row(v) / double(corners.size());
      for (size_t k = 0; k < corners.size(); ++k) {
        const Vector3d a = x.row(corners[k]).transpose() - centroid;
        const Vector3d b = x.row(corners[(k + 1) % corners.size()]).transpose() - centroid;
        area += a.cross(b);
      }
      ASSERT_LE((centroid - targets[i].position).norm(), fitted_position * diagonal(fit.points)) << step;
      double height = 0;  // of the corners over the plane
      for (const Index v : corners)
        height = std::max(height, std::abs((x.row(v).transpose() - centroid).dot(targets[i].normal->normalized())));
      ASSERT_LE(height, fitted_position * diagonal(fit.points)) << step;
      ASSERT_GT(area.dot(*targets[i].normal), 0) << step;
    }
  }
}

TEST_P(PointNormalPolygons, BordersHaveTheirPointsInTheMiddleOfTheirEdge) {
  const bool has_plane = scheme_.name.starts_with("doo-sabin");  // mid-edge has none at borders of many faces
  for (const Mesh& mesh : {grid(3, 2), open_fan(1), open_fan(5, 4, 2), fan(5, 3, 2), polygon_ring({3, 5, 4, 7, 6})}) {
    std::vector<VertexTarget> targets = random_targets(mesh, 3);
    const Topology t(view(mesh));
    Index border = -1;
    for (VertexTarget& target : targets) {
      if (!t.is_boundary(Vertex{target.vertex})) continue;
      if (!has_plane) target.normal.reset();
      border = target.vertex;
    }
    const PointNormalMesh fit = point_normal_mesh(scheme_, mesh, targets);
    const Deviation here = deviation(surface(fit.level), fit, targets);
    EXPECT_LE(here.position, fitted_position);
    EXPECT_LE(here.normal, evaluated_normal(scheme_));
    if (has_plane) continue;
    targets[border].normal = Vector3d::UnitX();
    if (t.num_faces(Vertex{border}) >= 3) {
      expect_error<UnsupportedTopology>([&] { point_normal_mesh(scheme_, mesh, targets); },
                                        {"vertex " + std::to_string(border), "no tangent plane", scheme_.name});
    } else {  // all that decays like the tangents goes in one direction
      const PointNormalMesh with_normal = point_normal_mesh(scheme_, mesh, targets);
      EXPECT_LE(deviation(surface(with_normal.level), with_normal, targets).normal, evaluated_normal(scheme_));
    }
  }
}

TEST_P(PointNormalPolygons, OfARegularPlaneGridAreItsOwnChild) {
  Mesh mesh = grid(4, 4);
  for (Index v = 0; v < 25; ++v) mesh.positions.row(v) << v % 5, v / 5, 0;
  std::vector<VertexTarget> targets;
  for (Index j = 1; j < 4; ++j)
    for (Index i = 1; i < 4; ++i)
      targets.push_back({j * 5 + i, mesh.positions.row(j * 5 + i).transpose(), Vector3d::UnitZ()});
  const std::vector<Level> levels = refine(scheme_, mesh, scheme_.period);
  const Points refined = refinement_matrix(levels) * mesh.positions;
  EXPECT_LE((point_normal_mesh(scheme_, mesh, targets).points - refined).cwiseAbs().maxCoeff(), rounding(16, 4));
  const PointNormalMesh small = point_normal_mesh(scheme_, mesh, targets, {.size = 0.25});
  for (size_t i = 0; i < targets.size(); ++i)
    for (const Index v : small.level.topology().vertices(Face{small.faces[i]}))
      EXPECT_NEAR((small.points.row(v).transpose() - targets[i].position).norm(),
                  (refined.row(v).transpose() - targets[i].position).norm() / 2, rounding(16, 4));
}

TEST_P(PointNormalPolygons, LeaveAMeshWhoseLimitHasThemAlready) {
  const Mesh mesh = jittered(prism(6));
  const PointNormalMesh none = point_normal_mesh(scheme_, mesh, {});
  EXPECT_EQ(none.points, refinement_matrix(refine(scheme_, mesh, scheme_.period)) * mesh.positions);
  std::vector<VertexTarget> targets;  // points of its limit, without normals
  for (Index v = 0; v < mesh.num_vertices(); ++v) targets.push_back({v, mesh.positions.row(v).transpose()});
  const PointNormalMesh moved = point_normal_mesh(scheme_, mesh, targets);
  EXPECT_GT((moved.points - none.points).norm(), 0.1);
  const LimitMap limit = surface(none.level);
  for (size_t i = 0; i < targets.size(); ++i) {
    const std::vector<Place> place{place_of(limit, Face{moved.faces[i]})};
    targets[i].position = limit.evaluate(none.points, place, 0).position.row(0);
  }
  EXPECT_LE((point_normal_mesh(scheme_, mesh, targets).points - none.points).cwiseAbs().maxCoeff(), rounding(64, 2));
}

TEST_P(PointNormalPolygons, AreAsLargeAsTheDataAreApart) {
  const Mesh mesh = torus(6, 5);
  std::vector<VertexTarget> targets = random_targets(mesh, 6, 0);
  for (VertexTarget& target : targets) target.position *= 10;
  const PointNormalMesh fit = point_normal_mesh(scheme_, mesh, targets);
  const Points plain = point_normal_mesh(scheme_, mesh, {}).points;
  for (const Index face : fit.faces) {
    const std::span<const Index> corners = fit.level.topology().vertices(Face{face});
    const double before = (plain.row(corners[0]) - plain.row(corners[2])).norm();
    EXPECT_GT((fit.points.row(corners[0]) - fit.points.row(corners[2])).norm(), 8 * before);
  }
}

TEST_P(PointNormalPolygons, MoveWithTheirData) {
  const Mesh mesh = jittered(prism(5));
  const std::vector<VertexTarget> targets = random_targets(mesh, 4);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3d shift(3, -1, 2);
  const double scale = 2.5;
  Mesh turned = mesh;
  turned.positions = ((scale * mesh.positions * R.transpose()).rowwise() + shift.transpose()).eval();
  std::vector<VertexTarget> turned_targets(targets.rbegin(), targets.rend());  // in another order
  for (VertexTarget& target : turned_targets) {
    target.position = scale * R * target.position + shift;
    target.normal = 7 * R * *target.normal;
  }
  const Points expected =
      (scale * point_normal_mesh(scheme_, mesh, targets).points * R.transpose()).rowwise() + shift.transpose();
  const PointNormalMesh fit = point_normal_mesh(scheme_, turned, turned_targets);
  EXPECT_LE((fit.points - expected).cwiseAbs().maxCoeff(), rounding(256, diagonal(expected)));
}

TEST_P(PointNormalPolygons, PassThroughVerticesWhereSheetsMeet) {
  const Mesh mesh = glued(cube(), prism(5), {7}, {0});
  const std::vector<VertexTarget> targets = random_targets(mesh, 5);
  const PointNormalMesh fit = point_normal_mesh(scheme_, mesh, targets);
  EXPECT_LE(fit.position_residual.maxCoeff(), fitted_position * diagonal(fit.points));
  EXPECT_LE(fit.normal_residual.maxCoeff(), fitted_normal);
  const Deviation first = deviation(surface(fit.level), fit, targets);
  EXPECT_LE(first.position, fitted_position);
  EXPECT_LE(first.normal, evaluated_normal(scheme_));
}

TEST_P(PointNormalPolygons, ReportNormalsAgainstTheWinding) {
  const Mesh mesh = cube();
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < 8; ++v) {
    const Vector3d p = mesh.positions.row(v);
    targets.push_back({v, p, v == 2 || v == 5 ? -p : p});
  }
  const PointNormalMesh fit = point_normal_mesh(scheme_, mesh, targets);
  EXPECT_EQ(fit.folded, (std::vector<Index>{2, 5}));
  EXPECT_LE(deviation(surface(fit.level), fit, targets).normal, fitted_normal);
}

TEST(PointNormalPolygonsInput, IsRefusedNamingTheVertex) {
  const Scheme<double> scheme = *find_scheme("doo-sabin");
  const Vector3d p(1, 2, 3), n(0, 0, 1), none = Vector3d::Zero();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [&](std::vector<VertexTarget> targets, double size = 0.5) {
    return [=] { point_normal_mesh(scheme, cube(), targets, {.size = size}); };
  };
  expect_error<InvalidParameter>(with({{8, p, n}}), {"vertex 8", "0 to 7"});
  expect_error<InvalidParameter>(with({{-1, p, n}}), {"vertex -1"});
  expect_error<InvalidParameter>(with({{3, p, n}, {3, p, n}}), {"vertex 3", "two targets"});
  expect_error<InvalidParameter>(with({{3, p, none}}), {"vertex 3", "no length"});
  expect_error<InvalidParameter>(with({{3, Vector3d(nan, 0, 0), n}}), {"vertex 3", "not finite"});
  expect_error<InvalidParameter>(with({{3, p, Vector3d(nan, 0, 0)}}), {"vertex 3", "not finite"});
  expect_error<InvalidParameter>(with({{3, p, n, TargetCurvature{1, 1, Vector3d::UnitX()}}}),
                                 {"vertex 3", "curvatures"});
  for (const double size : {0.0, 1.0, nan}) expect_error<InvalidParameter>(with({{3, p, n}}, size), {"size"});
  Mesh isolated = cube();
  isolated.positions.conservativeResize(9, 3);
  isolated.positions.row(8).setZero();
  expect_error<InvalidParameter>([&] { point_normal_mesh(scheme, isolated, {{8, p, n}}); }, {"vertex 8", "isolated"});
  expect_error<UnsupportedTopology>(
      [&] {
        point_normal_mesh(scheme, fan(2, 3), {{0, p, n}});
      },
      {"vertex 0", "two faces"});
  expect_error<InvalidParameter>([&] { point_normal_mesh(*find_scheme("loop"), octahedron(), {{0, p, n}}); }, {"loop"});
  const Scheme<double> wide = *find_scheme("averaging", {{"degree", "4"}});
  expect_error<UnsupportedTopology>([&] { point_normal_mesh(wide, cube(), {{3, p, n}}); }, {"vertex 3", "interpolate"});
}

}  // namespace
}  // namespace sublimit::testing
