// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/write_mesh.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "meshes/random_doubles.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

/// Faces of 3 to 9 corners with vertices anywhere; coordinates of all bit patterns, subnormals and -0 among them.
Mesh random_output(std::uint64_t seed, Index vertices, Index faces) {
  std::mt19937_64 random(seed);
  Mesh mesh;
  mesh.positions = Eigen::Map<const Points>(random_doubles(seed, std::size_t(3 * vertices)).data(), vertices, 3);
  mesh.positions(0, 0) = -0.0;
  mesh.positions(0, 1) = std::numeric_limits<double>::max();
  for (Index f = 0; f < faces; ++f) {
    mesh.face_sizes.push_back(3 + Index(random() % 7));
    for (Index i = 0; i < mesh.face_sizes.back(); ++i) mesh.face_vertices.push_back(Index(random() % vertices));
  }
  return mesh;
}

void add_tags(Mesh& mesh) {
  std::mt19937 random(7);
  for (std::size_t i = 0; i + 1 < 3; ++i) {
    mesh.creases.push_back(
        {.tail = mesh.face_vertices[i], .head = mesh.face_vertices[i + 1], .sharpness = float(random() % 1000) / 97});
  }
  mesh.creases.push_back({.tail = mesh.face_vertices[0], .head = mesh.face_vertices[1], .sharpness = 1e-45f});
  mesh.corners = {{.vertex = 0, .sharpness = 0.1f}, {.vertex = 2, .sharpness = 12.5f}};
  mesh.holes = {1, 0};
  mesh.boundary = Boundary::none;
  mesh.creasing = Creasing::chaikin;
  mesh.triangles = Triangles::smooth;
}

void expect_same_bits(const Points& a, const Points& b) {
  ASSERT_EQ(a.rows(), b.rows());
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a.data()[i]), std::bit_cast<std::uint64_t>(b.data()[i]));
  }
}

void expect_same_tags(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.creases.size(), b.creases.size());
  for (std::size_t i = 0; i < a.creases.size(); ++i) {
    EXPECT_EQ(a.creases[i].tail, b.creases[i].tail);
    EXPECT_EQ(a.creases[i].head, b.creases[i].head);
    EXPECT_EQ(a.creases[i].sharpness, b.creases[i].sharpness);
  }
  ASSERT_EQ(a.corners.size(), b.corners.size());
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    EXPECT_EQ(a.corners[i].vertex, b.corners[i].vertex);
    EXPECT_EQ(a.corners[i].sharpness, b.corners[i].sharpness);
  }
  EXPECT_EQ(a.holes, b.holes);
  EXPECT_EQ(a.boundary, b.boundary);
  EXPECT_EQ(a.creasing, b.creasing);
  EXPECT_EQ(a.triangles, b.triangles);
}

/// A writer of one thread that knows nothing of blocks.
std::string plain_obj(const Mesh& mesh) {
  std::string text;
  const auto rows = [&](const char* keyword, const Points& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      text += keyword;
      for (Eigen::Index k = 0; k < points.cols(); ++k) text += " " + format_number(points(i, k));
      text += '\n';
    }
  };
  rows("v", mesh.positions);
  if (!mesh.face_varying.empty()) rows("vt", mesh.face_varying[0].values);
  rows("vn", mesh.normals);
  std::size_t corner = 0;
  for (const Index size : mesh.face_sizes) {
    text += 'f';
    for (Index i = 0; i < size; ++i, ++corner) {
      text += " " + std::to_string(mesh.face_vertices[corner] + 1);
      if (!mesh.face_varying.empty()) text += "/" + std::to_string(mesh.face_varying[0].indices[corner] + 1);
      if (mesh.normals.rows() > 0)
        text += std::string(mesh.face_varying.empty() ? "//" : "/") + std::to_string(mesh.face_vertices[corner] + 1);
    }
    text += '\n';
  }
  for (const Mesh::Crease& crease : mesh.creases)
    text += "t crease 2/1/0 " + std::to_string(crease.tail) + " " + std::to_string(crease.head) + " " +
            format_number(crease.sharpness) + "\n";
  return text;
}

std::string plain_ply(const Mesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.rows()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n";
  if (mesh.normals.rows() > 0) bytes += "property double nx\nproperty double ny\nproperty double nz\n";
  bytes += "element face " + std::to_string(mesh.face_sizes.size()) + "\nproperty list uchar int vertex_indices\n" +
           (mesh.face_varying.empty() ? "" : "property list uchar float texcoord\n") + "end_header\n";
  const auto number = [&](auto value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
  };
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
    for (const Points* const points : {&mesh.positions, &mesh.normals})
      for (Eigen::Index k = 0; k < 3 && points->rows() > 0; ++k) number(std::bit_cast<std::uint64_t>((*points)(v, k)));
  std::size_t corner = 0;
  for (const Index size : mesh.face_sizes) {
    bytes += static_cast<char>(size);
    for (Index i = 0; i < size; ++i) number(std::uint32_t(mesh.face_vertices[corner + size_t(i)]));
    if (!mesh.face_varying.empty()) bytes += static_cast<char>(2 * size);
    for (Index i = 0; i < size && !mesh.face_varying.empty(); ++i)
      for (Index k = 0; k < 2; ++k)
        number(std::bit_cast<std::uint32_t>(
            float(mesh.face_varying[0].values(mesh.face_varying[0].indices[corner + size_t(i)], k))));
    corner += size_t(size);
  }
  return bytes;
}

TEST(WriteMesh, BytesAreThoseOfAPlainWriterForAnyNumberOfThreads) {
  const TemporaryDirectory directory;
  // Vertices and faces at the ends of blocks of 2048 and 4096 rows, and of several.
  for (const Index rows : {1, 2047, 2048, 2049, 4095, 4096, 4097, 50001}) {
    Mesh mesh = random_output(std::uint64_t(rows), rows, rows);
    for (int parts = 0; parts < 3; ++parts) {
      if (parts == 1) mesh.normals = random_output(std::uint64_t(rows) + 1, rows, 1).positions;
      if (parts == 2) {
        mesh.face_varying = {{"uv", Points::Random(5, 2), std::vector<Index>(mesh.face_vertices.size(), 3)}};
        for (Index i = 0; i < rows; ++i) mesh.creases.push_back({i, 0, float(i) / 7});
      }
      const std::string obj = plain_obj(mesh), ply = plain_ply(mesh);
      EXPECT_TRUE(format_obj(mesh) == obj);  // not shown: they are long
      EXPECT_TRUE(format_ply(mesh) == ply);
      for (const std::size_t threads : {1u, 2u, 5u}) {
        SCOPED_TRACE(std::to_string(rows) + " rows, " + std::to_string(threads) + " threads");
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::int64_t written = 0;
        write_mesh(directory / "a.obj", mesh, [&](std::int64_t bytes) { written = bytes; });
        EXPECT_TRUE(read_file(directory / "a.obj") == obj);
        EXPECT_EQ(written, std::ssize(obj));
        write_mesh(directory / "a.ply", mesh);
        EXPECT_TRUE(read_file(directory / "a.ply") == ply);
      }
    }
  }
}

TEST(WriteMesh, ObjReadsBackToTheSameBitsAndTags) {
  const TemporaryDirectory directory;
  Mesh mesh = random_output(1, 30000, 20000);  // several chunks
  add_tags(mesh);
  mesh.comments = {"made by a test", "two\nlines # t crease"};
  write_mesh(directory / "a.OBJ", mesh);
  const Mesh read = read_mesh(directory / "a.OBJ");
  expect_same_bits(read.positions, mesh.positions);
  EXPECT_EQ(read.face_sizes, mesh.face_sizes);
  EXPECT_EQ(read.face_vertices, mesh.face_vertices);
  expect_same_tags(read, mesh);
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(read_file(directory / "a.OBJ"), format_obj(mesh));
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(WriteMesh, EveryOptionReadsBack) {
  Mesh mesh = random_output(2, 10, 4);
  for (const Boundary boundary : {Boundary::none, Boundary::edge_only, Boundary::edge_and_corner}) {
    for (const Creasing creasing : {Creasing::uniform, Creasing::chaikin}) {
      for (const Triangles triangles : {Triangles::catmark, Triangles::smooth}) {
        mesh.boundary = boundary;
        mesh.creasing = creasing;
        mesh.triangles = triangles;
        expect_same_tags(parse_obj(format_obj(mesh), "a.obj"), mesh);
      }
    }
  }
}

TEST(WriteMesh, InfiniteSharpnessIsWrittenAsTen) {
  Mesh mesh = random_output(3, 10, 4);
  mesh.corners = {{.vertex = 4, .sharpness = std::numeric_limits<float>::infinity()}};
  EXPECT_EQ(parse_obj(format_obj(mesh), "a.obj").corners[0].sharpness, 10.0f);
}

TEST(WriteMesh, ObjIsWhatTheManualSays) {
  Mesh mesh;
  mesh.positions = (Points(3, 3) << 0, 0, 0, 0.1, 0, 0, 0, -1e300, 0).finished();
  mesh.face_sizes = {3, 3, 3};
  mesh.face_vertices = {0, 1, 2, 2, 1, 0, 0, 1, 2};
  mesh.creases = {{.tail = 0, .head = 1, .sharpness = 2.5f}};
  mesh.comments = {"hello"};
  const std::string vertices = "# hello\nv 0 0 0\nv 0.1 0 0\nv 0 -1e+300 0\n";
  const std::string crease = "t crease 2/1/0 0 1 2.5\n";
  EXPECT_EQ(format_obj(mesh), vertices + "f 1 2 3\nf 3 2 1\nf 1 2 3\n" + crease);

  mesh.normals = (Points(3, 3) << 0, 0, 1, 0, 1, 0, 1, 0, 0).finished();
  const std::string normals = "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\n";
  EXPECT_EQ(format_obj(mesh), vertices + normals + "f 1//1 2//2 3//3\nf 3//3 2//2 1//1\nf 1//1 2//2 3//3\n" + crease);

  mesh.face_normals = {2, 2, 2, 0, -1, 0, 0, 1, 0};
  EXPECT_EQ(format_obj(mesh), vertices + normals + "f 1//3 2//3 3//3\nf 3 2 1\nf 1//1 2//2 3//1\n" + crease);
}

TEST(WriteMesh, PlyReadsBackToTheSameBits) {
  const TemporaryDirectory directory;
  Mesh mesh = random_output(4, 30000, 20000);
  mesh.comments = {"made by a test", "two\nlines"};
  write_mesh(directory / "a.ply", mesh);
  Mesh read = read_mesh(directory / "a.ply");
  expect_same_bits(read.positions, mesh.positions);
  EXPECT_EQ(read.face_sizes, mesh.face_sizes);
  EXPECT_EQ(read.face_vertices, mesh.face_vertices);
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(read_file(directory / "a.ply"), format_ply(mesh));

  mesh.normals = random_output(5, 30000, 1).positions;
  read = parse_ply(format_ply(mesh), "a.ply");
  expect_same_bits(read.positions, mesh.positions);
  EXPECT_EQ(read.face_vertices, mesh.face_vertices);
}

TEST(WriteMesh, TextureAndFaceIdsAreWhereReadersLook) {
  Mesh mesh;
  mesh.positions = (Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
  mesh.face_sizes = {3, 3, 3};
  mesh.face_vertices = {0, 1, 2, 2, 1, 0, 0, 1, 2};
  mesh.texture = (Points(3, 2) << 0, 0.25, 1, 0, 0, 1).finished();
  mesh.face_ids = {7, 7, 8};
  const std::string ply = format_ply(mesh);
  const std::string header =
      "property double z\nproperty double s\nproperty double t\nelement face 3\n"
      "property list uchar int vertex_indices\nproperty int face_id\nend_header\n";
  ASSERT_NE(ply.find(header), std::string::npos);
  const size_t data = ply.find(header) + header.size();
  EXPECT_EQ(ply.size() - data, 3 * 5 * sizeof(double) + 3 * (1 + 4 * sizeof(Index)));
  double t = 0;
  std::memcpy(&t, ply.data() + data + 4 * sizeof(double), sizeof t);
  EXPECT_EQ(t, 0.25);
  EXPECT_EQ(ply[ply.size() - 4], 8);
  EXPECT_EQ(parse_ply(ply, "a.ply").face_vertices, mesh.face_vertices);
  EXPECT_EQ(format_obj(mesh), "v 0 0 0\nv 1 0 0\nv 0 1 0\ng face_7\nf 1 2 3\nf 3 2 1\ng face_8\nf 1 2 3\n");
  mesh.face_ids = {7};
  expect_error<InvalidParameter>([&] { format_ply(mesh); }, {"an id for each face"});
}

TEST(WriteMesh, FacesOfAnySizeReadBack) {
  Mesh mesh = random_output(6, 400, 3);
  for (const Index size : {255, 256, 70000}) {
    mesh.face_sizes.push_back(size);
    for (Index i = 0; i < size; ++i) mesh.face_vertices.push_back(i % 400);
    EXPECT_EQ(parse_ply(format_ply(mesh), "a.ply").face_sizes, mesh.face_sizes);
    EXPECT_EQ(parse_obj(format_obj(mesh), "a.obj").face_vertices, mesh.face_vertices);
  }
}

TEST(WriteMesh, ControlMeshIsWrittenWithItsTags) {
  const Mesh mesh = parse_obj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt crease 2/1/0 0 1 3\nt corner 1/1/0 2 1\nt hole 1/0/0 0\n"
      "t creasemethod 0/0/1 chaikin\n",
      "a.obj");
  expect_same_tags(parse_obj(format_obj(mesh), "b.obj"), mesh);
}

TEST(WriteMesh, ObjHasRoomForOneChannelOfThreeColumns) {
  Mesh mesh = random_output(9, 10, 4);
  const std::vector<Index> indices(mesh.face_vertices.size(), 0);
  mesh.face_varying = {{"uv", Points::Zero(1, 4), indices}};
  expect_error<InvalidParameter>([&] { format_obj(mesh); }, {"1 to 3 columns"});
  mesh.face_varying = {{"uv", Points::Zero(1, 2), indices}, {"st", Points::Zero(1, 2), indices}};
  expect_error<InvalidParameter>([&] { format_obj(mesh); }, {"one face-varying channel"});
  mesh.face_varying.pop_back();
  EXPECT_EQ(parse_obj(format_obj(mesh), "a.obj").face_varying.size(), 1u);
  EXPECT_NE(format_ply(mesh).find("property list uchar float texcoord\n"), std::string::npos);
}

TEST(WriteMesh, ArraysThatDoNotFitAreRefused) {
  const Mesh good = random_output(8, 10, 4);
  const auto expect = [&](const char* part, const std::function<void(Mesh&)>& spoil) {
    Mesh mesh = good;
    spoil(mesh);
    expect_error<InvalidParameter>([&] { format_obj(mesh); }, {part});
    expect_error<InvalidParameter>([&] { format_ply(mesh); }, {part});
  };
  expect("3 columns", [](Mesh& mesh) { mesh.positions.conservativeResize(10, 2); });
  const auto with_channel = [](Mesh& mesh, Index columns) {
    mesh.face_varying.push_back({"uv", Points::Zero(1, columns), std::vector<Index>(mesh.face_vertices.size(), 0)});
  };
  expect("a face-varying value of a corner is out of range", [&](Mesh& mesh) {
    with_channel(mesh, 2);
    mesh.face_varying[0].indices[1] = 1;
  });
  expect("there should be a face-varying value for each corner", [&](Mesh& mesh) {
    with_channel(mesh, 2);
    mesh.face_varying[0].indices.pop_back();
  });
  expect("a normal for each vertex", [](Mesh& mesh) { mesh.normals = Points::Ones(9, 3); });
  expect("a normal for each corner", [](Mesh& mesh) { mesh.face_normals = {0}; });
  expect("a normal of a corner", [](Mesh& mesh) { mesh.face_normals.resize(mesh.face_vertices.size(), 0); });
}

TEST(WriteMesh, FacesAndTagsThatNoSchemeTakesAreRefusedInTheSameWords) {
  const Mesh good = random_output(8, 10, 4);
  const auto expect = [&](const char* part, const std::function<void(Mesh&)>& spoil) {
    Mesh mesh = good;
    spoil(mesh);
    expect_error<InvalidMesh>([&] { format_obj(mesh); }, {part});
    expect_error<InvalidMesh>([&] { format_ply(mesh); }, {part});
    expect_error<InvalidMesh>([&] { refine(scheme("catmull-clark"), mesh, 1); }, {part});
  };
  expect("corner 3 names vertex 10; the mesh has vertices 0 to 9", [](Mesh& mesh) { mesh.face_vertices[3] = 10; });
  expect("corner 3 names vertex -1", [](Mesh& mesh) { mesh.face_vertices[3] = -1; });
  expect("add up", [](Mesh& mesh) { mesh.face_vertices.pop_back(); });
  expect("face 0 has 2 corners", [](Mesh& mesh) { mesh.face_sizes[0] = 2; });
  expect("crease (0,10)", [](Mesh& mesh) { mesh.creases = {{.tail = 0, .head = 10, .sharpness = 1}}; });
  expect("corner -1 is not a vertex", [](Mesh& mesh) { mesh.corners = {{.vertex = -1, .sharpness = 1}}; });
  expect("corner 0 has sharpness -1", [](Mesh& mesh) { mesh.corners = {{.vertex = 0, .sharpness = -1}}; });
  expect("hole 4 is not a face", [](Mesh& mesh) { mesh.holes = {4}; });
}

TEST(WriteMesh, WhatNoReaderTakesBackIsNotWritten) {
  const TemporaryDirectory directory;
  Mesh mesh = random_output(9, 10, 4);
  mesh.positions(7, 1) = std::numeric_limits<double>::infinity();
  expect_error<InvalidMesh>([&] { write_mesh(directory / "a.obj", mesh); }, {"a.obj: vertex 7", "nothing is written"});
  expect_error<InvalidMesh>([&] { write_mesh(directory / "a.ply", mesh); }, {"a.ply: vertex 7"});
  mesh = random_output(9, 10, 4);
  mesh.normals = Points::Constant(10, 3, std::numeric_limits<double>::quiet_NaN());
  expect_error<InvalidMesh>([&] { write_mesh(directory / "a.obj", mesh); }, {"a.obj: normal 0"});
  mesh.normals.resize(0, 3);
  mesh.corners = {{.vertex = 0, .sharpness = -1}};
  expect_error<InvalidMesh>([&] { write_mesh(directory / "a.obj", mesh); }, {"a.obj: corner 0 has sharpness -1"});
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(WriteMesh, PlyHasNoNormalsPerCorner) {
  Mesh mesh = random_output(10, 10, 4);
  mesh.normals = Points::Ones(1, 3);
  mesh.face_normals.resize(mesh.face_vertices.size(), 0);
  expect_error<InvalidParameter>([&] { format_ply(mesh); }, {"one normal per vertex", "write an .obj"});
}

TEST(WriteMesh, PlacesThatCannotBeWrittenAreNamed) {
  const TemporaryDirectory directory;
  directory.write("file", "");
  const Mesh mesh = random_output(11, 10, 4);
  for (const char* const name : {"a.dae", "a", "a.obj.gz"}) {
    expect_error<InvalidOption>([&] { write_mesh(directory / name, mesh); },
                                {name, "as .obj, .ply, .off, .stl, .glb, .gltf, .usda, .usd or .usdz"});
  }
  expect_error<IoError>([&] { write_mesh(directory / "no/a.obj", mesh); }, {"no/a.obj: cannot write"});
  expect_error<IoError>([&] { write_mesh(directory / "file/a.ply", mesh); }, {"file/a.ply: cannot write"});
  expect_error<IoError>([&] { write_mesh("/proc/a.obj", mesh); }, {"/proc/a.obj: cannot write"});
  EXPECT_EQ(directory.num_files(), 1);
}

// Runs in a process of its own, with which the limit goes away.
[[noreturn]] void write_beyond_limit(const std::filesystem::path& target, const Mesh& mesh) {
  std::signal(SIGXFSZ, SIG_IGN);
  const ::rlimit limit{.rlim_cur = 100000, .rlim_max = 100000};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  int status = 0;
  try {
    write_mesh(target, mesh);
  } catch (const Error& error) {
    std::fputs(error.what(), stderr);
    status = exit_status(error.code());
  }
  ::_exit(status);
}

TEST(WriteMeshDeathTest, FullDiskLeavesNoFile) {
  const TemporaryDirectory directory;
  const Mesh mesh = random_output(12, 30000, 20000);
  for (const char* const name : {"a.obj", "a.ply"}) {
    EXPECT_EXIT(write_beyond_limit(directory / name, mesh), ::testing::ExitedWithCode(4), "File too large");
  }
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(ReadMesh, ChoosesByExtensionInEitherCase) {
  const TemporaryDirectory directory;
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read_mesh(directory.write("a.off", off)).num_faces(), 1);
  EXPECT_EQ(read_mesh(directory.write("b.Off", off)).num_faces(), 1);
  expect_error<InvalidMesh>([&] { read_mesh(directory.write("c.obj", off)); }, {"c.obj: no vertices"});
}

TEST(ReadMesh, SaysWhatItCannotRead) {
  const TemporaryDirectory directory;
  directory.write("a.dae", "solid");
  expect_error<FormatError>(
      [&] { read_mesh(directory / "a.dae"); },
      {"a.dae: unknown kind of mesh '.dae'", ".obj, .ply, .off, .stl, .glb, .gltf, .usda, .usd and .usdz"});
  expect_error<IoError>([&] { read_mesh(directory / "b.dae"); }, {"b.dae: cannot read", "No such file"});
  expect_error<IoError>([&] { read_mesh(directory.path()); }, {"Is a directory"});
}

}  // namespace
}  // namespace sublimit::testing
