// SPDX-License-Identifier: Apache-2.0
// What we write as glTF, by the validator of the Khronos Group (npm's gltf-validator): no errors, and no warnings.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/write_mesh.h"
#include "support/skip.h"

namespace sublimit::testing {
namespace {

const std::string validator = SUBLIMIT_SOURCE "/tests/npm/node_modules/gltf-validator";

/// Skips or fails a test without Node.js or the validator, which `npm ci` in tests/npm installs.
#define SUBLIMIT_NEEDS_VALIDATOR                                                     \
  SUBLIMIT_NEEDS_PROGRAM(std::system("command -v node > /dev/null") == 0, "nodejs"); \
  SUBLIMIT_NEEDS_PROGRAM(std::filesystem::exists(validator), "gltf-validator (npm ci in tests/npm)")

/// Expects that the validator says nothing about any file of a folder.
void expect_valid(const TemporaryDirectory& directory) {
  std::string files;
  size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory.path())) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".glb" && extension != ".gltf") continue;
    files += " '" + entry.path().string() + "'";
    ++count;
  }
  ASSERT_GT(count, 0u);
  const std::string out = (directory / "out").string();
  ASSERT_EQ(std::system(("node '" SUBLIMIT_SOURCE "/tests/stencils/formats/validate_gltf.js' '" + validator + "'" +
                         files + " > '" + out + "' 2>&1")
                            .c_str()),
            0)
      << read_file(out);
  EXPECT_EQ(read_file(out), std::to_string(count) + " files are fine\n");
}

std::vector<Mesh::Values> values(Index count, const std::vector<std::string>& names, ValueType type, double step) {
  std::vector<Mesh::Values> made;
  for (const std::string& name : names) {
    made.push_back({name, {}, type});
    for (Index i = 0; i < count; ++i) made.back().values.push_back(i * step);
  }
  return made;
}

/// A mesh with all that glTF has a place for.
Mesh full_mesh(Mesh mesh, ValueType colours, double step) {
  const Index vertices = mesh.num_vertices();
  mesh.normals = Points::Random(std::ssize(mesh.face_vertices), 3);
  mesh.normals.row(0).setZero();
  mesh.face_varying = {{"uv", Points::Random(5, 2), {}}};
  for (Index c = 0; c < std::ssize(mesh.face_vertices); ++c) {
    mesh.face_normals.push_back(c % 7 == 0 ? -1 : c);
    mesh.face_varying[0].indices.push_back(c % 5);
  }
  mesh.texture = Points::Random(vertices, 2);
  mesh.vertex_values = values(vertices, {"red", "green", "blue"}, colours, step);
  for (const ValueType type : {ValueType::int8, ValueType::uint8, ValueType::int16, ValueType::uint16, ValueType::int32,
                               ValueType::uint32, ValueType::float32, ValueType::float64}) {
    const auto more = values(vertices, {"of " + std::to_string(int(type)) + " \xc3\xa4\"\\"}, type, 1.5);
    mesh.vertex_values.insert(mesh.vertex_values.end(), more.begin(), more.end());
  }
  mesh.vertex_values.push_back(mesh.vertex_values.back());
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    mesh.objects.of_face.push_back(f % 3 - 1);
    mesh.materials.of_face.push_back(f % 2 - 1);
  }
  mesh.objects.names = {"a \"name\"", "\xe2\x88\x9e"};
  mesh.materials.names = {"red"};
  return mesh;
}

TEST(GltfValidator, HasNothingToSayAboutMeshes) {
  SUBLIMIT_NEEDS_VALIDATOR;
  const TemporaryDirectory directory;
  for (const std::string extension : {".glb", ".gltf"}) {
    const auto write = [&](const std::string& name, const Mesh& mesh) {
      write_mesh(directory / (name + extension), mesh);
    };
    write("cube", cube());
    write("octahedron", octahedron());
    write("full", full_mesh(cube(), ValueType::uint8, 30));
    write("full_triangles", full_mesh(octahedron(), ValueType::uint16, 9000));
    write("full_torus", full_mesh(torus(8, 6), ValueType::float32, 0.05));
    Mesh alpha = torus(8, 6);
    alpha.vertex_values = values(alpha.num_vertices(), {"alpha", "red", "green", "blue"}, ValueType::uint8, 5);
    write("alpha", alpha);
    Mesh far = octahedron();
    far.positions.rowwise() += Eigen::RowVector3d(1e7, -2e7, 1e7);
    write("far", far);
    Mesh nothing;
    nothing.positions = Points::Zero(0, 3);
    write("nothing", nothing);
  }
  expect_valid(directory);
}

TEST(GltfValidator, HasNothingToSayAboutFilesOfTheProgram) {
  SUBLIMIT_NEEDS_VALIDATOR;
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return (directory / name).string(); };
  Mesh mesh = full_mesh(cube(), ValueType::float32, 0.1);
  mesh.normals.resize(0, 3);
  mesh.face_normals.clear();
  mesh.texture.resize(0, 2);
  mesh.creases = {{.tail = 0, .head = 1, .sharpness = 2}};
  write_mesh(path("cage.obj"), mesh);
  for (const std::string extension : {".glb", ".gltf"}) {
    expect_done(sublimit(
        {"refine", path("cage.obj"), "-s", "catmull-clark", "-l", "2", "--quiet", "-o", path("refined" + extension)}));
    expect_done(sublimit({"tessellate", path("cage.obj"), "-s", "catmull-clark", "--chord", "1%", "--quiet", "-o",
                          path("surface" + extension)}));
    expect_done(sublimit({"refine", path("refined" + extension), "-s", "loop", "--triangulate", "-l", "1", "--quiet",
                          "-o", path("again" + extension)}));
  }
  expect_valid(directory);
}

}  // namespace
}  // namespace sublimit::testing
