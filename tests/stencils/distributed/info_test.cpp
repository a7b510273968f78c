// SPDX-License-Identifier: Apache-2.0
// `sublimit-mpi info`: the counts of one process.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "stencils/distributed/tagged_unions.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/jobs/detail/mesh_info_json.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::ordered_json;

Json found(int ranks, const std::string& arguments, int status) {
  const RanksRun run = run_ranks(ranks, "info " + arguments + " --json");
  EXPECT_EQ(run.status, status) << run.err;
  return Json::parse(run.out);
}

/// Of a mesh as it is read, which no tests' mesh is by chance.
void expect_counts(const std::string& path, const std::string& scheme, std::initializer_list<int> ranks) {
  const MeshJob job = mesh_job({.scheme = scheme}, read_mesh(path), path);
  const MeshInfo info = mesh_info(job);
  const Json expected = to_json(info, path);
  const Topology t(view(job.mesh));
  Index edges = 0, vertices = 0, isolated = 0;
  for (Index e = 0; e < t.num_edges(); ++e) edges += t.is_nonmanifold(Edge{e});
  for (Index v = 0; v < t.num_vertices(); ++v)
    vertices += t.is_nonmanifold(Vertex{v}), isolated += t.is_isolated(Vertex{v});
  for (const int n : ranks) {
    const Json json = found(n, path + (scheme.empty() ? "" : " -s " + scheme), info.why_not.empty() ? 0 : 1);
    for (const char* key : {"mesh", "vertices", "edges", "faces", "euler_characteristic", "components",
                            "boundary_loops", "face_sizes", "addresses", "interior_valences", "boundary_valences",
                            "creases", "corners", "holes", "boundary", "creasing", "triangles"})
      EXPECT_EQ(json.at(key), expected.at(key)) << path << " by " << n << ": " << key;
    EXPECT_EQ(json.at("nonmanifold_edges"), edges) << path << " by " << n;
    EXPECT_EQ(json.at("nonmanifold_vertices"), vertices) << path << " by " << n;
    EXPECT_EQ(json.at("isolated_vertices"), isolated) << path << " by " << n;
    if (!scheme.empty()) {
      EXPECT_EQ(json.at("scheme").at("takes_mesh").get<std::string>().substr(0, 3),
                expected.at("scheme").at("takes_mesh").get<std::string>().substr(0, 3))
          << path << " by " << n;
    }
    EXPECT_EQ(json.at("parts").at("count"), n);
    EXPECT_LE(json.at("parts").at("faces").at("least"), json.at("faces").get<std::int64_t>() / n);
    EXPECT_GE(json.at("parts").at("faces").at("most"), json.at("faces").get<std::int64_t>() / n);
  }
}

TEST(Info, CountsAsOneProcess) {
  const TemporaryDirectory directory;
  const std::string path = (directory / "m.obj").string();
  Mesh holes = torus(9, 8);
  holes.face_sizes.clear();  // tubes with ends, and a patch of four faces beside them that only a vertex joins
  std::vector<Index> corners;
  for (Index f = 0; f < 72; ++f)
    if (f % 24 > 7) {
      corners.insert(corners.end(), holes.face_vertices.begin() + 4 * f, holes.face_vertices.begin() + 4 * f + 4);
      holes.face_sizes.push_back(4);
    }
  holes.face_vertices = corners;
  Mesh many = disjoint_union(disjoint_union(prism(5), mobius_strip(7)), glued(grid(3, 3), grid(2, 2), {15}, {0}));
  add_crease(many, {0, 1, 2}, 1.5f);
  many.corners.push_back({3, 10});
  many.holes = {2};
  many.boundary = Boundary::none;
  for (const Mesh& mesh : {holes, many, cube()}) {
    write_obj(path, mesh);
    expect_counts(path, "catmull-clark", {1, 2, 3, 4});
  }
  write_obj(path, many);
  expect_counts(path, "", {3});
  expect_counts(path, "loop", {2});
  expect_counts(path, "doo-sabin", {2});  // which has no rule for the crease
  write_obj(path, triangle_torus(6, 5));
  expect_counts(path, "loop", {3});
  write_obj(path, cube());
  expect_counts(path, "catmull-clark", {8});  // more ranks than faces
}

TEST(Info, CountsWhatIsNoManifoldAsOneProcess) {
  const TemporaryDirectory directory;
  const std::string path = (directory / "m.obj").string();
  for (const NamedMesh& mesh : tagged_unions()) {
    write_obj(path, mesh.mesh);
    expect_counts(path, mesh.schemes.front(), {2, 3});
  }
}

TEST(Info, CountsSharedMeshesAsOneProcess) {
  for (const char* name : {"catmark_rook", "catmark_nonman_verts", "catmark_nonman_edges", "catmark_nonman_bareverts",
                           "catmark_car", "loop_nonman_verts", "catmark_hole_test1"}) {
    const std::filesystem::path path = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / (std::string(name) + ".obj");
    if (std::filesystem::exists(path)) expect_counts(path.string(), "catmull-clark", {2, 3});
  }
}

}  // namespace
}  // namespace sublimit::testing
