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
           "OFF4 1 4\n" + points + "4 0 1 2 3",
           "OFF4\n1\n4\n" + points + "4 0 1 2 3",
           "OFF\n4 1\n4\n0\n0 0 1\n0 0 # two vertices\n1 1 0 0 1 0\n4 0 # corners\n1\n2 3",
           "OFF 4 1 4 0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3",
           "OFF\r\n4 1 4\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3\r\n",
       }) {
    const Mesh mesh = parse_off(text, "a.off");
    EXPECT_EQ(mesh.positions, parse_off(square, "a.off").positions) << text;
    EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 3})) << text;
    EXPECT_TRUE(mesh.warnings.empty()) << text;
  }
}

// A triangle whose vertices have what a keyword announces, as a line each or as lines of their own.
std::string triangle(const std::string& keyword, const std::vector<std::string>& behind) {
  const std::string at[] = {"0 0 0", "1 0 0", "0 1 0"};
  std::string text = keyword + "\n3 1 0\n";
  for (const std::string& point : at) {
    text += point;
    for (const std::string& part : behind) text += part;
    text += "\n";
  }
  return text + "3 0 1 2\n";
}

void expect_channel(const Mesh::Values& channel, const std::string& name, const std::vector<double>& values,
                    ValueType type) {
  EXPECT_EQ(channel.name, name);
  EXPECT_EQ(channel.values, values);
  EXPECT_EQ(channel.type, type);
}

TEST(Off, ColoursOfVerticesAreKept) {
  for (const std::string text : {
           "COFF\n3 1 0\n0 0 0 255 0 1 9\n1 0 0 128 2 1 8\n0 1 0 0 3 1 7\n3 0 1 2\n",
           "COFF\n3 1 0\n0 0 0\n255 0 1 9\n1 0 0\n128 2 1 8\n0 1 0 0\n3 1 7\n3 0 1 2\n",
           "COFF3 1 0 0 0 0 255 0 1 9 1 0 0 128 2 1 8 0 1 0 0 3 1 7\n3 0 1 2\n",
       }) {
    SCOPED_TRACE(text);
    const Mesh mesh = parse_off(text, "a.off");
    EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(1, 0, 0));
    EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
    EXPECT_TRUE(mesh.warnings.empty());
    ASSERT_EQ(mesh.vertex_values.size(), 4u);
    expect_channel(mesh.vertex_values[0], "red", {255, 128, 0}, ValueType::uint8);
    expect_channel(mesh.vertex_values[1], "green", {0, 2, 3}, ValueType::uint8);
    expect_channel(mesh.vertex_values[2], "blue", {1, 1, 1}, ValueType::uint8);
    expect_channel(mesh.vertex_values[3], "alpha", {9, 8, 7}, ValueType::uint8);
    EXPECT_TRUE(mesh.face_values.empty());
  }
}

TEST(Off, ColoursOfZeroToOneAreReals) {
  for (const std::string& text : {triangle("COFF", {" 0.5 0 1"}), triangle("COFF", {"\n0.5 0 1"})}) {
    const Mesh mesh = parse_off(text, "a.off");
    ASSERT_EQ(mesh.vertex_values.size(), 3u) << text;
    expect_channel(mesh.vertex_values[0], "red", {0.5, 0.5, 0.5}, ValueType::float32);
    expect_channel(mesh.vertex_values[2], "blue", {1, 1, 1}, ValueType::float32);
    EXPECT_TRUE(mesh.warnings.empty());
  }
}

TEST(Off, NormalsComeBeforeColoursAndTheseBeforeTextureCoordinates) {
  const std::string normal = " 0 0 -1", colour = " 10 20 30", alpha = " 40", texture = " 0.5 7";
  for (const std::string end : {"", "\n"}) {
    const std::string n = end + normal, c = end + colour, a = end + colour + alpha, t = end + texture;
    for (const auto& [text, channels] : std::vector<std::pair<std::string, std::size_t>>{
             {triangle("NOFF", {n}), 0},
             {triangle("STOFF", {t}), 2},
             {triangle("STNOFF", {n, t}), 2},
             {triangle("CNOFF", {n, c}), 3},
             {triangle("CNOFF", {n, a}), 4},
             {triangle("STCOFF", {c, t}), 5},
             {triangle("STCOFF", {a, t}), 6},
             {triangle("STCNOFF", {n, c, t}), 5},
             {triangle("STCNOFF", {n, a, t}), 6},
         }) {
      SCOPED_TRACE(text);
      const Mesh mesh = parse_off(text, "a.off");
      EXPECT_EQ(mesh.positions.row(2), Eigen::RowVector3d(0, 1, 0));
      EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
      ASSERT_EQ(mesh.vertex_values.size(), channels);
      const bool has_texture = text.starts_with("ST"), has_normals = text.find("NOFF") != std::string::npos;
      const std::size_t colours = has_texture ? channels - 2 : channels;
      for (std::size_t k = 0; k < colours; ++k)
        EXPECT_EQ(mesh.vertex_values[k].values, std::vector<double>(3, 10.0 * double(k + 1)));
      if (has_texture) {
        expect_channel(mesh.vertex_values[colours], "s", {0.5, 0.5, 0.5}, ValueType::float64);
        expect_channel(mesh.vertex_values[colours + 1], "t", {7, 7, 7}, ValueType::float64);
      }
      EXPECT_EQ(mesh.notes, has_normals ? std::vector<std::string>{"a.off: normals of vertices left out; those of the "
                                                                   "surface are used instead"}
                                        : std::vector<std::string>());
      EXPECT_TRUE(mesh.warnings.empty());
    }
  }
}

TEST(Off, NumbersThatTheKeywordDoesNotAnnounceAreIgnored) {
  const Mesh mesh = parse_off(triangle("OFF", {" 255 0 0 255"}), "a.off");
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(1, 0, 0));
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(mesh.warnings[0], "a.off:3: vertices of 7 numbers; those that the keyword does not announce are ignored");
}

// A cube on one line: behind each face stands the next one, which is no colour.
TEST(Off, FacesMayShareALine) {
  const std::string corners = " 0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1",
                    faces = " 4 0 3 2 1 4 4 5 6 7 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 7";
  const Ids expected{0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  for (const std::string& text : {"OFF 8 6 12" + corners + faces, "OFF\n8 6 12\n" + corners + "\n" + faces + "\n",
                                  "OFF 8 6 12" + corners + " 4 0 3 2 1 4 4 5\n6 7" + faces.substr(20)}) {
    SCOPED_TRACE(text);
    const Mesh mesh = parse_off(text, "a.off");
    EXPECT_EQ(mesh.face_vertices, expected);
    EXPECT_EQ(mesh.num_faces(), 6);
    EXPECT_TRUE(mesh.face_values.empty());
    EXPECT_TRUE(mesh.warnings.empty());
  }
  // Neither way: the message is about lines.
  expect_error<FormatError>([&] { (void)parse_off("OFF 8 7 12" + corners + faces, "a.off"); },
                            {"a.off:1: the file ends at face 1 of 7"});
  expect_error<FormatError>([&] { (void)parse_off("OFF 8 5 12" + corners + faces, "a.off"); },
                            {"a.off:1: the file ends at face 1 of 5"});
}

// Digits that floats do not hold are kept, and the type says so.
TEST(Off, ColoursHaveTheTypeOfTheirDigits) {
  EXPECT_EQ(parse_off(triangle("COFF", {" 0.1 0 1"}), "a.off").vertex_values[0].type, ValueType::float32);
  const Mesh fine = parse_off(triangle("COFF", {" 0.1234567890123 0 1"}), "a.off");
  expect_channel(fine.vertex_values[0], "red", std::vector<double>(3, 0.1234567890123), ValueType::float64);
  EXPECT_EQ(parse_off(format_off(fine), "b.off").vertex_values[0].values, fine.vertex_values[0].values);
}

TEST(Off, WhatIsCutOffIsTold) {
  Mesh mesh = parse_off(triangle("COFF", {" 0.5 0 1"}), "a.off");
  EXPECT_TRUE(changes_in_off(mesh).empty());
  mesh.vertex_values[0].values = {-0.25, 1, 1.5};
  EXPECT_EQ(changes_in_off(mesh),
            std::vector<std::string>{"numbers of colours of vertices beyond 0 to 1, 2 of them, are cut off; a .ply of "
                                     "type float or double keeps them"});
  for (Mesh::Values& one : mesh.vertex_values) one = {one.name, {-0.4, 255.4, 255.6}, ValueType::uint8};
  ASSERT_EQ(changes_in_off(mesh).size(), 1u);
  EXPECT_NE(changes_in_off(mesh)[0].find("3 of them"), std::string::npos);
}

TEST(Off, ColoursOfFacesAreKeptIfAllFacesHaveOne) {
  const std::string start = "OFF\n4 2 0\n" + points;
  const Mesh all = parse_off(start + "3 0 1\n2 255 0 9\n3 0 2 3 1 2 3 # red\n", "a.off");
  EXPECT_EQ(all.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
  ASSERT_EQ(all.face_values.size(), 3u);
  expect_channel(all.face_values[0], "red", {255, 1}, ValueType::uint8);
  expect_channel(all.face_values[2], "blue", {9, 3}, ValueType::uint8);
  EXPECT_TRUE(all.warnings.empty());

  // As Geomview has them: with a decimal point 0 to 1, without one 0 to 255.
  const Mesh mixed = parse_off(start + "3 0 1 2 0.5 0.0 1.0 1.0\n3 0 2 3 64 0 255 51\n", "a.off");
  ASSERT_EQ(mixed.face_values.size(), 4u);
  expect_channel(mixed.face_values[0], "red", {127.5, 64}, ValueType::uint8);
  expect_channel(mixed.face_values[3], "alpha", {255, 51}, ValueType::uint8);

  const auto expect_warning = [&](const std::string& faces, std::size_t kept, const std::string& warning) {
    SCOPED_TRACE(faces);
    const Mesh mesh = parse_off(start + faces, "a.off");
    EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(mesh.face_values.size(), kept);
    ASSERT_EQ(mesh.warnings.size(), 1u);
    EXPECT_EQ(mesh.warnings[0], warning);
  };
  expect_warning("3 0 1 2 9 9 9\n3 0 2 3\n", 0,
                 "a.off:8: no colour here, which other faces have; the colours of faces are left out, all should have "
                 "one");
  expect_warning("3 0 1 2 9 9 9\n3 0 2 3 9 9 9 9\n", 3,
                 "a.off:7: a colour of 3 numbers where other faces have 4; alpha is left out, all should have it");
  expect_warning("3 0 1 2 9 9 9\n3 0 2 3 9 9 256\n", 0,
                 "a.off:8: a colour is not within 0 to 1 or 0 to 255; the colours of faces are left out");
  expect_warning("3 0 1 2 7\n3 0 2 3 8\n", 0,
                 "a.off:7: the numbers at the end are no colour of 3 or 4 numbers and are left out");
}

TEST(Off, WritesWhatItReads) {
  Mesh mesh = parse_off("OFF\n4 2 5\n0.1 0 0\n1 0 0\n1 1 -2e-300\n0 1 0\n3 0 1 2\n4 0 1 2 3\n", "a.off");
  EXPECT_EQ(format_off(mesh), "OFF\n4 2 0\n0.1 0 0\n1 0 0\n1 1 -2e-300\n0 1 0\n3 0 1 2\n4 0 1 2 3\n");
  // Refined colours may go beyond their range.
  mesh.vertex_values = {{"red", {-3, 0.4, 254.6, 300}, ValueType::uint8},
                        {"heat", {1, 2, 3, 4}},
                        {"blue", {1, 2, 3, 4}, ValueType::uint8},
                        {"green", {0, 0, 0, 0}, ValueType::uint8}};
  mesh.face_values = {{"red", {0.1, 1.5}, ValueType::float32},
                      {"green", {0, 0.25}, ValueType::float32},
                      {"blue", {1, 1}, ValueType::float32},
                      {"alpha", {1, -0.5}, ValueType::float32}};
  const std::string text = format_off(mesh);
  EXPECT_EQ(text,
            "COFF\n4 2 0\n0.1 0 0 0 0 1\n1 0 0 0 0 2\n1 1 -2e-300 255 0 3\n0 1 0 255 0 4\n"
            "3 0 1 2 0.1 0 1 1\n4 0 1 2 3 1 0.25 1 0\n");
  const Mesh read = parse_off(text, "b.off");
  EXPECT_EQ(format_off(read), text);
  EXPECT_EQ(read.positions, mesh.positions);
  EXPECT_TRUE(read.warnings.empty());
  // Colours of bytes that are all 0 or 1 stay nearly black.
  mesh.face_values.clear();
  for (Mesh::Values& one : mesh.vertex_values) one.values = {0, 1, 0, 1};
  const Mesh dark = parse_off(format_off(mesh), "c.off");
  ASSERT_EQ(dark.vertex_values.size(), 3u);
  EXPECT_EQ(dark.vertex_values[0].type, ValueType::float32);
  EXPECT_EQ(float(dark.vertex_values[0].values[1]), float(1 / 255.0));
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
  expect("OFFSET\n", {"a.off:1: the file starts with 'OFFSET'"});
  expect("OFF4x\n", {"a.off:1: the file starts with 'OFF4x'"});
  expect("OFF4000000000 1 4\n" + points, {"a.off:1: 4000000000 vertices cannot be in the"});
  expect("COFF\n3 1 0\n0 0 0 9 9 red\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n", {"a.off:3: number at the end 'red'"});
  expect("NOFF\n3 1 0\n0 0 0 0 0 up\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n", {"a.off:3: number of a normal 'up'"});
  expect("4OFF\n4 1 4\n", {"a.off:1: '4OFF' has points of other than 3 dimensions"});
  expect(std::string("OFF\n\0", 5), {"a.off:2: byte 4 is zero", "not a text OFF file"});
  expect(std::string("OFF BINARY\n\0\0\0\1", 15), {"a.off:1: binary OFF; only text can be read"});
  expect("OFF\n", {"number of vertices"});
  expect("OFF\n4 x 4\n" + points, {"a.off:2: number of faces 'x' is not a number"});
  expect("OFF\n4 1 x\n" + points, {"a.off:2: number of edges 'x'"});
  expect("OFF\n-4 1 4\n" + points, {"a.off:2: -4 vertices cannot be in the"});
  expect("OFF\n4000000000 1 4\n" + points, {"a.off:2: 4000000000 vertices cannot be in the 29 bytes that follow"});
  expect("OFF\n4 2000000000 4\n" + points, {"a.off:2: 2000000000 faces cannot be in"});
  expect("OFF\n4 1 4\n0 0 0\n1 0\n\n\n\n\n\n\n\n\n\n\n\n\n\n", {"the file ends at vertex 1 of 4"});
  expect("OFF\n4 1 4\n0 0 0\n1 y 0\n0 1 0\n0 0 1\n", {"a.off:4: coordinate y 'y' is not a number"});
  expect("OFF\n3 1 4\n0 0 0\n1 0 0\n      \n", {"a.off:", "the file ends at vertex 2 of 3"});
  expect("OFF\n4 1 4\n" + points + "       \n", {"the file ends at face 0 of 1"});
  expect("OFF\n4 1 4\n" + points + "4 0 1 2\n", {"a.off:8: the file ends at face 0 of 1"});
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
  write_off(directory / "b.off", parse_off(square, "a.off"));
  EXPECT_EQ(read_off(directory / "b.off").positions, parse_off(square, "a.off").positions);
}

}  // namespace
}  // namespace sublimit::testing
