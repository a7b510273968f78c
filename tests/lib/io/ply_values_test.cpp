// SPDX-License-Identifier: Apache-2.0
// What PLY files carry beside positions and corners, strips, and line ends of headers.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/io/detail/ply.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Ids = std::vector<Index>;
using Reals = std::vector<double>;

std::string text_header(const std::string& rest) { return "ply\nformat ascii 1.0\n" + rest + "end_header\n"; }

const std::string corners = "property float x\nproperty float y\nproperty float z\n";
const std::string square_points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string list = "property list uchar int vertex_indices\n";

Mesh two_triangles() {
  return parse_ply(
      text_header("element vertex 4\n" + corners + "element face 2\n" + list) + square_points + "3 0 1 2\n3 0 2 3\n",
      "two.ply");
}

void expect_values(const Mesh::Values& one, const std::string& name, const Reals& values, ValueType type) {
  EXPECT_EQ(one.name, name);
  EXPECT_EQ(one.values, values);
  EXPECT_EQ(one.type, type);
}

TEST(PlyValues, NumbersOfVerticesAndFacesAreKept) {
  const Mesh mesh = parse_ply(
      text_header("element vertex 3\nproperty uchar red\n" + corners +
                  "property float nx\nproperty float ny\nproperty float nz\nproperty double u\nproperty short q\n" +
                  "element face 2\nproperty ushort texnumber\n" + list + "property float quality\n") +
          "255 0 0 0 0 0 1 0.25 -7\n0 1 0 0 0 0 1 1e9 8\n9 0 1 0 0 0 1 0 0\n65535 3 0 1 2 0.5\n0 3 0 2 1 -1\n",
      "a.ply");
  EXPECT_TRUE(mesh.warnings.empty());
  ASSERT_EQ(mesh.vertex_values.size(), 3u);
  expect_values(mesh.vertex_values[0], "red", {255, 0, 9}, ValueType::uint8);
  expect_values(mesh.vertex_values[1], "u", {0.25, 1e9, 0}, ValueType::float64);
  expect_values(mesh.vertex_values[2], "q", {-7, 8, 0}, ValueType::int16);
  ASSERT_EQ(mesh.face_values.size(), 2u);
  expect_values(mesh.face_values[0], "texnumber", {65535, 0}, ValueType::uint16);
  expect_values(mesh.face_values[1], "quality", {0.5, -1}, ValueType::float32);
  EXPECT_EQ(mesh.normals.rows(), 0);
  EXPECT_TRUE(mesh.face_varying.empty());
}

TEST(PlyValues, ValuesOfAllTypesComeBackFromAFile) {
  Mesh mesh = two_triangles();
  mesh.comments = {"by hand"};
  const std::pair<ValueType, std::pair<double, double>> ranges[] = {
      {ValueType::int8, {-128, 127}},
      {ValueType::uint8, {0, 255}},
      {ValueType::int16, {-32768, 32767}},
      {ValueType::uint16, {0, 65535}},
      {ValueType::int32, {-2147483648.0, 2147483647.0}},
      {ValueType::uint32, {0, 4294967295.0}},
      {ValueType::float32, {-double(std::numeric_limits<float>::max()), std::numeric_limits<float>::max()}},
      {ValueType::float64, {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()}}};
  for (const auto& [type, range] : ranges) {
    const std::string name = "value" + std::to_string(int(type));
    mesh.vertex_values.push_back({name, {range.first, range.second, 1, 2}, type});
    mesh.face_values.push_back({name, {range.first, range.second}, type});
  }
  const Mesh read = parse_ply(format_ply(mesh), "all.ply");
  EXPECT_EQ(read.positions, mesh.positions);
  EXPECT_EQ(read.face_vertices, mesh.face_vertices);
  ASSERT_EQ(read.vertex_values.size(), std::size(ranges));
  ASSERT_EQ(read.face_values.size(), std::size(ranges));
  for (std::size_t i = 0; i < std::size(ranges); ++i) {
    expect_values(read.vertex_values[i], mesh.vertex_values[i].name, mesh.vertex_values[i].values, ranges[i].first);
    expect_values(read.face_values[i], mesh.face_values[i].name, mesh.face_values[i].values, ranges[i].first);
  }
  // Refined values go beyond their range, and between whole numbers.
  for (Mesh::Values& one : mesh.face_values) one.values = {-1e300, 1e300};
  mesh.vertex_values[1].values = {-0.6, 255.4, 2.6, 300};
  const Mesh clamped = parse_ply(format_ply(mesh), "clamped.ply");
  EXPECT_EQ(clamped.vertex_values[1].values, (Reals{0, 255, 3, 255}));
  for (std::size_t i = 0; i + 1 < std::size(ranges); ++i)
    EXPECT_EQ(clamped.face_values[i].values, (Reals{ranges[i].second.first, ranges[i].second.second})) << i;
  EXPECT_EQ(clamped.face_values.back().values, (Reals{-1e300, 1e300}));
}

TEST(PlyValues, FacesOfAnySizeHaveValuesAndTextureCoordinates) {
  for (const Index size : {3, 127, 128, 255, 256}) {
    Mesh mesh;
    mesh.positions = Points::Random(size, 3);
    mesh.face_sizes = {3, size};
    mesh.face_vertices = {2, 1, 0};
    for (Index i = 0; i < size; ++i) mesh.face_vertices.push_back(i);
    mesh.face_ids = {7, 9};
    mesh.face_values = {{"part", {1, 2}, ValueType::int16}};
    mesh.face_varying = {{.name = "uv", .values = Points::Zero(size + 3, 2), .indices = {}}};
    for (Index c = 0; c < size + 3; ++c) {
      mesh.face_varying[0].values.row(c) << c / 4.0, -c;
      mesh.face_varying[0].indices.push_back(c);
    }
    const Mesh read = parse_ply(format_ply(mesh), "sizes.ply");
    EXPECT_EQ(read.face_vertices, mesh.face_vertices);
    ASSERT_EQ(read.face_varying.size(), 1u) << size;
    for (std::size_t c = 0; c < read.face_vertices.size(); ++c)
      EXPECT_EQ(read.face_varying[0].values.row(read.face_varying[0].indices[c]),
                mesh.face_varying[0].values.row(mesh.face_varying[0].indices[c]));
    ASSERT_EQ(read.face_values.size(), 2u);
    expect_values(read.face_values[0], "face_id", {7, 9}, ValueType::int32);
    expect_values(read.face_values[1], "part", {1, 2}, ValueType::int16);
  }
}

TEST(PlyValues, TextureCoordinatesOfCornersAreOneValueWhereTheyAreEqual) {
  const std::string head = text_header("element vertex 4\n" + corners + "element face 2\n" +
                                       "property list uchar float texcoord\n" + list + "property int texnumber\n") +
                           square_points;
  const Mesh mesh = parse_ply(head + "6 0 0 1 0 1 1 3 0 1 2 0\n6 0 0 1 0.5 0 1 3 0 2 3 0\n", "a.ply");
  EXPECT_TRUE(mesh.warnings.empty());
  ASSERT_EQ(mesh.face_varying.size(), 1u);
  const Mesh::FaceVarying& uv = mesh.face_varying[0];
  EXPECT_EQ(uv.name, "uv");
  EXPECT_EQ(uv.indices, (Ids{0, 1, 2, 0, 3, 4}));  // vertex 0 has one value, vertex 2 a seam
  Points expected(5, 2);
  expected << 0, 0, 1, 0, 1, 1, 1, 0.5, 0, 1;
  EXPECT_EQ(uv.values, expected);
  ASSERT_EQ(mesh.face_values.size(), 1u);
  EXPECT_EQ(mesh.face_values[0].name, "texnumber");

  const auto expect_warning = [&](const std::string& faces, const std::string& warning) {
    const Mesh without = parse_ply(head + faces, "a.ply");
    EXPECT_TRUE(without.face_varying.empty());
    EXPECT_EQ(without.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(without.warnings, std::vector<std::string>{warning});
  };
  expect_warning("6 0 0 1 0 1 1 3 0 1 2 0\n0 3 0 2 3 0\n",
                 "a.ply:8: list 'texcoord' of face 1 has not two numbers for each corner; texture coordinates are left "
                 "out");
  expect_warning("6 0 0 1 0 1 nan 3 0 1 2 0\n6 0 0 1 0.5 0 1 3 0 2 3 0\n",
                 "a.ply:8: list 'texcoord' has numbers that are not finite; texture coordinates are left out");
}

TEST(PlyValues, OtherListsAndElementsAreNamedInOneWarning) {
  const Mesh mesh = parse_ply(text_header("element camera 1\nproperty float view\nelement vertex 3\n" + corners +
                                          "property list uchar int near\nelement face 1\n" + list +
                                          "property list uchar float flags\nelement edge 0\nproperty int v\n") +
                                  "7\n0 0 0 1 5\n1 0 0 0\n0 1 0 0\n3 0 1 2 1 0.5\n",
                              "a.ply");
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
  EXPECT_EQ(mesh.warnings, std::vector<std::string>{
                               "a.ply:3: element 'camera', list 'near' of vertices and list 'flags' of faces left out; "
                               "numbers of vertices and faces and the list 'texcoord' of faces are kept"});
  EXPECT_TRUE(mesh.vertex_values.empty());
  EXPECT_TRUE(mesh.face_values.empty());
}

TEST(PlyValues, NumbersThatAreNotFiniteAreLeftOut) {
  const Mesh mesh =
      parse_ply(text_header("element vertex 3\n" + corners + "property float q\nproperty int k\nelement face 1\n" +
                            list + "property float area\n") +
                    "0 0 0 1 1\n1 0 0 nan 2\n0 1 0 inf 3\n3 0 1 2 -inf\n",
                "a.ply");
  ASSERT_EQ(mesh.vertex_values.size(), 1u);
  expect_values(mesh.vertex_values[0], "k", {1, 2, 3}, ValueType::int32);
  EXPECT_TRUE(mesh.face_values.empty());
  EXPECT_EQ(mesh.warnings,
            (std::vector<std::string>{
                "a.ply:7: number 'q' of vertices is nan at 1 and is left out; it should be finite everywhere",
                "a.ply:11: number 'area' of faces is -inf at 0 and is left out; it should be finite everywhere"}));
}

// Numbers of a text that other programs would read as other ones.
TEST(PlyValues, NumbersOfTextsAreWithinTheirTypes) {
  const auto file = [](const std::string& type, const std::string& number) {
    return text_header("element vertex 3\n" + corners + "property " + type + " q\nelement face 1\n" + list) + "0 0 0 " +
           number + "\n1 0 0 0\n0 1 0 0\n3 0 1 2\n";
  };
  const auto reads = [&](const std::string& type, const std::string& number) {
    return parse_ply(file(type, number), "a.ply").vertex_values.at(0).values.at(0);
  };
  const auto refuses = [&](const std::string& type, const std::string& number, const std::string& range) {
    expect_error<FormatError>(
        [&] { (void)parse_ply(file(type, number), "a.ply"); },
        {"a.ply:11: number " + number + " is beyond the type " + type + " of the header; " + range});
  };
  EXPECT_EQ(reads("uchar", "255"), 255);
  EXPECT_EQ(reads("float", "3.4e38"), 3.4e38);
  refuses("uchar", "300", "0 to 255 are in it");
  refuses("uchar", "-1", "0 to 255");
  refuses("char", "128", "-128 to 127");
  refuses("short", "-32769", "-32768 to 32767");
  refuses("ushort", "65536", "0 to 65535");
  refuses("int", "2147483648", "-2147483648 to 2147483647");
  refuses("uint", "4294967296", "0 to 4294967295");
  refuses("uint", "nan", "0 to 4294967295");
  refuses("float", "1e+39", "-3.4028234663852886e+38 to 3.4028234663852886e+38");
  expect_error<FormatError>([&] { (void)reads("double", "1e400"); }, {"a.ply:11: number '1e400' is too large"});
}

TEST(PlyValues, WhatAWriterChangesIsTold) {
  Mesh mesh = two_triangles();
  mesh.face_values = {{"face_id", {0.5, 0.5}}, {"heat", {1, 1e39}, ValueType::float32}};
  mesh.vertex_values = {{"red", {-0.4, 255.4, 255.6, -1}, ValueType::uint8}};
  EXPECT_EQ(changes_in_ply(mesh),
            (std::vector<std::string>{"values 'red' beyond the type uchar, 2 of them, are cut off",
                                      "values 'heat' beyond the type float, 1 of them, are cut off"}));
  mesh.face_ids = {3, 4};
  EXPECT_EQ(changes_in_ply(mesh)[0], "values 'face_id' are left out: the file has other numbers of that name");
  EXPECT_TRUE(changes_in_ply(two_triangles()).empty());
}

TEST(PlyValues, NamesAreOnceInAFileAndAreWords) {
  Mesh mesh = two_triangles();
  mesh.vertex_values = {{"s", {1, 1, 1, 1}}, {"heat", {1, 2, 3, 4}}, {"heat", {5, 6, 7, 8}}};
  mesh.face_values = {{"face_id", {0.5, 0.5}}};
  mesh.face_ids = {3, 4};
  mesh.texture = Points::Constant(4, 2, 9);
  const Mesh read = parse_ply(format_ply(mesh), "a.ply");
  ASSERT_EQ(read.vertex_values.size(), 3u);
  expect_values(read.vertex_values[0], "s", {9, 9, 9, 9}, ValueType::float64);
  expect_values(read.vertex_values[2], "heat", {5, 6, 7, 8}, ValueType::float64);
  ASSERT_EQ(read.face_values.size(), 1u);
  expect_values(read.face_values[0], "face_id", {3, 4}, ValueType::int32);

  for (const char* const name : {"", "two words", "a\nb", "a#b", "x"}) {
    mesh.vertex_values = {{name, {1, 2, 3, 4}}};
    expect_error<InvalidParameter>([&] { format_ply(mesh); }, {"PLY: values cannot have the name '"});
  }
  mesh.vertex_values = {};
  mesh.face_values = {{"texcoord", {1, 2}}};
  expect_error<InvalidParameter>([&] { format_ply(mesh); }, {"values cannot have the name 'texcoord'"});
  mesh.face_values = {{"x", {1, 2}}, {"h\xc3\xb6he", {1, 2}}};
  EXPECT_EQ(parse_ply(format_ply(mesh), "a.ply").face_values.size(), 3u);

  mesh.face_varying = {{.name = "uv", .values = Points::Constant(1, 2, 1e39), .indices = Ids(6, 0)}};
  expect_error<InvalidMesh>([&] { format_ply(mesh); }, {"PLY: a texture coordinate is beyond the numbers of 32 bits"});
}

TEST(PlyValues, FilesAreTheSameForAnyNumberOfThreads) {
  constexpr Index faces = 10000;  // some blocks of rows
  Mesh mesh;
  mesh.positions = Points::Random(faces + 4, 3);
  mesh.face_varying = {{.name = "uv", .values = Points::Random(faces, 2), .indices = {}}};
  mesh.face_values = {{"part", {}, ValueType::uint16}};
  mesh.vertex_values = {{"red", {}, ValueType::uint8}, {"heat", {}, ValueType::float32}};
  for (Index f = 0; f < faces; ++f) {
    mesh.face_sizes.push_back(3 + f % 2);
    mesh.face_values[0].values.push_back(f);
    for (Index i = 0; i < mesh.face_sizes.back(); ++i) {
      mesh.face_vertices.push_back(f + i);
      mesh.face_varying[0].indices.push_back((f + 7 * i) % faces);
    }
  }
  for (Index v = 0; v < faces + 4; ++v) {
    mesh.vertex_values[0].values.push_back(v % 300);
    mesh.vertex_values[1].values.push_back(v / 3.0);
  }
  const TemporaryDirectory directory;
  const std::string bytes = format_ply(mesh);
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    write_ply(directory / "a.ply", mesh);
    EXPECT_EQ(read_file(directory / "a.ply"), bytes) << threads;
  }
  EXPECT_EQ(parse_ply(bytes, "a.ply").face_values[0].values, mesh.face_values[0].values);
}

// Two strips: 0 1 2, 2 1 3, then with two vertices that are repeated to turn a corner, and 4 5 6.
TEST(PlyStrips, EveryOtherTriangleIsTurned) {
  const std::string points = square_points + "0 0 1\n1 0 1\n1 1 1\n";
  const auto read = [&](const std::string& strips, const std::string& type = "int") {
    return parse_ply(text_header("element vertex 7\n" + corners + "element tristrips 1\nproperty list int " + type +
                                 " vertex_indices\n") +
                         points + strips,
                     "a.ply");
  };
  const Mesh mesh = read("8 0 1 2 3 -1 4 5 6\n");
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 2, 1, 3, 4, 5, 6}));
  EXPECT_EQ(mesh.face_sizes, (Ids{3, 3, 3}));
  EXPECT_TRUE(mesh.warnings.empty());
  // 1 2 2, 2 2 3 are no triangles, but they turn: 2 3 4 is the fifth.
  EXPECT_EQ(read("6 0 1 2 2 3 4\n").face_vertices, (Ids{0, 1, 2, 3, 2, 4}));
  EXPECT_EQ(read("11 -1 0 1 -1 4 5 6 -1 -1 2 3\n").face_vertices, (Ids{4, 5, 6}));
  EXPECT_EQ(read("5 0 1 2 4294967295 3\n", "uint").face_vertices, (Ids{0, 1, 2}));
  expect_error<InvalidMesh>([&] { read("4 0 1 2 7\n"); }, {"a.ply:17: index 7 of strip 0 is out of range", "0 to 6"});
  expect_error<InvalidMesh>([&] { read("4 0 1 2 -2\n"); }, {"a.ply:17: index -2 of strip 0"});
  expect_error<InvalidMesh>([&] { read("4 0 0 1 1\n"); }, {"a.ply:7: no triangles in the strips"});
  expect_error<FormatError>([&] { read("4 0 1 2\n"); }, {"a.ply:17: the line ends"});
}

TEST(PlyStrips, AreReadIfThereAreNoFaces) {
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\nproperty int part\n";
  const Mesh without = parse_ply(text_header("element vertex 4\n" + corners + "element face 0\n" + list + strips) +
                                     square_points + "4 0 1 2 3 5\n",
                                 "a.ply");
  EXPECT_EQ(without.face_sizes, (Ids{3, 3}));
  EXPECT_TRUE(without.face_values.empty());
  ASSERT_EQ(without.warnings.size(), 1u);
  EXPECT_TRUE(without.warnings[0].starts_with("a.ply:11: number 'part' of strips left out"));
  const Mesh with = parse_ply(text_header("element vertex 4\n" + corners + strips + "element face 1\n" + list) +
                                  square_points + "4 0 1 2 3 5\n4 0 1 2 3\n",
                              "a.ply");
  EXPECT_EQ(with.face_sizes, (Ids{4}));
  ASSERT_EQ(with.warnings.size(), 1u);
  EXPECT_TRUE(with.warnings[0].starts_with("a.ply:7: element 'tristrips' left out"));
}

/// Bytes of numbers, most significant first.
template <class T>
std::string big_endian(const std::vector<T>& numbers) {
  std::string bytes;
  for (const T number : numbers) {
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    if (std::endian::native == std::endian::little) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

TEST(PlyStrips, BinaryOfBigEndian) {
  const std::string head = "ply\nformat binary_big_endian 1.0\nelement vertex 4\n" + corners +
                           "property ushort q\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  std::string data;
  for (int v = 0; v < 4; ++v)
    data += big_endian<float>({float(v), 0.1f, -2}) + big_endian<std::uint16_t>({std::uint16_t(258 + v)});
  data += big_endian<std::int32_t>({4, 0, 1, 2, 3});
  const Mesh mesh = parse_ply(head + data, "a.ply");
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 2, 1, 3}));
  EXPECT_EQ(mesh.positions.row(3), Eigen::RowVector3d(3, 0.1f, -2));
  ASSERT_EQ(mesh.vertex_values.size(), 1u);
  expect_values(mesh.vertex_values[0], "q", {258, 259, 260, 261}, ValueType::uint16);
}

// The first coordinate is the byte of a line feed.
TEST(PlyHeader, DataBeginBehindTheLineEndOfItsLastLine) {
  const std::string lines =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "element face 1\nproperty list uchar uchar vertex_indices\n";
  const std::string data("\n\r\n\1\0\0\0\1\0\3\0\1\2", 13);
  const auto with = [&](const std::string& end) {
    std::string all;
    for (const char c : lines) all += c == '\n' ? end : std::string(1, c);
    return all;
  };
  for (const std::string end : {"\n", "\r\n", "\r"})
    for (const std::string last : {"\n", "\r\n", "\r"}) {
      if (end == "\r" && last == "\r\n") continue;  // a carriage return alone is the line end of such a file
      if (end != "\r" && last == "\r") continue;    // "\r", and the data's "\n" with it, are one elsewhere
      SCOPED_TRACE(::testing::PrintToString(end + " " + last));
      const Mesh mesh = parse_ply(with(end) + "end_header" + last + data, "a.ply");
      EXPECT_EQ(mesh.positions.row(0), Eigen::RowVector3d(10, 13, 10));
      EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
      EXPECT_TRUE(mesh.warnings.empty());
    }
}

}  // namespace
}  // namespace sublimit::testing
