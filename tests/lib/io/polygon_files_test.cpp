// SPDX-License-Identifier: Apache-2.0
// Polygons from text and back.
#include <gtest/gtest.h>

#include "sublimit/io/detail/polygon_files.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

TEST(PolygonCsv, PointsOfAnyDimension) {
  EXPECT_EQ(parse_polygon_csv("1\n2\n3\n", "p.csv").dimension(), 1);
  const ControlPolygon polygon = parse_polygon_csv("1,2,3,4,5\n6,7,8,9,1e-300\r\n-1, +2 ,\t3,4,5", "p.csv");
  EXPECT_EQ(polygon.dimension(), 5);
  ASSERT_EQ(polygon.num_points(), 3);
  EXPECT_EQ(polygon.points(1, 4), 1e-300);
  EXPECT_EQ(polygon.points(2, 1), 2);
  ASSERT_EQ(polygon.curves.size(), 1u);
  EXPECT_FALSE(polygon.curves[0].closed);
}

TEST(PolygonCsv, HeaderCommentsBlankLines) {
  const ControlPolygon polygon = parse_polygon_csv(
      "\xEF\xBB\xBF# made by hand\nx,y\n0,0\n# still the first\n1,0 # here\n\n\n2,0\n3,0\n4,0\n\n", "p.csv");
  EXPECT_EQ(polygon.columns, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(polygon.curves.size(), 2u);
  EXPECT_EQ(polygon.curves[0].points, (std::vector<Index>{0, 1}));
  EXPECT_EQ(polygon.curves[1].points, (std::vector<Index>{2, 3, 4}));
}

TEST(PolygonCsv, Tangents) {
  const ControlPolygon polygon = parse_polygon_csv("x,y,tx,ty\n1,2,3,4\n", "p.csv", true);
  EXPECT_EQ(polygon.points(0, 1), 2);
  EXPECT_EQ(polygon.tangents(0, 0), 3);
  expect_error<FormatError>([] { parse_polygon_csv("1,2,3\n", "p.csv", true); }, {"p.csv:1", "3 columns", "tx"});
}

TEST(PolygonCsv, OtherColumnsThanPointsAndTangentsAreRefused) {
  const auto refuses = [](const char* header, const char* row, bool tangents,
                          std::initializer_list<std::string_view> parts) {
    expect_error<FormatError>([&] { parse_polygon_csv(std::string(header) + "\n" + row + "\n", "p.csv", tangents); },
                              parts);
  };
  refuses("x,y,tx,ty,ax,ay", "1,2,3,4,5,6", true,
          {"p.csv:1", "6 columns, of which 2 are coordinates", "x,y,tx,ty or x,y,z,tx,ty,tz, and no other"});
  refuses("x,y,z,tx,ty,tz,ax,ay,az", "1,2,3,4,5,6,7,8,9", true, {"p.csv:1", "9 columns", "no other columns"});
  refuses("x,y,z,tx,ty,tz,kx,ky", "1,2,3,4,5,6,7,8", true, {"p.csv:1", "8 columns, of which 3"});
  refuses("tx,ty,x,y", "1,2,3,4", true, {"column 3 is named 'x'", "belongs to column 1"});
  refuses("x,y,tx,ty", "1,2,3,4", false, {"p.csv:1", "column 3 is named 'tx'", "points alone"});
  refuses("id,x,y", "1,2,3", false, {"column 2 is named 'x'", "coordinates come first"});
  // Names that say nothing are taken, and 6 columns without names are told how they were read.
  EXPECT_EQ(parse_polygon_csv("x,y,z,w\n1,2,3,4\n", "p.csv").dimension(), 4);
  EXPECT_EQ(parse_polygon_csv("px,py\n1,2\n", "p.csv").dimension(), 2);
  EXPECT_EQ(parse_polygon_csv("x,y,z,tx,ty,tz\n1,2,3,4,5,6\n", "p.csv", true).warnings.size(), 0u);
  const ControlPolygon unnamed = parse_polygon_csv("1,2,3,4,5,6\n", "p.csv", true);
  EXPECT_EQ(unnamed.dimension(), 3);
  ASSERT_EQ(unnamed.warnings.size(), 1u);
  EXPECT_NE(unnamed.warnings[0].find("x,y,z,tx,ty,tz"), std::string::npos);
}

TEST(PolygonCsv, Errors) {
  const auto fails = [](std::string_view text, std::initializer_list<std::string_view> parts) {
    expect_error<FormatError>([&] { parse_polygon_csv(text, "p.csv"); }, parts);
  };
  fails("1,2\n3\n", {"p.csv:2", "1 value where", "2"});
  fails("x,y\n1,2\n3,abc\n", {"p.csv:3", "value 2", "'abc'", "not a number"});
  fails("1,2\n3,\n", {"p.csv:2", "value 2", "missing"});
  fails("1 2\n3 4\n", {"p.csv:1", "'1 2'", "commas"});
  fails("1;2\n", {"p.csv:1", "'1;2'", "commas"});
  fails("1,x\n2,3\n", {"p.csv:1", "'x'"});
  fails("1,0x1\n", {"p.csv:1", "'0x1'"});
  fails("1,1e999\n", {"p.csv:1", "1e999", "too large"});
  fails(std::string_view("1,2\n\0,1\n", 8), {"p.csv", "byte 4", "zero"});
  for (const char* word : {"nan", "inf", "-inf", "NAN"})
    expect_error<InvalidMesh>([&] { parse_polygon_csv("1,2\n3," + std::string(word) + "\n", "p.csv"); },
                              {"p.csv:2", word, "finite"});
  for (const char* text : {"", "\n\n", "x,y\n", "# nothing\n"})
    expect_error<InvalidMesh>([&] { parse_polygon_csv(text, "p.csv"); }, {"p.csv", "no points"});
}

TEST(PolygonObj, Lines) {
  const ControlPolygon polygon =
      parse_polygon_obj("v 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\no name\nl 1 2/1 3 4 1\nl -1 -2\\\n -3\n", "p.obj");
  ASSERT_EQ(polygon.curves.size(), 2u);
  EXPECT_TRUE(polygon.curves[0].closed);
  EXPECT_EQ(polygon.curves[0].points, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_FALSE(polygon.curves[1].closed);
  EXPECT_EQ(polygon.curves[1].points, (std::vector<Index>{3, 2, 1}));
}

TEST(PolygonObj, Errors) {
  const std::string points = "v 0 0 0\nv 1 0 0\n";
  expect_error<InvalidMesh>([&] { parse_polygon_obj(points + "l 1 3\n", "p.obj"); },
                            {"p.obj:3", "index 3", "2 vertices"});
  expect_error<InvalidMesh>([&] { parse_polygon_obj(points + "l 1 -3\n", "p.obj"); }, {"p.obj:3", "-3", "2 vertices"});
  expect_error<FormatError>([&] { parse_polygon_obj(points + "l 0 1\n", "p.obj"); }, {"p.obj:3", "index 0"});
  expect_error<FormatError>([&] { parse_polygon_obj(points + "l 1\n", "p.obj"); }, {"p.obj:3", "at least 2"});
  expect_error<FormatError>([&] { parse_polygon_obj(points + "l 1 x\n", "p.obj"); }, {"p.obj:3", "'x'"});
  expect_error<InvalidMesh>([&] { parse_polygon_obj("v 0 nan 0\nl 1 2\n", "p.obj"); }, {"p.obj:1", "nan"});
  expect_error<InvalidMesh>([&] { parse_polygon_obj(points, "p.obj"); }, {"no curves", "l 1 2 3"});
  expect_error<InvalidMesh>([&] { parse_polygon_obj(points + "v 0 1 0\nf 1 2 3\n", "p.obj"); },
                            {"1 face", "surface schemes"});
  expect_error<FormatError>([&] { parse_polygon_obj("", "p.obj"); }, {"p.obj", "empty"});
}

TEST(PolygonFiles, RoundTripsToTheSameBits) {
  const TemporaryDirectory directory;
  ControlPolygon polygon =
      parse_polygon_obj("v 0.1 1e-320 3\nv 1 0.3333333333333333 -0\nv 5 6 7\nv 1 1 1\nl 1 2 3 4 1\nl 4 2\n", "p.obj");
  for (const char* name : {"p.obj", "p.csv"}) {
    write_polygon(directory / name, polygon);
    const ControlPolygon again = read_polygon(directory / name);
    ASSERT_EQ(again.curves.size(), 2u);
    for (size_t c = 0; c < 2; ++c)
      for (size_t i = 0; i < polygon.curves[c].points.size(); ++i)
        EXPECT_EQ(again.points.row(again.curves[c].points[i]), polygon.points.row(polygon.curves[c].points[i]));
  }
  EXPECT_TRUE(read_polygon(directory / "p.obj").curves[0].closed);
  expect_error<FormatError>([&] { read_polygon(directory.write("p.txt", "")); }, {"'.txt'", ".csv and .obj"});
  expect_error<IoError>([&] { read_polygon(directory / "none.csv"); }, {"none.csv", "No such file"});
}

TEST(PolygonFiles, WhatCannotBeWritten) {
  expect_error<InvalidParameter>([] { format_polygon_obj(polygon_through(Points::Zero(3, 4))); },
                                 {"3 coordinates", ".csv"});
  Points points = Points::Zero(3, 2);
  points(1, 1) = std::numeric_limits<double>::infinity();
  for (const auto format : {format_polygon_csv, format_polygon_obj})
    expect_error<InvalidMesh>([&] { format(polygon_through(points)); }, {"not finite"});
}

TEST(PolygonFiles, AbsentTangentsAreEmptyFields) {
  ControlPolygon polygon = polygon_through(Points::Zero(2, 2));
  polygon.tangents = Points::Ones(2, 2);
  polygon.tangents.row(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(format_polygon_csv(polygon), "x,y,tx,ty\n0,0,1,1\n0,0,,\n");
}

}  // namespace
}  // namespace sublimit::testing
