// SPDX-License-Identifier: Apache-2.0
// What free-form curves and surfaces of an OBJ file can have wrong, and what the reader says about it: file:line, what,
// what would be right. And what cannot be written.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/io/free_form.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

// 9 lines; what is appended starts in line 10.
const std::string nine = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\n";

struct BadShape {
  std::string text;  // behind `nine`
  std::vector<std::string_view> message;
};

template <class Expected>
void expect_rejected(const std::vector<BadShape>& shapes) {
  for (const BadShape& shape : shapes) {
    SCOPED_TRACE(shape.text);
    for (const std::string_view part : shape.message)
      expect_error<Expected>([&] { parse_free_form(nine + shape.text, "a.obj"); }, {part});
  }
}

// A curve under a state of two lines: `curv` is line 12, `parm` 13, `end` 14.
std::string curve(const std::string& type, const std::string& degree, const std::string& points,
                  const std::string& parameters) {
  return "cstype " + type + "\ndeg " + degree + "\ncurv 0 1 " + points + "\nparm u " + parameters + "\nend\n";
}
// A surface likewise: `surf` 12, `parm` 13 and 14, `end` 15.
std::string surface(const std::string& type, const std::string& degrees, const std::string& points,
                    const std::string& u, const std::string& v) {
  return "cstype " + type + "\ndeg " + degrees + "\nsurf 0 1 0 1 " + points + "\nparm u " + u + "\nparm v " + v +
         "\nend\n";
}

TEST(FreeFormErrors, StateThatIsMissing) {
  expect_rejected<FormatError>({
      {"deg 3\ncurv 0 1 1 2 3 4\n", {"a.obj:11: 'curv' comes before any 'cstype'", "'cstype bspline'"}},
      {"cstype bezier\ncurv2 1 2\n", {"a.obj:11: 'curv2' comes before any 'deg'", "'deg 3 3'"}},
      {"cstype bezier\ndeg 2\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9\n",
       {"a.obj:12: 'surf' needs two degrees", "line 11 has one", "'deg 2 N'"}},
      {"cstype bmatrix\ndeg 2\nstep 1\ncurv 0 1 1 2 3\n", {"a.obj:13: 'curv' has no 'bmat u'", "9 numbers"}},
      {"cstype bmatrix\ndeg 2\nbmat u 1 0 0 0 1 0 0 0 1\ncurv 0 1 1 2 3\n",
       {"a.obj:13: 'curv' has no 'step' along u", "'step N'"}},
      {"cstype bmatrix\ndeg 1 1\nstep 1\nbmat u 1 0 0 1\nbmat v 1 0 0 1\nsurf 0 1 0 1 1 2 3 4\n",
       {"a.obj:15: 'surf' has no 'step' along v", "'step N N'"}},
      {"cstype bmatrix\ndeg 2\nstep 1\nbmat u 1 0 0 0 1 0 0 0\ncurv 0 1 1 2 3\n",
       {"a.obj:14: 'curv' has a 'bmat u' of 8 numbers; degree 2 needs 9"}},
  });
}

TEST(FreeFormErrors, StateThatIsWrong) {
  expect_rejected<FormatError>({
      {"cstype nurbs\n",
       {"a.obj:10: unknown cstype 'nurbs'", "'bmatrix', 'bezier', 'bspline', 'cardinal' or 'taylor'"}},
      {"cstype\n", {"a.obj:10: unknown cstype ''"}},
      {"cstype rat\n", {"a.obj:10: unknown cstype ''"}},
      {"cstype bspline rat\n", {"a.obj:10: 'rat' behind 'cstype'", "should end there"}},
      {"deg 0\n", {"a.obj:10: degree 0; it should be 1 to 1000"}},
      {"deg 3 0\n", {"a.obj:10: degree 0"}},
      {"deg -2\n", {"a.obj:10: degree -2"}},
      {"deg 1001\n", {"a.obj:10: degree 1001; it should be 1 to 1000"}},
      {"deg 99999999999999999999\n", {"a.obj:10: degree '99999999999999999999' is too large"}},
      {"deg 2.5\n", {"a.obj:10: degree '2.5' is not a number"}},
      {"deg\n", {"a.obj:10: the line ends where degree should be"}},
      {"deg 1 2 3\n", {"a.obj:10: '3' behind 'degree'"}},
      {"step 0\n", {"a.obj:10: step 0"}},
      {"bmat w 1\n", {"a.obj:10: 'bmat' has 'w' where its direction should be, 'u' or 'v'"}},
      {"bmat u 1 x\n", {"a.obj:10: entry of the basis matrix 'x'"}},
      {"cstype cardinal\ndeg 2\ncurv 0 1 1 2 3 4\n", {"a.obj:12: 'curv' is cardinal and has degree 2; it should be 3"}},
  });
}

TEST(FreeFormErrors, ControlPointsThatDoNotFitTheDegree) {
  expect_rejected<FormatError>({
      {curve("bspline", "3", "1 2 3", "0 0 0 0 1 1 1"),
       {"a.obj:12: curv has 3 control points; a bspline of degree 3 has 4"}},
      {curve("bezier", "3", "1 2 3 4 5", "0 1"),
       {"a.obj:12: curv has 5 control points; a bezier of degree 3 has 4 or 7"}},
      {curve("bezier", "3", "1", "0 1"), {"a.obj:12: curv has 1 control point; a bezier of degree 3 has 4"}},
      {curve("bezier", "1000", "1 2", "0 1"),
       {"a.obj:12: curv has 2 control points; a bezier of degree 1000 has 1001"}},
      {curve("cardinal", "3", "1 2 3", "0 1"), {"a.obj:12: curv has 3 control points; a cardinal of degree 3 has 4"}},
      {curve("taylor", "1", "1 2 3", "0 1"), {"a.obj:12: curv has 3 control points; a taylor of degree 1 has 2 or 4"}},
      {"cstype bmatrix\ndeg 1\nstep 3\nbmat u 1 0 0 1\ncurv 0 1 1 2 3\nparm u 0 1\nend\n",
       {"a.obj:14: curv has 3 control points; a bmatrix of degree 1 has 2 or 5"}},
      {"cstype bezier\ndeg 1\ncurv 0 1\nparm u 0 1\nend\n", {"a.obj:12: curv has 0 control points"}},
  });
}

TEST(FreeFormErrors, ParametersThatDoNotFitTheControlPoints) {
  expect_rejected<FormatError>({
      {curve("bspline", "3", "1 2 3 4 5", "0 0 0 0 1 1 1 1"),
       {"a.obj:13: parm u has 8 values; 5 control points of a bspline of degree 3 need 9, or 7 without the first and "
        "the last"}},
      {curve("bspline", "3", "1 2 3 4 5", "0 0 0 0 1 2 2 2 2 2"), {"a.obj:13: parm u has 10 values", "need 9"}},
      {curve("bezier", "2", "1 2 3 4 5", "0 1"),
       {"a.obj:13: parm u has 2 values; 5 control points of a bezier of degree 2 need 3"}},
      {curve("cardinal", "3", "1 2 3 4 5 6", "0 1 2"), {"a.obj:13: parm u has 3 values", "need 4"}},
      {curve("taylor", "1", "1 2 3 4", "0 1"), {"a.obj:13: parm u has 2 values", "need 3"}},
      {"cstype bmatrix\ndeg 1\nstep 2\nbmat u 1 0 0 1\ncurv 0 1 1 2 3 4\nparm u 0 1 2 3\nend\n",
       {"a.obj:15: parm u has 4 values; 4 control points of a bmatrix of degree 1 need 3"}},
      {"cstype bspline\ndeg 1\ncurv 0 1 1 2\nend\n",
       {"a.obj:12: curv has no 'parm u'; a bspline of degree 1 needs at least 4 values, before its 'end'"}},
      {"cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nend\n",
       {"a.obj:12: surf has no 'parm v'; a bezier of degree 1 needs at least 2 values"}},
      {surface("bspline", "2 2", "1 2 3 4 5 6 7 8", "0 0 0 1 1 1", "0 0 0 1 1 1"),
       {"a.obj:12: surf has 8 control points; parm u of 6 values and parm v of 6 values, bspline of degree 2 x 2, "
        "belong to 3 x 3 = 9, or without first and last knots to 5 x 5 = 25"}},
      {surface("bezier", "1 2", "1 2 3 4 5 6 7 8 9", "0 1", "0 1"),
       {"a.obj:12: surf has 9 control points", "bezier of degree 1 x 2, belong to 2 x 3 = 6"}},
      {surface("bspline", "3 1", "1 2 3 4 5 6 7 8", "0 0 1 1 1", "0 0 1 1"),
       {"a.obj:13: parm u has 5 values; a bspline of degree 3 has at least 8, or 6 without"}},
      {surface("bezier", "2 2", "1 2 3 4 5 6 7 8 9", "0 1", "1"),
       {"a.obj:14: parm v has 1 value; a bezier of degree 2 has at least 2"}},
      {surface("bspline", "1 3", "1 2 3 4 5 6 7 8", "0 0 1 1", "0 0 0 1 1 1"),
       {"a.obj:12: surf has 8 control points", "belong to 4 x 4 = 16"}},
  });
}

TEST(FreeFormErrors, KnotsAndParametersOutOfOrder) {
  expect_rejected<FormatError>({
      {curve("bspline", "1", "1 2 3", "0 0 2 1 2"), {"a.obj:13: parm u: value 4 is 1 after 2; knots should not fall"}},
      {curve("bspline", "1", "1 2 3", "0 0 \\\n2 \\\n1 2"), {"a.obj:15: parm u: value 4 is 1 after 2"}},
      {curve("bezier", "1", "1 2 3", "0 1 1"),
       {"a.obj:13: parm u: value 3 is 1 after 1; values of a bezier should rise"}},
      {curve("taylor", "1", "1 2", "1 0"), {"a.obj:13: parm u: value 2 is 0 after 1"}},
      // An example of the printed specification has all knots of v equal.
      {surface("bspline", "2 2", "1 2 3 4 5 6 7 8 9", "-1 -1 -1 2.5 2.5 2.5", "-2 -2 -2 -2 -2 -2"),
       {"a.obj:14: parm v: the domain, knots 3 to 4 of 6, is -2 to -2; it should not be empty"}},
      {curve("bspline", "3", "1 2 3 4", "0 0 0 1 1 2 2 2"),
       {"a.obj:13: parm u: the domain, knots 4 to 5 of 8, is 1 to 1"}},
      {curve("bspline", "2", "1 2 3 4 5 6", "0 0 0 1 1 1 2 2 2"),
       {"a.obj:13: parm u: knot 1 is there 3 times, from value 4 on; of degree 2 it can be there 2 times, at the ends "
        "3"}},
      {curve("bspline", "1", "1 2 3 4", "0 0 0 1 2 2"), {"a.obj:13: parm u: knot 0 is there 3 times, from value 1 on"}},
      {curve("bspline", "1", "1 2 3 4", "-1 0 0 1 1 1"),
       {"a.obj:13: parm u: knot 0 is there 2 times, from value 2 on; of degree 1 it can be there 1 time, at the ends "
        "2"}},
  });
}

TEST(FreeFormErrors, NumbersThatAreNoneOrNotFinite) {
  expect_rejected<FormatError>({
      {curve("bezier", "1", "1 2", "0 x"), {"a.obj:13: parm u 'x' is not a number"}},
      {curve("bezier", "1", "1 2", ""), {"a.obj:13: the line ends where parm u should be"}},
      {"v 0 0 0 red\n", {"a.obj:10: weight 'red' is not a number"}},
      {"vp\n", {"a.obj:10: the line ends where parameter should be"}},
      {"vn 0 0\n", {"a.obj:10: the line ends where normal z should be"}},
      {"cstype bezier\ndeg 1\ncurv 0\n", {"a.obj:12: the line ends where end of the range should be"}},
  });
  expect_rejected<InvalidMesh>({
      {"v 0 0 0 nan\n", {"a.obj:10: weight is 'nan'", "finite"}},
      {"v 0 inf 0\n", {"a.obj:10: coordinate y is 'inf'"}},
      {"vp 0 -inf\n", {"a.obj:10: parameter is '-inf'"}},
      {"vt nan\n", {"a.obj:10: texture coordinate is 'nan'"}},
      {"bmat u 1 nan\n", {"a.obj:10: entry of the basis matrix is 'nan'"}},
      {curve("bezier", "1", "1 2", "0 inf"), {"a.obj:13: parm u is 'inf'; it should be a finite number"}},
      {"cstype bezier\ndeg 1\ncurv nan 1 1 2\n", {"a.obj:12: start of the range is 'nan'"}},
      {"cstype bezier\ndeg 1 1\nsurf 0 1 0 inf 1 2 3 4\n", {"a.obj:12: end of the range is 'inf'"}},
  });
}

TEST(FreeFormErrors, Ranges) {
  const std::string state = "cstype bezier\ndeg 1 1\n";
  expect_rejected<FormatError>({
      {state + "curv 1 0 1 2\n", {"a.obj:12: the range of the parameter is 1 to 0; it should rise"}},
      {state + "surf 0 1 2 2 1 2 3 4\n", {"a.obj:12: the range of the parameter is 2 to 2"}},
      {state + "curv 2 3 1 2\nparm u 0 1\nend\n",
       {"a.obj:12: curv: the range 2 to 3 has nothing of the domain, which is 0 to 1 by parm u"}},
      {state + "surf 0 1 1 9 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n",
       {"a.obj:12: surf: the range 1 to 9 has nothing of the domain, which is 0 to 1 by parm v"}},
  });
}

TEST(FreeFormErrors, IndicesThatPointNowhere) {
  const std::string bezier = "cstype bezier\ndeg 1 1\n", rest = "\nparm u 0 1\nend\n",
                    rests = "\nparm u 0 1\nparm v 0 1\nend\n";
  expect_rejected<FormatError>({
      {bezier + "curv 0 1 0 1\n", {"a.obj:12: index 0", "count from 1"}},
      {bezier + "curv 0 1 1 x\n", {"a.obj:12: index 'x' is not a number"}},
      {bezier + "curv 0 1 1/1 2/2\n", {"a.obj:12: index '1/1' is not a number"}},
      {bezier + "surf 0 1 0 1 1/1/1/1\n", {"a.obj:12: control point '1/1/1/1' has more than 3 indices", "'v/vt/vn'"}},
      {bezier + "surf 0 1 0 1 1 2/1 3 4\n", {"a.obj:12: control point '2/1', number 2", "all or none"}},
      {bezier + "surf 0 1 0 1 1//1 2 3//1 4//1\n", {"a.obj:12: control point '2', number 2"}},
      {"vp 0.5\n" + bezier + "curv2 1 1" + rest, {"a.obj:13: curv2: control point 1 has one coordinate", "'vp u v'"}},
  });
  expect_rejected<InvalidMesh>({
      {bezier + "curv 0 1 1 10" + rest, {"a.obj:12: index 10 is out of range; the file has 9 vertices, 1 to 9"}},
      {bezier + "curv 0 1 1 \\\n4000000000" + rest, {"a.obj:13: index 4000000000 is out of range"}},
      {bezier + "curv 0 1 1 -10\n", {"a.obj:12: index -10 counts back beyond the first of 9 vertices so far"}},
      {bezier + "curv2 1 2" + rest, {"a.obj:12: index 1 is out of range; the file has no points 'vp'"}},
      {bezier + "surf 0 1 0 1 1/1 2/1 3/1 4/1" + rests,
       {"a.obj:12: index 1 is out of range", "no texture coordinates"}},
      {bezier + "surf 0 1 0 1 1//1 2//1 3//1 4//1" + rests,
       {"a.obj:12: index 1 is out of range; the file has no normals"}},
      {bezier + "surf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\ntrim 0 1 1\nend\n",
       {"a.obj:15: index 1 is out of range; the file has no curves 'curv2'"}},
      {bezier + "curv 0 1 1 2\nsp 1\nparm u 0 1\nend\n", {"a.obj:13: index 1", "no points 'vp'"}},
      {bezier + "curv 0 1 1 2" + rest + "con 1 0 1 1 2 0 1 1\n",
       {"a.obj:15: index 1 is out of range; the file has no curves 'curv2'"}},
      {"vp 0 0\nvp 1 1\n" + bezier + "curv2 1 2" + rest + "con 1 0 1 1 2 0 1 1\n",
       {"a.obj:17: index 1 is out of range; the file has no surfaces"}},
  });
}

TEST(FreeFormErrors, StatementsOutOfPlace) {
  const std::string start = "cstype bezier\ndeg 1 1\ncurv 0 1 1 2\n";
  const std::string surf = "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\n";
  std::vector<BadShape> outside;
  for (const std::string keyword : {"parm u 0 1", "trim 0 1 1", "hole 0 1 1", "scrv 0 1 1", "sp 1", "end"})
    outside.push_back({keyword + "\n", {"a.obj:10: '", "' belongs to no element", "'curv', 'curv2' or 'surf'"}});
  expect_rejected<FormatError>(outside);
  expect_rejected<FormatError>({
      {start, {"a.obj:12: 'curv' has no 'end'"}},
      {start + "parm u 0 1\n\n", {"a.obj:12: 'curv' has no 'end'"}},
      {start + "parm u 0 1\ncurv 0 1 1 2\n",
       {"a.obj:14: 'curv' inside of the 'curv' of line 12, which has no 'end' yet"}},
      {start + "v 0 0 0\n", {"a.obj:13: 'v' inside of the 'curv' of line 12", "only 'parm', 'trim'"}},
      {start + "foo\n", {"a.obj:13: 'foo' inside of the 'curv' of line 12"}},
      {start + "\x80\n", {"a.obj:13: '\\x80' inside of"}},
      {start + "parm v 0 1\n", {"a.obj:13: 'parm v' inside of the 'curv' of line 12, which has one parameter, u"}},
      {start + "parm w 0 1\n", {"a.obj:13: 'parm' has 'w' where its direction should be"}},
      {start + "parm 0 1\n", {"a.obj:13: 'parm' has '0' where its direction should be"}},
      {start + "parm u 0 1\nparm u 0 1\n", {"a.obj:14: a second 'parm u'", "the first is in line 13"}},
      {start + "trim 0 1 1\n", {"a.obj:13: 'trim' inside of the 'curv' of line 12; only a 'surf'"}},
      {start + "parm u 0 1\nend now\n", {"a.obj:14: 'now' behind 'end'"}},
      {surf + "trim\n", {"a.obj:13: the line ends where start of the curve should be"}},
      {surf + "hole 0 1\n", {"a.obj:13: the line ends where index should be"}},
      {surf + "sp\n", {"a.obj:13: the line ends where index should be"}},
      {"con 1 0 1 1 2 0 1\n", {"a.obj:10: the line ends where index should be"}},
      {"con 1 0 1 1 2 0 1 1 1\n", {"a.obj:10: '1' behind 'con'"}},
      {"\xff\xd8\n", {"a.obj:10: the line starts with '\\xff\\xd8', so this is not a text OBJ file"}},
  });
}

TEST(FreeFormErrors, WeightsThatAreAllZero) {
  const std::string points = "v 0 0 0 0\nv 1 0 0 0\nvp 0 0 0\nvp 1 0 -0\ncstype rat bezier\ndeg 1\n";
  expect_rejected<InvalidMesh>({
      {points + "curv 0 1 -2 -1\nparm u 0 1\nend\n", {"a.obj:16: curv: the weights of all control points are 0"}},
      {points + "curv2 -2 -1\nparm u 0 1\nend\n", {"a.obj:16: curv2: the weights of all control points are 0"}},
  });
}

TEST(FreeFormErrors, MemoryIsInProportionToTheText) {
  // Whatever is claimed, only what is there takes room.
  EXPECT_EQ(
      parse_free_form(nine + surface("bezier", "1 1", "1 2 3 4", "0 1e300", "-1e300 1e300"), "a.obj").surfaces.size(),
      1u);
  expect_rejected<FormatError>({
      {"cstype bmatrix\ndeg 1000 1000\nstep 2147483647 2147483647\nbmat u 1\nsurf 0 1 0 1 1 2 3 4\n",
       {"a.obj:14: 'surf' has a 'bmat u' of 1 numbers; degree 1000 needs 1002001"}},
      {"cstype bmatrix\ndeg 1 1\nstep 2147483647 2147483647\nbmat u 1 0 0 1\nbmat v 1 0 0 1\nsurf 0 1 0 1 1 2 3 4\n"
       "parm u 0 1 2 3\nparm v 0 1 2 3\nend\n",
       {"a.obj:15: surf has 4 control points", "belong to 4294967296 x 4294967296"}},
  });
  // Neither names nor matrices are repeated for each element.
  std::string text = nine + "g " + std::string(100000, 'x') + "\ncstype bezier\ndeg 1\n";
  for (int i = 0; i < 10000; ++i) text += "curv 0 1 1 2\nparm u 0 1\nend\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  EXPECT_EQ(shapes.names.size(), 1u);
  EXPECT_EQ(shapes.curves.back().group, 0);
}

TEST(FreeFormErrors, WhatCannotBeWritten) {
  const FreeForm good = parse_free_form(
      nine + "g a\n" + surface("rat bspline", "2 2", "1 2 3 4 5 6 7 8 9", "0 0 0 1 1 1", "0 0 0 1 1 1"), "a.obj");
  const auto expect_refused = [&](auto change, std::string_view part) {
    FreeForm shapes = good;
    change(shapes, shapes.surfaces[0]);
    expect_error<InvalidParameter>([&] { format_free_form(shapes); }, {part});
  };
  expect_refused([](FreeForm& shapes, FreeFormSurface&) { shapes.weights.pop_back(); }, "weight");
  expect_refused([](FreeForm& shapes, FreeFormSurface&) { shapes.names[0] = "a\nb"; }, "name");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.points.pop_back(); }, "product");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.points[3] = 9; }, "indices");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.texture = {0}; }, "texture");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.group = 1; }, "names");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.u.degree = 0; }, "degree");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.u.parameters.pop_back(); }, "parm");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.v.parameters[5] = 0; }, "fall");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.v.last = 2; }, "domain");
  expect_refused([](FreeForm&, FreeFormSurface& surface) { surface.v.parameters = {0, 0, 0, 0, 1, 1}; },
                 "degree times");
  for (const double value : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    FreeForm shapes = good;
    shapes.vertices(2, 1) = value;
    expect_error<InvalidMesh>([&] { format_free_form(shapes); }, {"not finite"});
    shapes = good;
    shapes.surfaces[0].u.parameters[5] = value;
    expect_error<InvalidMesh>([&] { format_free_form(shapes); }, {"not finite"});
  }
}

}  // namespace
}  // namespace sublimit::testing
