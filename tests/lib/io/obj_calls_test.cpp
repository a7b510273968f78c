// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_calls.h"

#include <gtest/gtest.h>

#include "sublimit/base/error.h"
#include "sublimit/io/read_mesh.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

const std::string four_points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjCalls, LinesOfFilesStandInPlaceOfTheirCalls) {
  const TemporaryDirectory directory;
  directory.write("points.obj", "g one\n" + four_points);
  directory.write("inner.obj", "f 1 2 3");  // no line end
  directory.write("faces.obj", "call inner.obj\r\nf 1 3 4\r\n");
  const std::string path =
      directory.write("main.obj", "# call nobody.obj\n  call points.obj\nusemtl red\ncall faces.obj\nf 1 2 4\n")
          .string();
  const Mesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.num_vertices(), 4);
  EXPECT_EQ(mesh.face_vertices, (std::vector<Index>{0, 1, 2, 0, 2, 3, 0, 1, 3}));
  EXPECT_EQ(mesh.groups.names, std::vector<std::string>{"one"});
  EXPECT_EQ(mesh.materials.of_face, (std::vector<Index>{0, 0, 0}));
  EXPECT_TRUE(mesh.warnings.empty());
}

// A message names the line of the file that it is in.
TEST(ObjCalls, MessagesNameTheCalledFile) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const TemporaryDirectory directory;
    const auto lines = [&](std::vector<std::string> all) {
      std::string text;
      for (const std::string& line : all) text += line + end;
      return text;
    };
    const std::string points_file = directory.write("points.obj", lines({"v 0 0 0", "v 1 0 0", "v 1 1 0"})).string();
    const std::string faces = directory.write("faces.obj", lines({"", "f 1 2 3", "f 1 2 9", "bzp"})).string();
    const std::string main =
        directory.write("main.obj", lines({"", "call points.obj", "call faces.obj", "bad 1"})).string();
    expect_error<InvalidMesh>([&] { (void)read_mesh(main); }, {faces + ":3: index 9 is out of range"});
    directory.write("faces.obj", lines({"", "f 1 2 3", "", "bzp"}));
    const Mesh mesh = read_mesh(main);
    ASSERT_EQ(mesh.warnings.size(), 2u);
    EXPECT_EQ(mesh.warnings[0], faces + ":4: unknown keyword 'bzp' ignored");
    EXPECT_EQ(mesh.warnings[1], main + ":4: unknown keyword 'bad' ignored");
    directory.write("points.obj", lines({"v 0 0 0", "v 1 x 0", "v 1 1 0"}));
    expect_error<FormatError>([&] { (void)read_mesh(main); }, {points_file + ":2: coordinate y 'x'"});
  }
}

TEST(ObjCalls, WhatIsLeftOutIsTold) {
  const TemporaryDirectory directory;
  const std::string path =
      directory.write("main.obj", "call none.obj\n" + four_points + "call a.obj 1 2\nf 1 2 3\ncall\ncaller\ncall .\n")
          .string();
  const Mesh mesh = read_mesh(path);
  ASSERT_EQ(mesh.warnings.size(), 5u);
  EXPECT_EQ(mesh.warnings[0], path + ":1: call of 'none.obj' left out: there is no such file");
  EXPECT_EQ(mesh.warnings[1], path + ":6: call of 'a.obj 1 2' left out: arguments of calls are not understood");
  EXPECT_EQ(mesh.warnings[2], path + ":8: call left out: it names no file");
  EXPECT_EQ(mesh.warnings[3], path + ":10: call of '.' left out: it is a directory");
  EXPECT_EQ(mesh.warnings[4], path + ":9: unknown keyword 'caller' ignored");
  // Where the faces are missing, they may be in the file that is.
  directory.write("main.obj", four_points + "call faces.obj\n");
  expect_error<InvalidMesh>([&] { (void)read_mesh(path); },
                            {"no faces", "; " + path + ":5: call of 'faces.obj' left out: there is no such file"});
}

TEST(ObjCalls, FilesThatMultiplyAreRefused) {
  const TemporaryDirectory directory;
  for (int i = 0; i < 30; ++i) {
    const std::string next = "call b" + std::to_string(i + 1) + ".obj\n";
    directory.write("b" + std::to_string(i) + ".obj", next + next);
  }
  directory.write("b30.obj", four_points + "f 1 2 3\n");
  expect_error<FormatError>([&] { (void)read_mesh(directory / "b0.obj"); }, {"more than 1000 calls", "into one file"});
}

TEST(ObjCalls, CirclesAreRefused) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.obj", four_points + "f 1 2 3\ncall b.obj\n").string();
  const std::string other = directory.write("b.obj", "call ./a.obj\n").string();
  expect_error<FormatError>([&] { (void)read_mesh(path); }, {other + ":1: call of './a.obj'", "in a circle"});
  directory.write("b.obj", "call c.obj\ncall c.obj\n");
  directory.write("c.obj", "f 1 2 4\n");  // twice is no circle
  EXPECT_EQ(read_mesh(path).num_faces(), 3);
}

}  // namespace
}  // namespace sublimit::testing
