// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_model.h"

#include <gtest/gtest.h>

#include <map>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::cad_exact;

struct Made {
  LimitModel model;
  LimitIntegrals exact;
  double size;
};

Made made_of(const Mesh& mesh, const std::string& scheme, double tolerance = 1e-4, bool pack = true) {
  const LimitMap surface(find_scheme(scheme).value(), mesh);
  const double size = testing::diagonal(mesh.positions);
  LimitModelOptions options;
  options.tolerance = tolerance * size;
  options.pack = pack;
  return {limit_model(surface, mesh.positions, options), limit_integrals(surface, mesh.positions), size};
}

/// Every edge is on two borders, once either way.
void expect_closed(const BoundaryModel& model) {
  std::vector<int> uses(model.edges.size(), 0), balance(model.edges.size(), 0);
  for (const SplineFace& face : model.faces)
    for (const EdgeUse& use : face.border) {
      ++uses[size_t(use.edge)];
      balance[size_t(use.edge)] += use.reversed ? 1 : -1;
    }
  for (size_t e = 0; e < uses.size(); ++e) {
    EXPECT_EQ(uses[e], 2);
    EXPECT_EQ(balance[e], 0);
  }
  EXPECT_EQ(model.vertices.rows() - Index(model.edges.size()) + Index(model.faces.size()), 2);
}

TEST(LimitModel, OfRegularToriIsFewExactFaces) {
  for (const char* scheme : {"catmull-clark", "doo-sabin"}) {
    const Made made = made_of(testing::jittered(testing::torus(8, 6)), scheme);
    EXPECT_EQ(made.model.caps, 0) << scheme;
    EXPECT_LE(made.model.boundary.faces.size(), 4u) << scheme;
    EXPECT_LT(made.model.measures.largest_gap, cad_exact * made.size);
    EXPECT_NEAR(made.model.measures.volume, made.exact.solid->volume, cad_exact * std::pow(made.size, 3));
  }
}

TEST(LimitModel, OfClosedMeshesHasEachEdgeTwice) {
  for (const auto& [scheme, mesh] : std::vector<std::pair<std::string, Mesh>>{{"catmull-clark", testing::cube()},
                                                                              {"catmull-clark", testing::tetrahedron()},
                                                                              {"catmull-clark", testing::pole(7)},
                                                                              {"doo-sabin", testing::cube()},
                                                                              {"loop", testing::icosahedron()},
                                                                              {"bilinear", testing::cube()}}) {
    const Made made = made_of(mesh, scheme);
    expect_closed(made.model.boundary);
    EXPECT_TRUE(made.model.met) << scheme;
    EXPECT_LT(made.model.measures.largest_gap, cad_exact * made.size) << scheme;
    EXPECT_LT(made.model.measures.exact_angle, testing::reference_angle) << scheme;
    // Caps alone are off, and by the deviation at most.
    EXPECT_NEAR(made.model.measures.volume, made.exact.solid->volume,
                made.model.deviation * made.exact.area + cad_exact * std::pow(made.size, 3))
        << scheme;
  }
}

TEST(LimitModel, IsNearerWithMoreRings) {
  constexpr double asked_for = 1e-6;
  const Made coarse = made_of(testing::cube(), "catmull-clark", 1e-3),
             fine = made_of(testing::cube(), "catmull-clark", asked_for);
  EXPECT_GT(fine.model.quads, coarse.model.quads);
  EXPECT_LE(fine.model.deviation, asked_for * fine.size);
}

TEST(LimitModel, JoinsCapsWithCommonTangentPlanes) {
  for (const auto& [scheme, mesh] : std::vector<std::pair<std::string, Mesh>>{
           {"catmull-clark", testing::jittered(testing::cube())}, {"doo-sabin", testing::jittered(testing::pole(5))}}) {
    const LimitMap surface(find_scheme(scheme).value(), mesh);
    LimitModelOptions options;
    options.tolerance = 1e-4 * testing::diagonal(mesh.positions);
    options.join_smoothly = true;
    const LimitModel model = limit_model(surface, mesh.positions, options);
    EXPECT_GT(model.caps, 0) << scheme;
    EXPECT_TRUE(model.met) << scheme;
    EXPECT_LT(model.measures.cap_angle, testing::reference_angle) << scheme;
    EXPECT_LT(model.measures.between_caps, 0.2) << scheme;  // radians: fitted, not joined
    expect_closed(model.boundary);
  }
}

TEST(LimitModel, KeepsCreasesAsEdges) {
  Mesh mesh = testing::torus(8, 6);
  std::vector<Index> path;
  for (Index i = 0; i <= 8; ++i) path.push_back(i % 8 * 6);
  testing::add_crease(mesh, path, INFINITY);
  const Made made = made_of(mesh, "catmull-clark");
  EXPECT_EQ(made.model.caps, 0);
  EXPECT_GE(made.model.measures.sharp_edges, 8);
  std::int64_t sharp = 0;
  for (const SplineEdge& edge : made.model.boundary.edges) sharp += edge.is_sharp ? 1 : 0;
  EXPECT_GE(sharp, 2);
}

LimitModel named_model(const Mesh& mesh, const std::string& scheme, const Mesh::FaceNames& names, bool pack = true) {
  const LimitMap surface(find_scheme(scheme).value(), mesh);
  LimitModelOptions options;
  options.tolerance = 1e-4 * testing::diagonal(mesh.positions);
  options.pack = pack;
  options.face_names = names;
  return limit_model(surface, mesh.positions, options);
}

Eigen::RowVector3d middle_of_face(const Mesh& mesh, Index face) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  const Index size = mesh.face_sizes[size_t(face)];  // faces of equal sizes
  for (Index i = 0; i < size; ++i) sum += mesh.positions.row(mesh.face_vertices[size_t(face * size + i)]);
  return sum / size;
}

/// The axis whose coordinate is the largest.
std::string axis_of(const Eigen::RowVector3d& x) {
  Eigen::Index axis = 0;
  x.cwiseAbs().maxCoeff(&axis);
  return std::string(x[axis] < 0 ? "-" : "+") + "xyz"[axis];
}

// The sides of a cube are 6 parts of its limit, each around its axis.
TEST(LimitModel, FacesHaveTheNameOfTheirControlFace) {
  const Mesh mesh = testing::cube();
  Mesh::FaceNames names;
  for (Index f = 0; f < 6; ++f) {
    names.names.push_back(axis_of(middle_of_face(mesh, f)));
    names.of_face.push_back(f);
  }
  for (const char* scheme : {"catmull-clark", "doo-sabin", "bilinear"})
    for (const bool pack : {true, false}) {
      const LimitModel model = named_model(mesh, scheme, names, pack);
      expect_closed(model.boundary);
      for (const SplineFace& face : model.boundary.faces) EXPECT_EQ(face.name, axis_of(face.poles.colwise().mean()));
    }
}

// Of both halves of a torus, which mirror each other; the plane of the mirror has edges of the mesh.
TEST(LimitModel, PacksFacesOfOneNameAlone) {
  const Mesh mesh = testing::torus(8, 6);
  const Index faces = mesh.num_faces();
  const size_t without = named_model(mesh, "catmull-clark", {}).boundary.faces.size();
  Mesh::FaceNames halves{{"left", "right"}, {}}, one{{"all"}, std::vector<Index>(size_t(faces), 0)}, each, some;
  for (Index f = 0; f < faces; ++f) {
    halves.of_face.push_back(middle_of_face(mesh, f)[1] < 0 ? 0 : 1);
    some.of_face.push_back(halves.of_face.back() - 1);
    each.names.push_back("face " + std::to_string(f));
    each.of_face.push_back(f);
  }
  some.names = {"right"};
  for (const bool all : {true, false}) {
    const LimitModel model = named_model(mesh, "catmull-clark", all ? halves : some);
    EXPECT_LE(model.boundary.faces.size(), 2 * without);
    EXPECT_LT(model.measures.largest_gap, cad_exact * testing::diagonal(mesh.positions));
    for (const SplineFace& face : model.boundary.faces) {
      EXPECT_EQ(face.name, face.poles.col(1).mean() > 0 ? "right" : all ? "left" : "");
      for (const EdgeUse& use : face.border)
        for (const Index v : {model.boundary.edges[size_t(use.edge)].start, model.boundary.edges[size_t(use.edge)].end})
          EXPECT_GE(model.boundary.vertices(v, 1) * (face.poles.col(1).mean() > 0 ? 1 : -1), -cad_exact);
    }
  }
  const LimitModel whole = named_model(mesh, "catmull-clark", one);
  EXPECT_EQ(whole.boundary.faces.size(), without);
  for (const SplineFace& face : whole.boundary.faces) EXPECT_EQ(face.name, "all");
  EXPECT_EQ(Index(named_model(mesh, "catmull-clark", each).boundary.faces.size()), faces);
}

TEST(LimitModel, RefusesNamesOfOtherMeshes) {
  const Mesh mesh = testing::torus(8, 6);
  std::vector<Index> all(size_t(mesh.num_faces()), 0);
  EXPECT_THROW(named_model(mesh, "catmull-clark", {{"a"}, {0}}), InvalidParameter);
  for (const Index other : {-2, 1}) {
    all[0] = other;
    EXPECT_THROW(named_model(mesh, "catmull-clark", {{"a"}, all}), InvalidParameter);
  }
}

TEST(LimitModel, RefusesWhatIsNoPolynomial) {
  const Mesh mesh = testing::icosahedron();
  const LimitMap surface(find_scheme("butterfly").value(), mesh);
  LimitModelOptions options;
  options.tolerance = 1e-3;
  EXPECT_THROW(limit_model(surface, mesh.positions, options), UnsupportedTopology);
  options.tolerance = 0;
  EXPECT_THROW(limit_model(surface, mesh.positions, options), InvalidParameter);
}

TEST(LimitModel, StopsBeforeThereAreTooManyFaces) {
  const Mesh mesh = testing::cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  LimitModelOptions options;
  options.tolerance = 1e-3;
  options.max_faces = 10;
  EXPECT_THROW(limit_model(surface, mesh.positions, options), ResourceError);
}

}  // namespace
}  // namespace sublimit
