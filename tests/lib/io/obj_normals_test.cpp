// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_normals.h"

#include <gtest/gtest.h>

#include <string>

#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nvn 0 3 4\n";  // 7 lines

Points parsed(const std::string& text) { return parse_obj_normals(text, "a.obj"); }

TEST(ObjNormals, AreThoseOfCorners) {
  const Points normals = parsed(points + "f 1//1 2//2 3//1\n");
  ASSERT_EQ(normals.rows(), 4);
  EXPECT_EQ(normals.row(0), Eigen::RowVector3d(0, 0, 1));
  EXPECT_EQ(normals.row(1), Eigen::RowVector3d(0, 3, 4));
  EXPECT_EQ(normals.row(3), Eigen::RowVector3d(0, 0, 0));  // no face has it
  EXPECT_EQ(parsed(points + "f 1/1/1 2/1/2 3/1/1\n"), normals);
  EXPECT_EQ(parsed(points + "f -4//-2 -3//-1 \\\n -2//-2\n"), normals);
  // What comes later may be named; equal values agree, whatever their numbers.
  EXPECT_EQ(parsed(points + "f 1//3 2//2 3//1\nf 2//2 1//1 3//3\nvn 0 0 1\n"), normals);
}

TEST(ObjNormals, MayBeAbsent) {
  EXPECT_EQ(parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").rows(), 0);
  EXPECT_EQ(parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1/ 3/1\n").rows(), 0);
}

TEST(ObjNormals, SayWhatIsWrong) {
  const auto invalid = [](const std::string& faces, std::initializer_list<std::string_view> parts) {
    expect_error<InvalidMesh>([&] { parsed(points + faces); }, parts);
  };
  invalid("f 1 2 3\n", {"a.obj", "2 normals (vn) that no face names", "a//c"});
  invalid("f 1//1 2//1 3//1\nf 2//1 4 3//1\n", {"a.obj:9", "vertex 3 without a normal"});
  invalid("f 1//1 2//1 3//1\nf 2//2 4//1 3//1\n", {"a.obj:9: vertex 1", "vn 2", "line 8, vn 1"});
  invalid("f 1//1 2//1 3//3\n", {"a.obj:8: index 3 is out of range", "2 normals"});
  invalid("f 1//1 2//1 3//-3\n", {"a.obj:8: index -3 counts back"});
  invalid("f 1//1 2//1 5//1\n", {"a.obj:8: index 5 is out of range", "4 vertices"});
  invalid("vn 0 nan 1\n", {"a.obj:8", "normal y", "'nan'"});
  expect_error<FormatError>([&] { parsed(points + "vn 0 1\n"); }, {"a.obj:8", "normal z"});
  expect_error<FormatError>([&] { parsed(points + "f 1//x 2//1 3//1\n"); }, {"a.obj:8", "'x'"});
  expect_error<FormatError>([&] { parsed(points + "f 1//0 2//1 3//1\n"); }, {"a.obj:8", "index 0"});
  expect_error<FormatError>([&] { parsed(""); }, {"a.obj"});
}

}  // namespace
}  // namespace sublimit::testing
