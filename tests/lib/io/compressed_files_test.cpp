// SPDX-License-Identifier: Apache-2.0
// Compressed files by the names of formats.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/io/detail/formats.h"
#include "sublimit/io/detail/obj_normals.h"
#include "sublimit/io/detail/polygon_files.h"
#include "sublimit/io/free_form.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "support/expect_error.h"
#include "support/gzip_bytes.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

// Every format of meshes is read compressed, under its name and under the name with .gz behind it.
TEST(CompressedFiles, MeshesOfAllFormatsAreRead) {
  const TemporaryDirectory directory;
  for (const std::string& extension : io_formats().readers({contents::meshes})) {
    SCOPED_TRACE(extension);
    write_mesh(directory / ("a" + extension), cube());
    const std::string bytes = compressed(read_file(directory / ("a" + extension)));
    const Mesh plain = read_mesh(directory / ("a" + extension));
    for (const std::string& name : {"b" + extension, "b" + extension + ".gz", "b" + extension + ".GZ"}) {
      const Mesh mesh = read_mesh(directory.write(name, bytes));
      EXPECT_EQ(mesh.positions, plain.positions);
      EXPECT_EQ(mesh.face_vertices, plain.face_vertices);
    }
    const auto unpacked = directory.write("c" + extension + ".gz", read_file(directory / ("a" + extension)));
    EXPECT_EQ(read_mesh(unpacked).face_vertices, plain.face_vertices);
    expect_error<FormatError>([&] { (void)read_mesh(directory.write("d" + extension, bytes.substr(0, 40))); },
                              {"d" + extension + ": byte 40: the compressed file ends too early"});
  }
}

TEST(CompressedFiles, OtherContentsOfMeshFilesAreRead) {
  const TemporaryDirectory directory;
  Mesh mesh = cube();
  mesh.normals = Points::Random(8, 3);
  EXPECT_EQ(read_obj_normals(directory.write("a.obj.gz", compressed([&] {
                                               write_mesh(directory / "a.obj", mesh);
                                               return read_file(directory / "a.obj");
                                             }()))),
            mesh.normals);
  const auto curve = directory.write(
      "b.obj.gz", compressed("v 0 0 0\nv 1 2 3\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n"));
  EXPECT_EQ(read_free_form(curve).curves.size(), 1u);
  EXPECT_EQ(read_polygon(directory.write("c.csv.gz", compressed("0,0\n1,1\n2,0\n"))).points.rows(), 3);
  EXPECT_EQ(read_polygon(directory.write("c.obj", compressed("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n"))).points.rows(),
            3);
}

TEST(CompressedFiles, NothingIsWrittenUnderSuchAName) {
  const TemporaryDirectory directory;
  for (const std::string& extension : io_formats().writers({contents::meshes})) {
    const auto path = directory / ("a" + extension + ".gz");
    EXPECT_TRUE(io_formats().reads(path, contents::meshes));
    EXPECT_FALSE(io_formats().writes(path, contents::meshes));
    expect_error<InvalidOption>([&] { write_mesh(path, cube()); },
                                {"not as '" + extension + ".gz'", "compressed files are read, not written"});
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  expect_error<FormatError>([&] { (void)read_mesh(directory.write("a.gz", compressed("v 0 0 0\n"))); },
                            {"unknown kind of mesh '.gz'"});
  expect_error<FormatError>([&] { (void)read_mesh(directory.write("a.xyz.gz", compressed("v 0 0 0\n"))); },
                            {"unknown kind of mesh '.xyz.gz'"});
}

}  // namespace
}  // namespace sublimit::testing
