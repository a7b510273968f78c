// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

TEST(SpreadParts, AreThoseOfTheWholeMesh) {
  const TemporaryDirectory directory;
  Mesh textured = disjoint_union(torus(7, 6), prism(5));
  add_crease(textured, {0, 6, 12}, {2.5f, 10});
  textured.creases.push_back({6, 0, 1.5f});  // again, the other way round: the last one counts
  textured.corners = {{3, 2}, {3, 10}};
  textured.holes = {4, 40};
  textured.positions.conservativeResize(textured.num_vertices() + 1, 3);
  textured.positions.bottomRows(1).setZero();
  Mesh::FaceVarying uv{"uv", Points(textured.num_vertices(), 2), textured.face_vertices};
  uv.values = textured.positions.leftCols(2);
  textured.face_varying = {uv};
  int number = 0;
  std::vector<Mesh> meshes{textured, mobius_strip(4), cube()};
  for (const NamedMesh& tagged : tagged_meshes())
    if (tagged.name.find("manifold") != std::string::npos) meshes.push_back(tagged.mesh);
  for (const Mesh& mesh : meshes) {
    const std::string obj = (directory / (std::to_string(number++) + ".obj")).string();
    write_obj(obj, mesh);
    for (const int ranks : {1, 2, 3, 7}) {
      const RanksRun run = run_ranks(ranks, obj, "", 60, SUBLIMIT_PARTS_DRIVER);
      EXPECT_EQ(run.status, 0) << number << ", " << ranks << " ranks: " << run.err;
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
