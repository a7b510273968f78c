// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/off.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string square = "OFF\n4 1 4\n" + points + "4 0 1 2 3\n";

using Ids = std::vector<Index>;

TEST(Off, ReadsPositionsAndFaces) {
  const Mesh mesh = parse_off("OFF\n4 2 5\n0.1 0 0\n1 0 0\n1 1 -2e-3\n0 1 0\n3 0 1 2\n4 0 1 2 3\n", "a.off");
  EXPECT_EQ(mesh.num_vertices(), 4);
  EXPECT_EQ(mesh.positions.row(2), Eigen::RowVector3d(1, 1, -0.002));
  EXPECT_EQ(mesh.face_sizes, (Ids{3, 4}));
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 1, 2, 3}));
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Off, HeadersComeInManyForms) {
  for (const std::string& text : std::vector<std::string>{
           "OFF 4 1 4\n" + points + "4 0 1 2 3",
           "OFF\n4 1\n" + points + "4 0 1 2 3",
           "# made by hand\n\nOFF # yes\n# counts\n4 1 4\n\n" + points + "\n# face\n4 0 1 2 3 # square\n\n",
           "OFF\r\n4 1 4\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3\r\n",
       }) {
    const Mesh mesh = parse_off(text, "a.off");
    EXPECT_EQ(mesh.positions, parse_off(square, "a.off").positions) << text;
    EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 3})) << text;
    EXPECT_TRUE(mesh.warnings.empty()) << text;
  }
}

TEST(Off, ColoursNormalsAndTextureCoordinatesAreDropped) {
  for (const char* const keyword : {"COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}) {
    const Mesh mesh = parse_off(
        std::string(keyword) + "\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 255 0 0 255\n0 1 0 .5 .5\n" + "3 0 1 2 0.1 0.2 0.3\n",
        "a.off");
    EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(1, 0, 0));
    EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
  }
}

TEST(Off, LinesBehindTheLastFaceAreWarnedAbout) {
  const Mesh mesh = parse_off(square + "3 0 1 2\n", "a.off");
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(mesh.warnings[0], "a.off:8: lines behind the last face ignored");
}

TEST(Off, SaysWhatCannotBeUnderstood) {
  const auto expect = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text);
    expect_error<FormatError>([&] { parse_off(text, "a.off"); }, parts);
  };
  expect("", {"a.off: the file is empty"});
  expect("# only\n", {"a.off:", "the file starts with ''", "starts with 'OFF'"});
  expect("ply\n", {"a.off:1: the file starts with 'ply'"});
  expect("4OFF\n4 1 4\n", {"a.off:1: '4OFF' has points of other than 3 dimensions"});
  expect(std::string("OFF\n\0", 5), {"a.off:2: byte 4 is zero", "not a text OFF file"});
  expect(std::string("OFF BINARY\n\0\0\0\1", 15), {"a.off:1: binary OFF; only text can be read"});
  expect("OFF\n", {"number of vertices"});
  expect("OFF\n4 x 4\n" + points, {"a.off:2: number of faces 'x' is not a number"});
  expect("OFF\n4 1 x\n" + points, {"a.off:2: number of edges 'x'"});
  expect("OFF\n-4 1 4\n" + points, {"a.off:2: -4 vertices cannot be in the"});
  expect("OFF\n4000000000 1 4\n" + points, {"a.off:2: 4000000000 vertices cannot be in the 29 bytes that follow"});
  expect("OFF\n4 2000000000 4\n" + points, {"a.off:2: 2000000000 faces cannot be in"});
  expect("OFF\n4 1 4\n0 0 0\n1 0\n\n\n\n\n\n\n\n\n\n\n\n\n\n", {"a.off:4: the line ends where coordinate z should be"});
  expect("OFF\n4 1 4\n0 0 0\n1 y 0\n0 1 0\n0 0 1\n", {"a.off:4: coordinate y 'y' is not a number"});
  expect("OFF\n3 1 4\n0 0 0\n1 0 0\n      \n", {"a.off:", "the file ends at vertex 2 of 3"});
  expect("OFF\n4 1 4\n" + points + "       \n", {"the file ends at face 0 of 1"});
  expect("OFF\n4 1 4\n" + points + "4 0 1 2\n", {"a.off:7: the line ends where index should be"});
  expect("OFF\n4 1 4\n" + points + "3 0 1 2 red\n", {"a.off:7: number at the end 'red'"});
}

TEST(Off, SaysWhatIsNoMesh) {
  const auto expect = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text);
    expect_error<InvalidMesh>([&] { parse_off(text, "a.off"); }, parts);
  };
  expect("OFF\n0 0 0\n", {"a.off:2: no vertices"});
  expect("OFF\n4 0 0\n" + points, {"a.off:2: no faces"});
  expect("OFF\n4 1 4\n" + points + "3 0 1 4\n", {"a.off:7: index 4 is out of range", "4 vertices, 0 to 3"});
  expect("OFF\n4 1 4\n" + points + "3 0 1 -1\n", {"a.off:7: index -1 is out of range"});
  expect("OFF\n4 1 4\n" + points + "2 0 1   \n", {"a.off:7: face 0 has 2 corners", "at least 3"});
  expect("OFF\n4 1 4\n0 0 nan\n" + points, {"a.off:3: coordinate z is 'nan'", "finite"});
}

TEST(Off, ReadsFiles) {
  const TemporaryDirectory directory;
  EXPECT_EQ(read_off(directory.write("a.off", square)).num_faces(), 1);
  expect_error<IoError>([&] { read_off(directory / "no.off"); }, {"no.off: cannot read"});
}

}  // namespace
}  // namespace sublimit::testing
