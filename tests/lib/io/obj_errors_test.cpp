// SPDX-License-Identifier: Apache-2.0
// What an OBJ file can have wrong, and what the reader says about it: file:line, what, what would be right.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";  // 5 lines

struct BadInput {
  std::string text;
  std::vector<std::string_view> message;  // its parts
};

template <class Expected>
void expect_errors(const std::vector<BadInput>& inputs) {
  for (const BadInput& input : inputs) {
    SCOPED_TRACE(input.text);
    for (const std::string_view part : input.message) {
      expect_error<Expected>([&] { parse_obj(input.text, "a.obj"); }, {part});
    }
  }
}

TEST(ObjErrors, NumbersThatAreNone) {
  expect_errors<FormatError>({
      {"v 0 0 0\nv 0 abc 0\n", {"a.obj:2: coordinate y 'abc' is not a number", "a decimal number"}},
      {"v 0 0 1.2.3\n", {"a.obj:1: coordinate z '1.2.3'"}},
      {"v 0 0 0x10\n", {"a.obj:1: coordinate z '0x10'"}},
      {"v 0,5 0 0\n", {"a.obj:1: coordinate x '0,5'"}},
      {"v 0 0\n", {"a.obj:1: the line ends where coordinate z should be"}},
      {"v\n", {"a.obj:1: the line ends where coordinate x should be"}},
      {"v 0 1e999 0\n", {"a.obj:1: coordinate y '1e999' is too large", "1.7976931348623157e+308"}},
      {"v 0 0 0 red\n", {"a.obj:1: number behind a vertex 'red'"}},
      {"v 0 0 0\nv 0 \\\n 0 \\\n x\n", {"a.obj:4: coordinate z 'x'"}},
      {square + "f 1 2 x\n", {"a.obj:6: index 'x' is not a number", "an integer"}},
      {square + "f 1 2 3.0\n", {"a.obj:6: index '3.0'"}},
      {square + "f 1 2 /3\n", {"a.obj:6: the line ends where index should be"}},
      {square + "f 1/a 2 3\n", {"a.obj:6: index 'a'"}},
      {square + "f 1 2 99999999999999999999\n", {"a.obj:6: index '99999999999999999999' is too large"}},
      {square + "f 1/2/3/4 2 3\n", {"a.obj:6: corner '1/2/3/4' has more than 3 indices", "'a/b/c'"}},
  });
}

TEST(ObjErrors, CoordinatesThatAreNotFinite) {
  expect_errors<InvalidMesh>({
      {"v nan 0 0\n", {"a.obj:1: coordinate x is 'nan'", "finite"}},
      {"v 0 0 0\nv 0 0 -nan\n", {"a.obj:2: coordinate z is '-nan'"}},
      {"v 0 inf 0\n", {"a.obj:1: coordinate y is 'inf'"}},
      {"v 0 -infinity 0\n", {"a.obj:1: coordinate y is '-infinity'"}},
  });
}

TEST(ObjErrors, IndicesThatPointNowhere) {
  expect_errors<FormatError>({
      {square + "f 0 1 2\n", {"a.obj:6: index 0", "count from 1"}},
  });
  expect_errors<InvalidMesh>({
      {square + "f 1 2 5\n", {"a.obj:6: index 5 is out of range", "4 vertices, 1 to 4"}},
      {"f 1 2 3\nf 2 3 9\nf 1 2 5\n" + square, {"a.obj:2: index 9 is out of range", "4 vertices"}},
      {"f 1 2 \\\n3 7\n" + square, {"a.obj:2: index 7"}},
      {square + "f 1 2 4000000000\n", {"a.obj:6: index 4000000000 is out of range"}},
      {square + "f 1 2 -5\n", {"a.obj:6: index -5 counts back beyond the first of 4 vertices", "-1"}},
      {"f -1 -2 -3\n" + square, {"a.obj:1: index -1 counts back beyond the first of 0 vertices"}},
      {square + "f 1 2 -9223372036854775808\n", {"a.obj:6: index -9223372036854775808"}},
  });
}

TEST(ObjErrors, TextureCoordinates) {
  expect_errors<FormatError>({
      {square + "vt\n", {"a.obj:6: the line ends where texture coordinate should be"}},
      {square + "vt 0 x\n", {"a.obj:6: texture coordinate 'x' is not a number"}},
      {square + "vt 0 0 0 x\n", {"a.obj:6: number behind a texture coordinate 'x'"}},
  });
  expect_errors<InvalidMesh>({
      {square + "vt 0 nan\n", {"a.obj:6: texture coordinate is 'nan'", "finite"}},
      {square + "vt 0 0\nf 1/1 2/2 3/1\n",
       {"a.obj:7: texture coordinate 2 is out of range", "1 texture coordinates, 1 to 1"}},
      {square + "vt 0 0\nf 1/5 2/1 3/1\nf 1/1 2/7 3/4000000000\n",
       {"a.obj:8: texture coordinate 4000000000 is out of range"}},
      {square + "f 1/-1 2/-1 3/-1\nvt 0 0\n",
       {"a.obj:6: texture coordinate -1 counts back beyond the first so far", "-1"}},
      {square + "vt 0 0\nf 1/-1 2/-1 3/-2\n", {"a.obj:7: texture coordinate -2 counts back"}},
  });
}

TEST(ObjErrors, FacesOfFewerThanThreeCorners) {
  expect_errors<InvalidMesh>({
      {square + "f 1 2\n", {"a.obj:6: face 1 has 2 corners", "at least 3"}},
      {square + "f 1\n", {"a.obj:6: face 1 has 1 corners"}},
      {square + "\nf\n", {"a.obj:7: face 1 has 0 corners"}},
      {square + "f 1 2 # 3\n", {"a.obj:6: face 1 has 2 corners"}},
  });
}

TEST(ObjErrors, FilesThatAreNoMesh) {
  expect_errors<FormatError>({
      {"", {"a.obj: the file is empty"}},
      {std::string("v 0 0 0\nf\0", 10), {"a.obj:2: byte 9 is zero, so this is not a text OBJ file"}},
      {"v 0 0 0\n\xff\xd8\xe0JFIF 1 2\n",
       {"a.obj:2: the line starts with '\\xff\\xd8\\xe0JFIF'", "not a text OBJ file"}},
      {"\x7f"
       "ELF\n",
       {"a.obj:1: the line starts with '\\x7fELF'"}},
  });
  expect_errors<InvalidMesh>({
      {"# nothing\n", {"a.obj: no vertices", "'v x y z'"}},
      {"v 0 0 0\n", {"a.obj: no faces", "'f a b c ...'"}},
      {"f 1 2 3\n", {"a.obj: no vertices"}},
  });
}

TEST(ObjErrors, LongTokensAreShortened) {
  try {
    parse_obj("v 0 0 " + std::string(100000, 'x') + "\n", "a.obj");
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_LT(std::string_view(error.what()).size(), 200u);
  }
}

TEST(ObjErrors, MalformedTags) {
  expect_errors<FormatError>({
      {square + "t\n", {"a.obj:6: tag '' has no name", "t NAME INTS/FLOATS/STRINGS"}},
      {square + "t crease\n",
       {"a.obj:6: tag 'crease' has '' where its counts", "t crease 2/1/0 VERTEX VERTEX SHARPNESS"}},
      {square + "t crease 2/1 0 1 2\n", {"a.obj:6: tag 'crease' has '2/1' where its counts"}},
      {square + "t crease 2/1/0/0 0 1 2\n", {"a.obj:6: tag 'crease' has '2/1/0/0'"}},
      {square + "t crease 2/-1/0 0 1 2\n", {"a.obj:6: tag 'crease' has '2/-1/0'"}},
      {square + "t crease a/1/0 0 1 2\n", {"a.obj:6: tag 'crease' has 'a/1/0'"}},
      {square + "t crease 2/1/0 0 1\n", {"a.obj:6: tag 'crease' has fewer arguments than its counts say"}},
      {square + "t crease 2/1/0 0 1 2 3\n", {"a.obj:6: tag 'crease' has more arguments than its counts say"}},
      {square + "t crease 9000000000000000000/1/0 0 1 2\n", {"a.obj:6: tag 'crease' has fewer arguments"}},
      {square + "t crease 3/1/0 0 1 2 2\n", {"a.obj:6: tag 'crease' cannot have 3 integers, 1 floats"}},
      {square + "t crease 0/0/0\n", {"a.obj:6: tag 'crease' cannot have 0 integers"}},
      {square + "t crease 2/0/0 0 1\n", {"a.obj:6: tag 'crease' cannot have 2 integers, 0 floats"}},
      {square + "t crease 6/2/0 0 1 1 2 2 3 1 1\n", {"a.obj:6: tag 'crease' cannot have 6 integers, 2 floats"}},
      {square + "t corner 1/2/0 0 1 1\n", {"a.obj:6: tag 'corner' cannot have"}},
      {square + "t hole 1/1/0 0 1\n", {"a.obj:6: tag 'hole' cannot have"}},
      {square + "t interpolateboundary 0/0/0\n", {"a.obj:6: tag 'interpolateboundary' cannot have"}},
      {square + "t crease 2/1/0 0 b 2\n", {"a.obj:6: vertex 'b' is not a number"}},
      {square + "t crease 2/1/0 0 1 -2\n", {"a.obj:6: sharpness is '-2'", "0 or more"}},
      {square + "t crease 2/1/0 0 1 nan\n", {"a.obj:6: sharpness is 'nan'"}},
      {square + "t crease 2/1/0 0 1 hard\n", {"a.obj:6: sharpness 'hard' is not a number"}},
      {square + "t crease 2/1/0 0 1 1e50\n", {"a.obj:6: sharpness '1e50' is too large"}},
      {square + "t corner 1/1/0 0 -0.1\n", {"a.obj:6: sharpness is '-0.1'"}},
      {square + "t interpolateboundary 1/0/0 3\n", {"a.obj:6: interpolateboundary is '3'", "0 to 2"}},
      {square + "t interpolateboundary 1/0/0 -1\n", {"a.obj:6: interpolateboundary is '-1'"}},
      {square + "t facevaryinginterpolateboundary 1/0/0 6\n", {"a.obj:6: facevaryinginterpolateboundary", "0 to 5"}},
      {square + "t facevaryingpropagatecorners 1/0/0 2\n", {"a.obj:6: facevaryingpropagatecorners", "0 to 1"}},
      {square + "t creasemethod 0/0/1 fancy\n", {"a.obj:6: unknown value 'fancy'", "'normal' or 'chaikin'"}},
      {square + "t smoothtriangles 0/0/1 1\n", {"a.obj:6: unknown value '1'", "'catmark' or 'smooth'"}},
  });
}

TEST(ObjErrors, TagsThatPointNowhere) {
  expect_errors<InvalidMesh>({
      {square + "t crease 2/1/0 0 4 2\n", {"a.obj:6: crease: vertex 4 is out of range", "0 to 3"}},
      {square + "t crease 2/1/0 -1 0 2\n", {"a.obj:6: vertex '-1' is out of range"}},
      {square + "t crease 2/1/0 0 5000000000 2\n", {"a.obj:6: vertex '5000000000' is out of range"}},
      {square + "t corner 1/1/0 4 2\n", {"a.obj:6: corner: vertex 4 is out of range", "0 to 3"}},
      {square + "\nt hole 2/0/0 0 1\n", {"a.obj:7: hole: face 1 is out of range", "the mesh has 1"}},
      {square + "t hole 1/0/0 -1\n", {"a.obj:6: face '-1' is out of range"}},
  });
}

// Other programs write creases without an edge and indices 0 that nobody needs; the mesh is as it should be.
TEST(ObjErrors, WhatNeedsNoRefusalIsAWarning) {
  const auto warned = [](const std::string& text, size_t creases, const std::vector<std::string>& words) {
    const Mesh mesh = parse_obj(text, "a.obj");
    EXPECT_EQ(mesh.num_faces(), 1 + Index(text.find("\nf 1/") != std::string::npos));
    EXPECT_EQ(mesh.creases.size(), creases);
    ASSERT_EQ(mesh.warnings.size(), words.size()) << text;
    for (size_t i = 0; i < words.size(); ++i) EXPECT_EQ(mesh.warnings[i].find(words[i]), 0u) << mesh.warnings[i];
  };
  const std::string no_edge = "crease ignored: no face has an edge between vertices ";
  warned("t crease 2/1/0 0 1 2\nt crease 2/1/0 0 2 2\n" + square, 1, {"a.obj:2: " + no_edge + "0 and 2"});
  warned(square + "t crease 2/1/0 1 1 2\n", 0, {"a.obj:6: " + no_edge + "1 and 1"});
  warned("t crease 4/1/0 0 1 3 1 2\n" + square, 1, {"a.obj:1: " + no_edge + "3 and 1"});
  std::string many = square;
  for (int i = 0; i < 25; ++i) many += "t crease 2/1/0 0 2 2\n";
  EXPECT_EQ(parse_obj(many, "a.obj").warnings.size(), 21u);
  EXPECT_NE(parse_obj(many, "a.obj").warnings.back().find("5 further creases"), std::string::npos);
  warned(square + "f 1//0 2//0 3//0\n", 0, {"a.obj:6: index 0 of a normal taken as none"});
  warned(square + "f 1/0 2/0 3/0\n", 0, {"a.obj:6: index 0 of a texture coordinate taken as none"});
}

TEST(ObjErrors, FilesThatCannotBeRead) {
  const TemporaryDirectory directory;
  expect_error<IoError>([&] { read_obj(directory / "no.obj"); }, {"no.obj: cannot read", "No such file"});
  expect_error<IoError>([&] { read_obj(directory.path()); }, {"Is a directory"});
  const std::string path = directory.write("a.obj", "v 0 0 x\n").string();
  expect_error<FormatError>([&] { read_obj(path); }, {path + ":1: coordinate z"});
}

}  // namespace
}  // namespace sublimit::testing
