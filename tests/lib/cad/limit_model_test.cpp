// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_model.h"

#include <gtest/gtest.h>

#include <map>

#include "sublimit/base/error.h"
#include "sublimit/limit/limit_integrals.h"
#include "sublimit/schemes.h"
#include "support/meshes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::cad_exact;

struct Made {
  LimitModel model;
  LimitIntegrals exact;
  double size;
};

Made made_of(const ControlMesh& mesh, const std::string& scheme, double tolerance = 1e-4, bool pack = true) {
  const LimitSurface surface(find_scheme(scheme).value(), mesh);
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
  for (const auto& [scheme, mesh] :
       std::vector<std::pair<std::string, ControlMesh>>{{"catmull-clark", testing::cube()},
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
  for (const auto& [scheme, mesh] : std::vector<std::pair<std::string, ControlMesh>>{
           {"catmull-clark", testing::jittered(testing::cube())}, {"doo-sabin", testing::jittered(testing::pole(5))}}) {
    const LimitSurface surface(find_scheme(scheme).value(), mesh);
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
  ControlMesh mesh = testing::torus(8, 6);
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

TEST(LimitModel, RefusesWhatIsNoPolynomial) {
  const ControlMesh mesh = testing::icosahedron();
  const LimitSurface surface(find_scheme("butterfly").value(), mesh);
  LimitModelOptions options;
  options.tolerance = 1e-3;
  EXPECT_THROW(limit_model(surface, mesh.positions, options), UnsupportedTopology);
  options.tolerance = 0;
  EXPECT_THROW(limit_model(surface, mesh.positions, options), InvalidParameter);
}

TEST(LimitModel, StopsBeforeThereAreTooManyFaces) {
  const ControlMesh mesh = testing::cube();
  const LimitSurface surface(find_scheme("catmull-clark").value(), mesh);
  LimitModelOptions options;
  options.tolerance = 1e-3;
  options.max_faces = 10;
  EXPECT_THROW(limit_model(surface, mesh.positions, options), ResourceError);
}

}  // namespace
}  // namespace sublimit
