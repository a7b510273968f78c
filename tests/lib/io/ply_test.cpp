// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/ply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "sublimit/io/detail/ply_rows.h"
#include "sublimit/io/detail/ply_values.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Ids = std::vector<Index>;

std::string header(const std::string& format, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand \\\n" + rest + "end_header\n";
}

const std::string square_header =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\n";
const std::string square_data = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
const std::string square = header("ascii", square_header) + square_data;

/// Bytes of numbers in either order.
class Bytes {
 public:
  explicit Bytes(bool big) : reversed_(big == (std::endian::native == std::endian::little)) {}
  template <class T>
  Bytes& operator<<(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (reversed_) std::reverse(bytes, bytes + sizeof(T));
    text.append(bytes, sizeof(T));
    return *this;
  }
  std::string text;

 private:
  bool reversed_;
};

// Further numbers of vertices, which other readers skip.
TEST(Ply, KeepsFurtherValuesOfVertices) {
  Mesh mesh = parse_ply(square, "square.ply");
  mesh.vertex_values = {{"tag", {3, -1, 0, 2147483647}, ValueType::int32}, {"heat", {0.1, -0.0, 1e300, 0.5}}};
  const std::string bytes = format_ply(mesh);
  EXPECT_NE(bytes.find("property int tag\nproperty double heat\n"), std::string::npos);
  const std::vector<std::string> names{"heat", "none", "tag", "vertex_indices"};
  const Mesh read = parse_ply(bytes, "values.ply", names);
  EXPECT_EQ(read.positions, mesh.positions);
  EXPECT_EQ(read.face_vertices, mesh.face_vertices);
  ASSERT_EQ(read.vertex_values.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.vertex_values[i].name, mesh.vertex_values[1 - i].name);
    EXPECT_EQ(read.vertex_values[i].values, mesh.vertex_values[1 - i].values);
    EXPECT_EQ(read.vertex_values[i].type, mesh.vertex_values[1 - i].type);
  }
  EXPECT_EQ(parse_ply(bytes, "values.ply").positions, mesh.positions);
  mesh.vertex_values[0].values = {2.5, 3.5, -1e300, 1e300};
  EXPECT_EQ(parse_ply(format_ply(mesh), "values.ply", std::vector<std::string>{"tag"}).vertex_values[0].values,
            (std::vector<double>{2, 4, -2147483648.0, 2147483647.0}));
  mesh.vertex_values[0].values[1] = std::numeric_limits<double>::quiet_NaN();
  expect_error<InvalidMesh>([&] { format_ply(mesh); }, {"value 'tag' number 1 is not a number"});
  mesh.vertex_values[0].values.pop_back();
  expect_error<InvalidMesh>([&] { format_ply(mesh); }, {"value 'tag' has 3 numbers for 4 vertices"});
}

TEST(Ply, ReadsText) {
  const Mesh mesh = parse_ply(header("ascii",
                                     "obj_info any\nelement camera 1\nproperty list uchar float view\n"
                                     "element vertex 4\nproperty uchar red\nproperty double z\n"
                                     "property double x\nproperty double y\nproperty list int int other\n"
                                     "element face 2\nproperty uchar flag\n"
                                     "property list uchar uint vertex_index\nproperty float last\n"
                                     "element empty 100000000000000\n") +
                                  "2 0.5 1e9\n"
                                  "255 3 0.1 -2e3 0\n\n255 3 1 0 2 7 8\n255 3 1 1 0\n255 3 0 1 0\n"
                                  "0 3 0 1 2 nan\n1 4 0 1 2 3 5\n",
                              "a.ply");
  EXPECT_EQ(mesh.positions.row(0), Eigen::RowVector3d(0.1, -2000, 3));
  EXPECT_EQ(mesh.face_sizes, (Ids{3, 4}));
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 1, 2, 3}));
  ASSERT_EQ(mesh.warnings.size(), 2u);
  EXPECT_TRUE(mesh.warnings[0].starts_with("a.ply:5: element 'camera' and list 'other' of vertices left out"));
  EXPECT_TRUE(mesh.warnings[1].starts_with("a.ply:16: number 'last' of faces is nan at 0 and is left out"));
}

TEST(Ply, ReadsBinaryOfEitherByteOrderAndAnyTypes) {
  for (const bool big : {false, true}) {
    Bytes data(big);
    const float tenth = 0.1f;
    data << std::uint16_t{2} << std::int16_t{-1} << std::int16_t{-2};          // skipped element
    data << std::int8_t{-5} << tenth << 0.1 << std::uint8_t{2} << 1.0 << 2.0;  // vertex 0
    data << std::int8_t{127} << 1.0f << std::numeric_limits<double>::denorm_min() << std::uint8_t{0};  // vertex 1
    data << std::int8_t{0} << 0.0f << -0.0 << std::uint8_t{1} << 3.0;                                  // vertex 2
    data << std::uint32_t{7} << std::uint32_t{3} << std::uint16_t{2} << std::uint16_t{1} << std::uint16_t{0};
    const Mesh mesh = parse_ply(header(big ? "binary_big_endian" : "binary_little_endian",
                                       "element strip 1\nproperty list ushort short data\n"
                                       "element vertex 3\nproperty char x\nproperty float y\nproperty double z\n"
                                       "property list uchar double skipped\n"
                                       "element face 1\nproperty uint32 id\n"
                                       "property list uint ushort vertex_indices\n") +
                                    data.text,
                                "a.ply");
    EXPECT_EQ(mesh.positions.row(0), Eigen::RowVector3d(-5, tenth, 0.1));
    EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(127, 1, std::numeric_limits<double>::denorm_min()));
    EXPECT_TRUE(std::signbit(mesh.positions(2, 2)));
    EXPECT_EQ(mesh.face_vertices, (Ids{2, 1, 0}));
    ASSERT_EQ(mesh.warnings.size(), 1u);
    EXPECT_TRUE(mesh.warnings[0].starts_with("a.ply:4: element 'strip' and list 'skipped' of vertices left out"));
  }
}

TEST(Ply, FacesMayComeBeforeVertices) {
  const Mesh mesh = parse_ply(header("ascii",
                                     "element face 1\nproperty list uchar int vertex_indices\n"
                                     "element vertex 3\nproperty int x\nproperty int y\nproperty int z\n") +
                                  "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
                              "a.ply");
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
}

TEST(Ply, BinaryMayStartWithALineFeed) {
  Bytes data(false);
  data << std::uint8_t{10} << std::uint8_t{13} << std::uint8_t{10};
  for (int i = 0; i < 6; ++i) data << std::uint8_t{0};
  data << std::uint8_t{3} << 0 << 1 << 2;
  std::string text = header("binary_little_endian",
                            "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
                            "element face 1\nproperty list uchar int vertex_indices\n");
  EXPECT_EQ(parse_ply(text + data.text, "a.ply").positions.row(0), Eigen::RowVector3d(10, 13, 10));
  std::string cr = text;
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  EXPECT_EQ(parse_ply(cr + data.text, "a.ply").positions.row(0), Eigen::RowVector3d(10, 13, 10));
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2) text.insert(i, 1, '\r');
  EXPECT_EQ(parse_ply(text + data.text, "a.ply").positions.row(0), Eigen::RowVector3d(10, 13, 10));
}

TEST(Ply, DataBehindTheLastElementIsWarnedAbout) {
  const Mesh mesh = parse_ply(square + "0 0 0\n", "a.ply");
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(mesh.warnings[0], "a.ply:16: data behind the last element ignored");
}

TEST(Ply, SaysWhatHeadersCannotBeUnderstood) {
  const auto expect = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text);
    expect_error<FormatError>([&] { parse_ply(text, "a.ply"); }, parts);
  };
  const std::string start = "ply\nformat ascii 1.0\n";
  expect("", {"a.ply: the file is empty"});
  expect("OFF\n", {"a.ply:1: the file starts with 'OFF'", "'ply'"});
  expect("ply\nformat ascii 2.0\n", {"a.ply:2: unknown version '2.0'"});
  expect("ply\nformat text 1.0\n", {"a.ply:2: unknown format 'text'", "binary_little_endian"});
  expect("ply\nend_header\n", {"a.ply:2: the header has no 'format' line"});
  expect(start, {"the header has no 'end_header'"});
  expect(start + "elements vertex 3\n", {"a.ply:3: unknown keyword 'elements'"});
  expect(start + "element vertex\n", {"a.ply:3: the line ends where number of elements should be"});
  expect(start + "element\n", {"a.ply:3: an element without a name"});
  expect(start + "element vertex -1\n", {"a.ply:3: number of elements is negative"});
  expect(start + "element vertex 1e3\n", {"a.ply:3: number of elements '1e3'"});
  expect(start + "element a 1\nelement a 1\n", {"a.ply:4: a second element 'a'"});
  expect(start + "element a 1 2\n", {"a.ply:3: unexpected '2'"});
  expect(start + "property int x\n", {"a.ply:3: a property before the first element"});
  expect(start + "element a 1\nproperty half x\n", {"a.ply:4: unknown type 'half'"});
  expect(start + "element a 1\nproperty int\n", {"a.ply:4: a property without a name"});
  expect(start + "element a 1\nproperty list float int x\n", {"a.ply:4: the length of a list"});
  expect(start + "element vertex 4000000000\nproperty int x\nend_header\n0\n",
         {"a.ply:3: 4000000000 elements 'vertex' cannot be in the 2 bytes"});
  expect(start + "element vertex 1\nproperty int x\nproperty int y\nelement face 1\nend_header\n0 0\n",
         {"a.ply:3: element 'vertex' has no number 'z'", "x, y and z"});
  expect(header("ascii",
                "element vertex 3\nproperty int x\nproperty int y\nproperty int z\nproperty int x\n"
                "element face 1\nproperty list int int vertex_indices\n") +
             "0 0 0 0\n0 0 0 0\n0 0 0 0\n3 0 1 2\n",
         {"a.ply:4: element 'vertex' has two properties 'x'"});
  expect(header("ascii",
                "element vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
                "element face 1\nproperty int vertex_indices\n") +
             "0 0 0\n0\n",
         {"a.ply:8: element 'face' has no list 'vertex_indices' or 'vertex_index'"});
  expect(header("ascii",
                "element vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
                "element face 1\nproperty list int float vertex_indices\n") +
             "0 0 0\n3 0 0 0\n",
         {"a.ply:8: indices of vertices should have an integer type"});
}

TEST(Ply, SaysWhatDataCannotBeUnderstood) {
  const auto expect = [](const std::string& data, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(data);
    expect_error<FormatError>([&] { parse_ply(header("ascii", square_header) + data, "a.ply"); }, parts);
  };
  expect("0 0 0\n1 0 0\n1 x 0\n0 1 0\n4 0 1 2 3\n", {"a.ply:13: 'x' is not a number"});
  expect("0 0 0\n1 0 0\n1 0\n0 1 0\n4 0 1 2 3\n", {"a.ply:13: the line ends before the header's properties"});
  expect("0 0 0\n1 0 0\n1 0 0 0\n0 1 0\n4 0 1 2 3\n", {"a.ply:13: unexpected '0'"});
  expect("0 0 0\n1 0 0\n1 0 0\n0 1 1e999\n4 0 1 2 3\n", {"a.ply:14: number '1e999' is too large"});
  expect("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2\n", {"a.ply:15: the line ends"});
  expect("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3.5\n", {"a.ply:15: '3.5' is not a number of the type"});
  expect("0 0 0\n1 0 0\n1 1 0\n0 1 0\n-4 0 1 2 3\n", {"a.ply:15: list of -4 values"});
  expect("0 0 0\n1 0 0\n1 1 0\n0 1 0\n        \n", {"the data ends before the header's counts are met"});

  const std::string binary = header("binary_little_endian", square_header);
  Bytes vertices(false);
  for (int i = 0; i < 12; ++i) vertices << 0.0f;
  const auto expect_byte = [&](Bytes data, std::size_t byte, std::string_view part) {
    expect_error<FormatError>([&] { parse_ply(binary + vertices.text + data.text, "a.ply"); },
                              {"a.ply: byte " + std::to_string(binary.size() + 48 + byte) + ": ", part});
  };
  expect_byte(Bytes(false) << std::uint8_t{4} << 0 << 1 << 2, 13, "the data ends");
  expect_byte(Bytes(false) << std::uint8_t{255} << 0, 5, "the data ends");
}

TEST(Ply, SaysWhatIsNoMesh) {
  const auto expect = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(text);
    expect_error<InvalidMesh>([&] { parse_ply(text, "a.ply"); }, parts);
  };
  const std::string start = header("ascii", square_header);
  expect(start + "0 0 0\n1 0 0\n1 1 nan\n0 1 0\n4 0 1 2 3\n", {"a.ply:13: coordinate z of vertex 2 is nan", "finite"});
  expect(start + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 4\n", {"a.ply:15: index 4 of face 0 is out of range", "0 to 3"});
  expect(start + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 -1\n", {"a.ply:15: index -1 of face 0"});
  expect(start + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n", {"a.ply:15: face 0 has 2 corners", "at least 3"});
  expect(header("ascii", ""), {"a.ply: no element 'vertex'"});
  expect(header("ascii", "element vertex 0\nproperty int x\n"), {"a.ply: no elements 'vertex'"});
  expect(header("ascii", "element vertex 1\nproperty int x\n") + "0\n", {"a.ply: no element 'face'"});
  expect(header("ascii", "element vertex 1\nproperty int x\nelement face 0\n") + "0\n", {"a.ply: no elements 'face'"});
}

TEST(Ply, CountsTakeNoMemoryThatTheFileCannotFill) {
  // No properties: any number of vertices fits the file; they have no coordinates all the same.
  expect_error<FormatError>(
      [] {
        parse_ply(
            header("ascii", "element vertex 2000000000\nelement face 1\nproperty list uchar int vertex_indices\n") +
                "3 0 1 2\n",
            "a.ply");
      },
      {"a.ply:4: element 'vertex' has no number 'x'"});
}

TEST(Ply, RowsAreReadFromAnyByteOn) {
  const Mesh mesh = parse_ply(square, "square.ply");
  const std::string bytes = format_ply(mesh);
  const PlyHeader read = parse_ply_header(bytes, "square.ply");
  EXPECT_EQ(format_ply_header(read), bytes.substr(0, size_t(read.size)));
  const PlyElement& vertex = require_element(read, "square.ply", "vertex", "x, y and z");
  const PlyElement& face = require_element(read, "square.ply", "face", "vertex_indices");
  EXPECT_EQ(row_size(vertex), 3 * 8);
  EXPECT_EQ(row_size(face), std::nullopt);
  PlyBinaryValues values(bytes, read, "square.ply");
  const PlyVertices vertices(vertex, "square.ply", {});
  double x[3];
  for (const Index v : {2, 0, 3}) {
    values.move_to(read.size + v * *row_size(vertex));
    vertices.read(values, v, x);
    for (Index k = 0; k < 3; ++k) EXPECT_EQ(x[k], mesh.positions(v, k));
  }
  std::vector<std::int64_t> corners;
  EXPECT_EQ(values.offset(), read.size + 4 * 3 * 8);
  EXPECT_EQ(PlyFaces(face, "square.ply", 4).read(values, 0, corners), 4);
  EXPECT_EQ(corners, (std::vector<std::int64_t>{0, 1, 2, 3}));
  EXPECT_EQ(values.offset(), std::ssize(bytes));
}

TEST(Ply, ReadsFiles) {
  const TemporaryDirectory directory;
  EXPECT_EQ(read_ply(directory.write("a.ply", square)).num_faces(), 1);
  expect_error<IoError>([&] { read_ply(directory / "no.ply"); }, {"no.ply: cannot read"});
}

}  // namespace
}  // namespace sublimit::testing
