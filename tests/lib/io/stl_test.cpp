// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/stl.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Ids = std::vector<Index>;
using Names = std::vector<std::string>;

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "  facet normal 0 0 1\n    outer loop\n      vertex " + a + "\n      vertex " + b + "\n      vertex " + c +
         "\n    endloop\n  endfacet\n";
}

std::string solid(const std::string& name, const std::string& facets) {
  return "solid " + name + "\n" + facets + "endsolid " + name + "\n";
}

const std::string lower = facet("0 0 0", "1 0 0", "1 1 0"), upper = facet("0 0 -0", "1.0 1e0 0", "0 1 0");

std::string little_endian(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

/// A binary file of triangles of nine numbers each; its normals are no numbers, and there is a colour.
std::string binary(std::string head, const std::vector<std::vector<float>>& triangles) {
  head.resize(80, ' ');
  head += little_endian(std::uint32_t(triangles.size()));
  for (const std::vector<float>& triangle : triangles) {
    for (int i = 0; i < 3; ++i) head += little_endian(0x7fc00000);
    for (const float x : triangle) head += little_endian(std::bit_cast<std::uint32_t>(x));
    head += "\x1f\xfc";
  }
  return head;
}

const std::vector<std::vector<float>> square{{0, 0, 0, 1, 0, 0, 1, 1, 0}, {-0.0f, 0, 0, 1, 1, 0, 0, 1, 0}};

Points corners_of_square() {
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  return points;
}

TEST(Stl, EqualCornersOfTextAreOneVertex) {
  const Mesh mesh = parse_stl(solid("", lower + upper), "a.stl");
  EXPECT_EQ(mesh.positions, corners_of_square());
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(mesh.face_sizes, (Ids{3, 3}));
  EXPECT_TRUE(mesh.objects.of_face.empty());
  EXPECT_EQ(mesh.notes, (Names{"a.stl: welded 6 corners to 4 vertices"}));
  EXPECT_TRUE(mesh.warnings.empty());
  // A number that differs in its last bit is another one.
  EXPECT_EQ(parse_stl(solid("", lower + facet("0 0 0", "1.0000000000000002 1 0", "0 1 0")), "a.stl").num_vertices(), 5);
}

TEST(Stl, EqualCornersOfBinaryAreOneVertex) {
  for (const std::string head : {"made by hand", "solid and yet binary"}) {
    const std::string bytes = binary(head, square);
    EXPECT_TRUE(is_binary_stl(bytes));
    const Mesh mesh = parse_stl(bytes, "a.stl");
    EXPECT_EQ(mesh.positions, corners_of_square());
    EXPECT_FALSE(std::signbit(mesh.positions(0, 0)));
    EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(mesh.notes, (Names{"a.stl: welded 6 corners to 4 vertices"}));
    EXPECT_TRUE(mesh.warnings.empty());
  }
}

TEST(Stl, SolidsAreObjects) {
  const Mesh mesh = parse_stl(
      solid("left  side", lower) + solid("", upper) + solid("top", lower) + solid("left side\\", upper), "a.stl");
  EXPECT_EQ(mesh.objects.names, (Names{"left side", "top"}));
  EXPECT_EQ(mesh.objects.of_face, (Ids{0, -1, 1, 0}));
  EXPECT_EQ(mesh.num_vertices(), 4);
}

TEST(Stl, TextIsFreeOfLineEndsAndOfCase) {
  std::string text = "  SOLID a\r\n" + lower + upper + "ENDSOLID\r\n";
  for (std::size_t i = text.find("facet"); i < text.size(); ++i)
    if (text[i] == '\n' && i > 12 && text.compare(i + 1, 8, "ENDSOLID") != 0) text[i] = i % 2 == 0 ? ' ' : '\n';
  const std::string given[] = {"facet", "Normal", "OUTER", "vertex", "endloop"};
  for (const std::string& word : given) {
    std::string lower_case = word;
    for (char& c : lower_case) c = char(std::tolower(c));
    if (const std::size_t at = text.find(lower_case); at != std::string::npos) text.replace(at, word.size(), word);
  }
  const Mesh mesh = parse_stl(text, "a.stl");
  EXPECT_EQ(mesh.positions, corners_of_square());
  EXPECT_EQ(mesh.objects.of_face, (Ids{0, 0}));
}

TEST(Stl, TrianglesWithTwoEqualCornersAreLeftOut) {
  const std::string needle = facet("5 5 5", "6 6 6", "5 5 5");
  const Mesh text = parse_stl(solid("a", lower + needle) + solid("b", needle + upper), "a.stl");
  EXPECT_EQ(text.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(text.positions, corners_of_square());
  EXPECT_EQ(text.objects.of_face, (Ids{0, 1}));
  const std::string warning = "a.stl: 2 of 4 triangles have two equal corners and are left out; the first is number 1";
  EXPECT_EQ(text.notes, (Names{"a.stl: welded 6 corners to 4 vertices"}));
  EXPECT_EQ(text.warnings, (Names{warning}));
  const std::vector<float> same{5, 5, 5, 6, 6, 6, 6, 6, 6}, also{0, 5, 5, -0.0f, 5, 5, 6, 6, 6};
  const Mesh bytes = parse_stl(binary("", {square[0], same, also, square[1]}), "a.stl");
  EXPECT_EQ(bytes.positions, corners_of_square());
  EXPECT_EQ(bytes.notes, (Names{"a.stl: welded 6 corners to 4 vertices"}));
  EXPECT_EQ(bytes.warnings, (Names{warning}));
  expect_error<InvalidMesh>([&] { (void)parse_stl(binary("", {same}), "a.stl"); }, {"a.stl: no triangles"});
}

TEST(Stl, SaysWhatCannotBeUnderstood) {
  const auto expect = [](const std::string& bytes, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(bytes.substr(0, 60));
    expect_error<FormatError>([&] { (void)parse_stl(bytes, "a.stl"); }, parts);
  };
  expect("", {"a.stl: the file is empty"});
  expect("ply\n", {"a.stl: 4 bytes are no STL file; text begins with 'solid'", "84 bytes"});
  const std::string whole = binary("", square);
  expect(whole.substr(0, whole.size() - 1), {"a.stl: 2 triangles cannot be in the 99 bytes that follow"});
  std::string many = whole;
  many.replace(80, 4, "\xff\xff\xff\xff");
  expect(many, {"a.stl: 4294967295 triangles cannot be in the 100 bytes"});
  expect("solid a\n" + std::string(600, ' ') + std::string("\0", 1), {"a.stl:2: byte 608 is zero", "not a text STL"});
  expect("solid a\nvertex 0 0 0\n", {"a.stl:2: unexpected 'vertex'; 'facet', 'endsolid' or another 'solid'"});
  expect("solid a\n" + lower.substr(0, lower.find("endloop")),
         {"a.stl:", "the file ends where 'endloop' of triangle 0 should be"});
  expect(solid("a", lower + lower.substr(0, lower.find("      vertex 1 1")) + "endloop endfacet"),
         {"a.stl:13: 'endloop' where 'vertex' of triangle 1 should be"});
  expect(solid("a", facet("0 0 0", "1 0 0", "1 1 0\nvertex 0 1 0")),
         {"a.stl:7: 'vertex' where 'endloop' of triangle 0 should be"});
  expect(solid("a", facet("0 0 0", "1 x 0", "1 1 0")), {"a.stl:5: coordinate y 'x' is not a number"});
}

TEST(Stl, SaysWhatIsNoMesh) {
  const auto expect = [](const std::string& bytes, std::initializer_list<std::string_view> parts) {
    expect_error<InvalidMesh>([&] { (void)parse_stl(bytes, "a.stl"); }, parts);
  };
  expect("solid a\nendsolid a\n", {"a.stl: no triangles; a mesh should have some"});
  expect(solid("a", facet("0 0 0", "1 inf 0", "1 1 0")), {"a.stl:5: coordinate y is 'inf'"});
  std::vector<float> bad = square[0];
  bad[4] = std::numeric_limits<float>::infinity();
  expect(binary("", {square[0], bad}), {"a.stl: byte 162: a coordinate of triangle 1 is inf"});
  expect(binary("", {}), {"a.stl: no triangles"});
}

TEST(Stl, DataBehindTheLastTriangleAreWarnedAbout) {
  const Mesh mesh = parse_stl(binary("", square) + "more", "a.stl");
  EXPECT_EQ(mesh.num_faces(), 2);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(mesh.warnings[0], "a.stl: byte 184: data behind the last triangle ignored");
}

float number(const std::string& bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) bits |= std::uint32_t(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return std::bit_cast<float>(bits);
}

// A pentagon in the plane x = 2, seen from the right, as a fan around its first corner: three triangles with normal x.
TEST(Stl, PolygonsAreWrittenAsFans) {
  Mesh mesh;
  mesh.positions.resize(5, 3);
  mesh.positions << 2, 0, 0, 2, 1, 0, 2, 1.5, 1, 2, 0.5, 2, 2, -1, 1;
  mesh.face_sizes = {5};
  mesh.face_vertices = {0, 1, 2, 3, 4};
  const std::string bytes = format_stl(mesh);
  ASSERT_TRUE(is_binary_stl(bytes));
  EXPECT_EQ(bytes.size(), 84u + 3 * 50);
  EXPECT_FALSE(bytes.starts_with("solid"));
  const Mesh read = parse_stl(bytes, "a.stl");
  EXPECT_EQ(read.face_vertices, (Ids{0, 1, 2, 0, 2, 3, 0, 3, 4}));
  EXPECT_EQ(read.positions, mesh.positions);
  for (std::size_t t = 0; t < 3; ++t) {
    EXPECT_EQ(number(bytes, 84 + 50 * t), 1);
    EXPECT_EQ(number(bytes, 88 + 50 * t), 0);
    EXPECT_EQ(number(bytes, 92 + 50 * t), 0);
  }
  mesh.positions.row(2) = mesh.positions.row(0);  // an area of nothing has no normal
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(number(format_stl(mesh), 84 + 4 * i), 0);
  mesh.positions(4, 1) = 3.5e38;
  expect_error<InvalidMesh>([&] { (void)format_stl(mesh); },
                            {"STL: vertex 4 has a coordinate beyond the numbers of 32 bits", "write a .ply"});
}

// An arrow head, whose area is 2 - 1 = 1: a fan around its first corner would cover the notch twice.
TEST(Stl, PolygonsThatAreNotConvexAreCutInside) {
  Mesh mesh;
  mesh.positions.resize(4, 3);
  mesh.face_sizes = {4};
  mesh.face_vertices = {0, 1, 2, 3};
  for (int first = 0; first < 4; ++first) {
    const double arrow[4][2] = {{0, 0}, {2, 1}, {0, 2}, {1, 1}};
    for (int i = 0; i < 4; ++i) mesh.positions.row(i) << arrow[(i + first) % 4][0], arrow[(i + first) % 4][1], 0;
    const std::string bytes = format_stl(mesh);
    const Mesh read = parse_stl(bytes, "a.stl");
    ASSERT_EQ(read.num_faces(), 2);
    double area = 0;
    for (std::size_t t = 0; t < 2; ++t) {
      EXPECT_EQ(number(bytes, 92 + 50 * t), 1) << first;  // the normal looks up
      const auto corner = [&](std::size_t i) { return read.positions.row(read.face_vertices[3 * t + i]); };
      area += ((corner(1) - corner(0)).head<2>()[0] * (corner(2) - corner(0))[1] -
               (corner(1) - corner(0))[1] * (corner(2) - corner(0))[0]) /
              2;
    }
    EXPECT_EQ(area, 1);
  }
}

// Around 1e8 floats are 8 apart.
TEST(Stl, PointsThatBecomeEqualAreTold) {
  Mesh mesh = cube();
  EXPECT_TRUE(changes_in_stl(mesh).empty());
  mesh.positions.col(0).array() += 1e8;
  ASSERT_EQ(changes_in_stl(mesh).size(), 1u);
  EXPECT_EQ(changes_in_stl(mesh)[0].substr(0, 73),
            "4 of 8 different points become equal to another one in its numbers of 32 ");
}

TEST(Stl, FilesAreTheSameForAnyNumberOfThreads) {
  const TemporaryDirectory directory;
  const Mesh mesh = torus(80, 70);
  const std::string bytes = format_stl(mesh);
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    write_stl(directory / "a.stl", mesh);
    EXPECT_EQ(read_file(directory / "a.stl"), bytes);
  }
  const Mesh read = read_stl(directory / "a.stl");
  EXPECT_EQ(read.num_vertices(), mesh.num_vertices());
  EXPECT_EQ(read.num_faces(), 2 * mesh.num_faces());
  expect_error<IoError>([&] { (void)read_stl(directory / "no.stl"); }, {"no.stl: cannot read"});
}

}  // namespace
}  // namespace sublimit::testing
