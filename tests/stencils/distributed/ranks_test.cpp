// SPDX-License-Identifier: Apache-2.0
// Tables in shards by any numbers of ranks: the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <random>

#include "meshes/meshes.h"
#include "meshes/shared_meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "sublimit/eval/file/detail/safetensors.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/npy.h"

namespace sublimit::testing {
namespace {

/// The same mesh with vertices and faces in another order, faces beginning with other corners.
Mesh shuffled(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Index> vertex(size_t(mesh.num_vertices())), face(size_t(mesh.num_faces())), first{0};
  std::iota(vertex.begin(), vertex.end(), 0);
  std::iota(face.begin(), face.end(), 0);
  std::ranges::shuffle(vertex, random);
  std::ranges::shuffle(face, random);
  for (const Index size : mesh.face_sizes) first.push_back(first.back() + size);
  Mesh result = mesh;
  for (Index v = 0; v < mesh.num_vertices(); ++v) result.positions.row(vertex[size_t(v)]) = mesh.positions.row(v);
  result.face_sizes.clear(), result.face_vertices.clear(), result.holes.clear();
  for (size_t i = 0; i < face.size(); ++i) {
    const Index f = face[i], size = mesh.face_sizes[size_t(f)];
    const auto turn = Index(random() % unsigned(size));
    result.face_sizes.push_back(size);
    for (Index k = 0; k < size; ++k)
      result.face_vertices.push_back(vertex[size_t(mesh.face_vertices[size_t(first[size_t(f)] + (k + turn) % size)])]);
    if (std::ranges::count(mesh.holes, f) > 0) result.holes.push_back(Index(i));
  }
  for (auto& crease : result.creases)
    crease.tail = vertex[size_t(crease.tail)], crease.head = vertex[size_t(crease.head)];
  for (auto& corner : result.corners) corner.vertex = vertex[size_t(corner.vertex)];
  return result;
}

struct RanksCase {
  const char *name, *options;
  Mesh mesh;
};
std::vector<RanksCase> ranks_cases() {
  Mesh tagged = torus(9, 7);
  add_crease(tagged, {0, 7, 14, 21}, {10, 2.5f, 1.5f});
  add_crease(tagged, {3, 10, 17}, {0.5f, 0.5f});
  tagged.corners = {{5, 10}, {12, 1.5f}};
  tagged.holes = {30};
  Mesh apart = disjoint_union(jittered(grid(4, 3)), disjoint_union(cube(), pole(7)));
  apart.positions.conservativeResize(apart.num_vertices() + 2, 3);
  apart.positions.bottomRows(2).setConstant(0.125);  // of no face
  Mesh chaikin = tagged;
  chaikin.creasing = Creasing::chaikin;
  return {{"tags in random order", "-s catmull-clark -l 2", shuffled(tagged, 5)},
          {"chaikin", "-s catmull-clark -l 3", shuffled(chaikin, 6)},
          {"components, polygons, points alone", "-s catmull-clark -l 2", shuffled(apart, 7)},
          {"limits of polygons", "-s catmull-clark -l 1 --limit", prism(5)},
          {"non-manifold", "-s catmull-clark -l 2", mobius_strip(5)},
          {"valence 1000", "-s catmull-clark -l 1", fan(1000)},
          {"triangles", "-s loop -l 2", shuffled(triangle_torus(6, 5), 8)},
          {"cut into triangles", "-s loop -l 1 --triangulate", shuffled(tagged, 9)},
          {"wide masks", "-s butterfly -l 2", triangle_torus(5, 4)}};
}

TEST(Ranks, AnyNumberOfThemMakesTheSameBits) {
  for (const RanksCase& c : ranks_cases()) {
    const TemporaryDirectory directory;
    const std::string obj = (directory / "m.obj").string(), npy = (directory / "o.npy").string();
    write_obj(obj, c.mesh);
    std::string one;
    for (const int ranks : {1, 2, 3, 4}) {
      const std::string shards = (directory / ("d" + std::to_string(ranks))).string();
      const RanksRun bake = run_ranks(ranks, "bake " + obj + " " + c.options + " -o " + shards);
      ASSERT_EQ(bake.status, 0) << c.name << ": " << bake.err;
      if (ranks == 1) {  // a shard is a table
        ASSERT_EQ(run_alone("apply " + shards + "/shard-0001-of-0001.safetensors " + obj + " -o " + npy), 0) << c.name;
        one = read_file(npy);
        std::filesystem::remove(npy);
      }
      const RanksRun apply = run_ranks(5 - ranks, "apply " + shards + " " + obj + " -o " + npy);
      ASSERT_EQ(apply.status, 0) << c.name << ": " << apply.err;
      EXPECT_EQ(read_file(npy), one) << c.name << ": baked by " << ranks << ", applied by " << 5 - ranks;
      std::filesystem::remove(npy);
    }
    EXPECT_EQ(run_ranks(2, "verify " + (directory / "d3").string()).status, 0) << c.name;
  }
}

TEST(Ranks, MayBeMoreThanFacesAndShardsOtherThanRanks) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string();
  write_obj(obj, cube());
  std::vector<std::string> points;
  int number = 0;
  for (const char* how : {"1", "8", "2 --shards 5", "3 --shards 11 --partition runs", "2 --rings 9"}) {
    const std::string shards = (directory / std::to_string(++number)).string(), npy = shards + ".npy";
    const std::string options(how + 1);
    const RanksRun bake = run_ranks(how[0] - '0', "bake " + obj + " -s catmull-clark -l 3" + options + " -o " + shards);
    ASSERT_EQ(bake.status, 0) << how << bake.err;
    ASSERT_EQ(run_ranks(3, "apply " + shards + " " + obj + " -o " + npy).status, 0) << how;
    points.push_back(read_file(npy));
    EXPECT_EQ(points.back(), points.front()) << how;
  }
}

/// The mesh as `read_spread_mesh` takes it in tensors.
void write_tensors(const std::filesystem::path& path, const Mesh& mesh) {
  Safetensors file;
  std::vector<std::int32_t> creases;
  std::vector<float> sharpness;
  for (const auto& c : mesh.creases) creases.insert(creases.end(), {c.tail, c.head}), sharpness.push_back(c.sharpness);
  const std::span<const double> x(mesh.positions.data(), size_t(mesh.positions.size()));
  file.tensors = {tensor<double>("positions", x, {mesh.num_vertices(), 3}),
                  tensor<std::int32_t>("face_sizes", mesh.face_sizes, {mesh.num_faces()}),
                  tensor<std::int32_t>("face_vertices", mesh.face_vertices, {std::ssize(mesh.face_vertices)}),
                  tensor<std::int32_t>("creases", creases, {std::ssize(sharpness), 2}),
                  tensor<float>("crease_sharpness", sharpness, {std::ssize(sharpness)})};
  write_safetensors(path, std::move(file));
}

TEST(Ranks, ReadAndWriteTheFormatsThatSaySo) {
  const TemporaryDirectory directory;
  const Mesh mesh = torus(4, 3);
  const std::string cage = (directory / "cage.obj").string();
  write_obj(cage, mesh);
  size_t read = 0, written = 0;
  for (const FileFormat& row : all_formats().rows()) {
    const std::string extension(row.extensions[0]);
    SCOPED_TRACE(extension);
    const std::string in = (directory / "in").string() + extension, out = (directory / "out").string() + extension;
    const bool is_read = all_formats().reads(in, contents::mesh_parts);
    const bool is_written =
        all_formats().writes(out, contents::mesh_parts) || all_formats().writes(out, contents::arrays);
    if (!is_read && !is_written && !io_formats().find(in)) continue;  // what is no mesh elsewhere either
    if (all_formats().writes(in, contents::meshes))
      write_mesh(in, mesh);
    else if (is_read)
      write_tensors(in, mesh);
    else
      write_obj(in, mesh);
    const RanksRun info = run_ranks(1, "info " + in);
    EXPECT_EQ(info.status, is_read ? 0 : 3) << info.err;
    if (!is_read) {
      const std::string error = info.error();
      EXPECT_TRUE(error.find("'; .obj, binary .ply and .safetensors can be read") != std::string::npos ||
                  error.find("MESH is a control mesh, .obj, .ply or .safetensors") != std::string::npos)
          << error;
    }
    const RanksRun refine = run_ranks(1, "refine " + cage + " -s catmull-clark -l 1 -o " + out);
    EXPECT_EQ(refine.status, is_written ? 0 : 2) << refine.err;
    if (is_written) {
      const FileFormat* const found = all_formats().recognized(read_file(out));
      ASSERT_TRUE(found);
      EXPECT_EQ(found->name, row.name);
    } else {
      EXPECT_NE(refine.error().find("'; .npy and .ply can be written"), std::string::npos) << refine.err;
    }
    read += is_read, written += is_written;
  }
  EXPECT_EQ(read, 3u);
  EXPECT_EQ(written, 2u);
}

TEST(Ranks, ReadTheirBytesOfEveryKindOfFile) {
  const TemporaryDirectory directory;
  Mesh mesh = shuffled(disjoint_union(torus(6, 5), prism(5)), 3);
  const Index a = mesh.face_vertices[0], b = mesh.face_vertices[1];
  mesh.creases = {{a, b, 1.5f}};
  write_obj(directory / "m.obj", mesh);
  write_tensors(directory / "m.safetensors", mesh);
  std::filesystem::create_directory(directory / "p");
  write_mesh(directory / "p/m.ply", mesh);  // without tags, which lie beside it
  std::ofstream(directory / "p/m.json") << "{\"creaseIndices\": [" << a << ", " << b
                                        << "], \"creaseLengths\": [2], \"creaseSharpnesses\": [1.5]}";
  std::string one;
  for (const char* name : {"m.obj", "m.safetensors", "p/m.ply"}) {
    const std::string path = (directory / name).string(), shards = path + ".shards", npy = path + ".npy";
    const RanksRun bake = run_ranks(3, "bake " + path + " -s catmull-clark -l 2 -o " + shards);
    ASSERT_EQ(bake.status, 0) << name << bake.err;
    ASSERT_EQ(run_ranks(2, "apply " + shards + " " + path + " -o " + npy).status, 0) << name;
    if (one.empty()) one = read_file(npy);
    EXPECT_EQ(read_file(npy), one) << name;
  }
  // Frames, and a .ply of points.
  const Eigen::Index size = mesh.positions.size();
  std::vector<double> frames(size_t(2 * size));
  for (Eigen::Index i = 0; i < size; ++i)
    frames[size_t(i)] = mesh.positions.data()[i], frames[size_t(size + i)] = 2 * mesh.positions.data()[i];
  NpyWriter writer(directory / "poses.npy", DType::F64, {2, mesh.num_vertices(), 3});
  writer.write<double>(frames);
  writer.commit();
  const std::string shards = (directory / "m.obj.shards").string();
  const std::string out = (directory / "out.npy").string(), ply = (directory / "out.ply").string();
  ASSERT_EQ(run_ranks(2, "apply " + shards + " " + (directory / "poses.npy").string() + " -o " + out).status, 0);
  const NpyArray both(out), single(directory / "m.obj.npy");
  ASSERT_EQ(both.shape(), (std::vector<std::int64_t>{2, single.shape()[0], 3}));
  std::vector<double> made(size_t(both.size())), first(size_t(single.size()));
  both.read<double>(0, made);
  single.read<double>(0, first);
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(made[i], first[i]);
    EXPECT_EQ(made[first.size() + i], 2 * first[i]);  // linear, and 2 is a power of 2
  }
  ASSERT_EQ(run_ranks(3, "apply " + shards + " " + (directory / "m.obj").string() + " -o " + ply).status, 0);
  const std::string bytes = read_file(ply);
  EXPECT_EQ(bytes.substr(bytes.size() - 8 * first.size()), one.substr(one.size() - 8 * first.size()));
}

TEST(Ranks, SharedMeshes) {
  if (shared_meshes().empty()) GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES;
  const bool all = std::getenv("SUBLIMIT_FULL") != nullptr;
  for (const SharedMesh& shared : shared_meshes()) {
    const std::string& name = shared.name;
    const std::string path = shared.path.string();
    const bool is_some = name.find("nonman") != std::string::npos || name.find("car") != std::string::npos ||
                         name.find("semisharp") != std::string::npos;
    if (!all && !is_some) continue;
    const TemporaryDirectory directory;
    std::string one;
    const std::string scheme = name.starts_with("loop") ? "loop" : "catmull-clark";
    for (const int ranks : {1, 3}) {
      const std::string shards = (directory / std::to_string(ranks)).string(), npy = shards + ".npy";
      const RanksRun bake = run_ranks(ranks, "bake " + path + " -s " + scheme + " -l 2 -o " + shards);
      ASSERT_EQ(bake.status, 0) << name << bake.err;
      ASSERT_EQ(run_ranks(4 - ranks, "apply " + shards + " " + path + " -o " + npy).status, 0) << name;
      if (ranks == 1) one = read_file(npy);
      EXPECT_EQ(read_file(npy), one) << name;
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
