// SPDX-License-Identifier: Apache-2.0
// Points of the limit surface against OpenSubdiv's Far, live and in double, wherever its patches are regular. Its end
// caps around extraordinary vertices are approximations, which are compared with nothing here.
#include <gtest/gtest.h>

#include <random>

#include "meshes/irregular_meshes.h"
#include "meshes/meshes.h"
#include "meshes/shared_meshes.h"
#include "peers/compare_with_opensubdiv.h"
#include "peers/opensubdiv_limit_reference.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

std::vector<Place> random_places(const Addresses& addresses, int per_address, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Place> places;
  for (Index a = 0; a < addresses.size(); ++a)
    for (int i = 0; i < per_address; ++i) {
      double u = coordinate(random), v = coordinate(random);
      if (addresses.triangles() && u + v > 1) u = 1 - u, v = 1 - v;
      places.push_back({a, u, v});
    }
  return places;
}

struct Differences {
  double position = 0;           ///< over the bounding box
  double first = 0, second = 0;  ///< likewise, per unit of the patch
  int compared = 0, end_caps = 0, missing = 0;
};

Differences compare(const Mesh& mesh, const std::string& scheme, int per_address) {
  const LimitMap surface(scheme_for(mesh, scheme), mesh);
  const FarLimit far(mesh, reference_options(mesh, scheme, 0), {.inf_sharp_patches = true});
  const std::vector<Place> places = random_places(surface.addresses(), per_address, 1);
  const LimitSamples ours = surface.evaluate(mesh.positions, places, 2);
  const double size = diagonal(mesh.positions);
  Differences d;
  for (size_t i = 0; i < places.size(); ++i) {
    const Index row = static_cast<Index>(i);
    const std::optional<ReferencePoint> theirs = far.at(places[i]);
    EXPECT_EQ(ours.status[i] == LimitStatus::hole, !theirs) << "a hole for one, address " << places[i].face;
    if (!theirs || ours.status[i] == LimitStatus::hole) continue;
    if (!theirs->regular) {
      ++d.end_caps;
      continue;
    }
    // Derivatives at a side of 2^-k have weights 2^k times as large, and so their rounding.
    const double factor = surface.addresses().place(places[i].face).corner < 0 ? 1 : 2;
    const double unit = size * std::ldexp(1, theirs->depth);
    const auto error = [&](const Points& x, const Eigen::Vector3d& expected) {
      return (x.row(row).transpose() - expected).norm();
    };
    ++d.compared;
    d.position = std::max(d.position, error(ours.position, theirs->position) / size);
    if (ours.order[i] < 2) {
      ++d.missing;
      continue;
    }
    d.first =
        std::max({d.first, error(ours.du, theirs->du / factor) / unit, error(ours.dv, theirs->dv / factor) / unit});
    const double f = factor * factor, unit2 = unit * unit / size;
    d.second = std::max({d.second, error(ours.duu, theirs->duu / f) / unit2, error(ours.duv, theirs->duv / f) / unit2,
                         error(ours.dvv, theirs->dvv / f) / unit2});
  }
  return d;
}

void expect_equal(const Mesh& mesh, const std::string& scheme, int per_address) {
  SCOPED_TRACE(scheme);
  const Differences d = compare(mesh, scheme, per_address);
  EXPECT_LE(d.position, reference);
  EXPECT_LE(d.first, reference);
  EXPECT_LE(d.second, reference);
  EXPECT_EQ(d.missing, 0) << "of " << d.compared << " places in regular patches lack second derivatives";
  ::testing::Test::RecordProperty("compared", d.compared);
  ::testing::Test::RecordProperty("end_caps", d.end_caps);
}

TEST(OpenSubdivLimitPoints, LimitStencilsAreItsPatches) {
  const Mesh mesh = jittered(polygon_ring({4, 5, 4, 6, 5}));
  const FarLimit far(mesh, reference_options(mesh, "catmull-clark", 0), {.level = 4, .inf_sharp_patches = true});
  const std::vector<Place> places = random_places(
      {Topology(
           {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.face_vertices, .face_sizes = mesh.face_sizes}),
       false},
      5, 1);
  const Points by_stencils = far.by_stencils(places);
  for (size_t i = 0; i < places.size(); ++i)
    EXPECT_LE((by_stencils.row(static_cast<Index>(i)).transpose() - far.at(places[i])->position).norm(),
              reference * diagonal(mesh.positions));
}

TEST(OpenSubdivLimitPoints, RegularTorusEqualsFar) {
  expect_equal(jittered(torus(8, 6)), "catmull-clark", 20);
  expect_equal(jittered(triangle_torus(8, 6)), "loop", 20);
}

class PolygonMeshPoints : public ::testing::TestWithParam<NamedMesh> {};
TEST_P(PolygonMeshPoints, EqualFar) { expect_equal(GetParam().mesh, "catmull-clark", 5); }
INSTANTIATE_TEST_SUITE_P(OpenSubdivLimitPoints, PolygonMeshPoints, ::testing::ValuesIn(closed_polygon_meshes()),
                         [](const auto& tested) { return tested.param.name; });

class TriangleMeshPoints : public ::testing::TestWithParam<NamedMesh> {};
TEST_P(TriangleMeshPoints, EqualFar) { expect_equal(GetParam().mesh, "loop", 5); }
INSTANTIATE_TEST_SUITE_P(OpenSubdivLimitPoints, TriangleMeshPoints, ::testing::ValuesIn(closed_triangle_meshes()),
                         [](const auto& tested) { return tested.param.name; });

class TaggedMeshPoints : public ::testing::TestWithParam<NamedMesh> {};
TEST_P(TaggedMeshPoints, EqualFar) {
  for (const std::string& scheme : GetParam().schemes) {
    // Far extrapolates Chaikin's fractional weights (lib/README.md).
    if (scheme == "bilinear" || GetParam().name.starts_with("chain_uneven_chaikin")) continue;
    expect_equal(GetParam().mesh, scheme, 10);
  }
}
INSTANTIATE_TEST_SUITE_P(OpenSubdivLimitPoints, TaggedMeshPoints, ::testing::ValuesIn(tagged_meshes()),
                         [](const auto& tested) { return tested.param.name; });

class SharedMeshPoints : public ::testing::TestWithParam<SharedMesh> {};
TEST_P(SharedMeshPoints, EqualFar) {
  if (GetParam().scheme == "bilinear") return;
  expect_equal(read_mesh(GetParam().path), GetParam().scheme, full_sweep() ? 20 : 2);
}
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SharedMeshPoints);
INSTANTIATE_TEST_SUITE_P(OpenSubdivLimitPoints, SharedMeshPoints, ::testing::ValuesIn(shared_meshes()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sublimit::testing
