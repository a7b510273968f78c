// SPDX-License-Identifier: Apache-2.0
// Reports of OpenSubdiv's regression shapes.
#include <gtest/gtest.h>

#include "meshes/shared_meshes.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/report/asset/asset_json.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(AssetSharedMeshes, SidesOfSeamsAreTheSamePlace) {
  const std::vector<SharedMesh> meshes = shared_meshes();
  if (meshes.empty()) GTEST_SKIP() << "no shared meshes at " << SUBLIMIT_SHARED_MESHES;
  int some = 0;
  for (const SharedMesh& shared : meshes) {
    const bool chosen = shared.name == "catmark_xord_boundary" || shared.name == "loop_xord_boundary" ||
                        shared.name == "catmark_nonman_edges" || shared.name == "catmark_car" ||
                        shared.name == "catmark_chaikin1" || shared.name == "catmark_hole_test2";
    if (!chosen && !full_sweep()) continue;
    SCOPED_TRACE(shared.name);
    ++some;
    const Mesh mesh = read_mesh(shared.path);
    AssetOptions options;
    options.curvature_samples = 2000;
    options.surface_faces = 2000;
    const AssetReport r = asset_report(find_scheme(shared.scheme).value(), mesh, {}, options);
    EXPECT_LT(r.seams.inside.g0.value_or(0), reference * diagonal(mesh.positions));
    EXPECT_LT(r.seams.across_creases.g0.value_or(0), reference * diagonal(mesh.positions));
    std::int64_t vertices = 0;
    for (const AssetKind& kind : r.inventory)
      if (kind.kind != "semi-sharp vertex" && kind.kind != "hole" && kind.kind != "extraordinary face" &&
          kind.kind != "non-manifold edge")
        vertices += kind.count;
    EXPECT_EQ(vertices, mesh.num_vertices()) << "every vertex is of one kind";
    const std::string text = to_json(r, shared.name).dump();
    EXPECT_EQ(nlohmann::ordered_json::parse(text).dump(), text);
    if (shared.name != "catmark_xord_boundary" && shared.name != "loop_xord_boundary") continue;
    // Borders with 5 and 6 quadrilaterals, or 8 triangles, at a vertex.
    ASSERT_FALSE(r.warnings.empty());
    EXPECT_NE(r.warnings[0].says.find("has no tangent plane"), std::string::npos) << r.warnings[0].says;
  }
  EXPECT_GE(some, 6);
}

}  // namespace
}  // namespace sublimit::testing
