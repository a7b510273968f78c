// SPDX-License-Identifier: Apache-2.0
// Free-form curves and surfaces of OBJ files: the forms that the format's specification shows, its state, what is
// written and read back.
#include "sublimit/io/free_form.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/polygon_files.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Indices = std::vector<Index>;
using Numbers = std::vector<double>;

// `count` vertices on a line.
std::string vertices(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "v " + format_number(i) + " 0 0\n";
  return text;
}

// Nine vertices, some with weights, as in the specification's trimmed surface.
const std::string weighted_net =
    "v -1.35 -1.03 0\nv 0.13 -1.03 0.432 7.6\nv 1.48 -1.03 0 2.3\nv -1.46 0.06 0.201\nv 0.12 0.06 0.915 0.5\n"
    "v 1.38 0.06 0.454 1.5\nv -1.48 1.03 0 2.3\nv 0.12 1.03 0.394 6.1\nv 1.17 1.03 0 3.3\n";
const std::string trimming_curve =
    "vp -0.675 1.85 3\nvp 0.915 1.93\nvp 2.485 0.47 2\nvp 2.485 -1.03\nvp 1.605 -1.89 10.7\nvp -0.745 -0.654 0.5\n"
    "cstype rat bezier\ndeg 3\ncurv2 -6 -5 -4 -3 -2 -1 -6\nparm u 0 1 2\nend\n";

std::string with_name(const FreeForm& shapes, Index name) {
  return name < 0 ? "" : shapes.names.at(static_cast<std::size_t>(name));
}

void expect_same(const FreeForm& a, const FreeFormDirection& u, const FreeForm& b, const FreeFormDirection& v) {
  EXPECT_EQ(u.degree, v.degree);
  EXPECT_EQ(u.count, v.count);
  EXPECT_EQ(u.parameters, v.parameters);
  EXPECT_EQ(u.first, v.first);
  EXPECT_EQ(u.last, v.last);
  EXPECT_EQ(u.step, v.step);
  ASSERT_EQ(u.matrix < 0, v.matrix < 0);
  if (u.matrix >= 0) {
    EXPECT_EQ(a.matrices.at(static_cast<std::size_t>(u.matrix)).values,
              b.matrices.at(static_cast<std::size_t>(v.matrix)).values);
  }
}

void expect_same(const FreeForm& a, const FreeFormElement& first, const FreeForm& b, const FreeFormElement& second) {
  EXPECT_EQ(first.basis, second.basis);
  EXPECT_EQ(first.rational, second.rational);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.special_points, second.special_points);
  EXPECT_EQ(with_name(a, first.group), with_name(b, second.group));
  EXPECT_EQ(with_name(a, first.object), with_name(b, second.object));
}

void expect_same_parts(const FreeFormCurvePart* a, const FreeFormCurvePart* b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(a[i].curve, b[i].curve);
    EXPECT_EQ(a[i].first, b[i].first);
    EXPECT_EQ(a[i].last, b[i].last);
  }
}

// All but lines, warnings and the order of names and matrices.
void expect_same(const FreeForm& a, const FreeForm& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.parameter_weights, b.parameter_weights);
  EXPECT_EQ(a.texture, b.texture);
  EXPECT_EQ(a.normals, b.normals);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  ASSERT_EQ(a.curves_2d.size(), b.curves_2d.size());
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
  ASSERT_EQ(a.connections.size(), b.connections.size());
  for (std::size_t i = 0; i < a.curves.size() + a.curves_2d.size(); ++i) {
    const std::size_t k = a.curves.size();
    const FreeFormCurve &first = i < k ? a.curves[i] : a.curves_2d[i - k],
                        &second = i < k ? b.curves[i] : b.curves_2d[i - k];
    expect_same(a, first, b, second);
    expect_same(a, first.u, b, second.u);
  }
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    const FreeFormSurface &first = a.surfaces[i], &second = b.surfaces[i];
    expect_same(a, first, b, second);
    expect_same(a, first.u, b, second.u);
    expect_same(a, first.v, b, second.v);
    EXPECT_EQ(first.texture, second.texture);
    EXPECT_EQ(first.normals, second.normals);
    ASSERT_EQ(first.loops.size(), second.loops.size());
    for (std::size_t k = 0; k < first.loops.size(); ++k) {
      EXPECT_EQ(first.loops[k].kind, second.loops[k].kind);
      ASSERT_EQ(first.loops[k].parts.size(), second.loops[k].parts.size());
      expect_same_parts(first.loops[k].parts.data(), second.loops[k].parts.data(), first.loops[k].parts.size());
    }
  }
  for (std::size_t i = 0; i < a.connections.size(); ++i) {
    EXPECT_EQ(a.connections[i].surfaces[0], b.connections[i].surfaces[0]);
    EXPECT_EQ(a.connections[i].surfaces[1], b.connections[i].surfaces[1]);
    expect_same_parts(a.connections[i].parts, b.connections[i].parts, 2);
  }
}

void expect_round_trip(const std::string& text) {
  SCOPED_TRACE(text);
  const FreeForm shapes = parse_free_form(text, "a.obj");
  expect_same(shapes, parse_free_form(format_free_form(shapes), "written.obj"));
}

TEST(FreeForm, RationalBsplineSurfaceOfTheSpecification) {
  std::string text = weighted_net;
  for (const char* const vt : {"0 0", "0.5 0", "1 0", "0 0.5", "0.5 0.5", "1 0.5", "0 1", "0.5 1", "1 1"})
    text += "vt " + std::string(vt) + "\n";
  text +=
      "cstype rat bspline\ndeg 2 2\nsurf 0.0 1.0 0.0 1.0 1/1 2/2 3/3 4/4 5/5 6/6 \\\n7/7 8/8 9/9\n"
      "parm u 0.0 0.0 0.0 1.0 1.0 1.0\nparm v 0.0 0.0 0.0 1.0 1.0 1.0\nend\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  ASSERT_EQ(shapes.surfaces.size(), 1u);
  const FreeFormSurface& surface = shapes.surfaces[0];
  EXPECT_EQ(surface.basis, FreeFormBasis::bspline);
  EXPECT_TRUE(surface.rational);
  EXPECT_EQ(surface.line, 21);
  EXPECT_EQ(surface.u.line, 23);
  EXPECT_EQ(surface.points, (Indices{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(surface.texture, surface.points);
  EXPECT_TRUE(surface.normals.empty());
  EXPECT_EQ(surface.u.degree, 2);
  EXPECT_EQ(surface.u.count, 3);
  EXPECT_EQ(surface.v.count, 3);
  EXPECT_EQ(surface.u.parameters, (Numbers{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(surface.v.last, 1);
  EXPECT_EQ(shapes.weights, (Numbers{1, 7.6, 2.3, 1, 0.5, 1.5, 2.3, 6.1, 3.3}));
  EXPECT_EQ(shapes.vertices.row(1), Eigen::RowVector3d(0.13, -1.03, 0.432));
  EXPECT_EQ(shapes.texture.row(1), Eigen::RowVector3d(0.5, 0, 0));
  EXPECT_TRUE(shapes.warnings.empty());
  expect_round_trip(text);
}

TEST(FreeForm, HermiteCurveByItsBasisMatrix) {
  const std::string text = vertices(6) +
                           "cstype bmatrix\ndeg 3\nstep 2\nbmat u 1 0 -3 2 \\\n 0 1 -2 1 \\\n 0 0 3 -2 \\\n 0 0 -1 1\n"
                           "curv 0 2 1 2 3 4 5 6\nparm u 0 1 2\nend\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  ASSERT_EQ(shapes.curves.size(), 1u);
  const FreeFormCurve& curve = shapes.curves[0];
  EXPECT_EQ(curve.basis, FreeFormBasis::bmatrix);
  EXPECT_EQ(curve.u.step, 2);
  EXPECT_EQ(curve.u.count, 6);
  ASSERT_EQ(curve.u.matrix, 0);
  EXPECT_EQ(shapes.matrices[0].values, (Numbers{1, 0, -3, 2, 0, 1, -2, 1, 0, 0, 3, -2, 0, 0, -1, 1}));
  expect_round_trip(text);
}

TEST(FreeForm, BezierSurfaceByItsBasisMatrix) {
  const std::string matrix = " 1 -3 3 -1 0 3 -6 3 0 0 3 -3 0 0 0 1\n";
  const std::string text = vertices(28) + "cstype bmatrix\ndeg 3 3\nstep 3 3\nbmat u" + matrix + "bmat v" + matrix +
                           "surf 0 2 0 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28\n"
                           "parm u 0 1 2\nparm v 0 1\nend\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  EXPECT_EQ(shapes.surfaces.at(0).u.count, 7);
  EXPECT_EQ(shapes.surfaces.at(0).v.count, 4);
  EXPECT_EQ(shapes.surfaces[0].v.matrix, 1);
  expect_round_trip(text);
}

TEST(FreeForm, CardinalSurfaceOfTheSpecification) {
  const std::string text = vertices(16) +
                           "cstype cardinal\nstech cparma 1 1\ndeg 3 3\n"
                           "surf 0 1 0 1 13 14 15 16 9 10 11 12 5 6 7 8 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  EXPECT_EQ(shapes.surfaces.at(0).points, (Indices{12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3}));
  EXPECT_TRUE(shapes.warnings.empty());
  expect_round_trip(text);
}

TEST(FreeForm, UniformBsplinePatchOfTheSpecification) {
  const std::string text = vertices(16) +
                           "g bspatch\ncstype bspline\nstech curv 0.5 10\ndeg 3 3\n"
                           "surf 0 1 0 1 13 14 \\\n15 16 9 10 11 12 5 6 7 8 1 2 3 4\n"
                           "parm u -3 -2 -1 0 1 2 3 4\nparm v -3 -2 -1 0 1 2 3 4\nend\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  const FreeFormSurface& surface = shapes.surfaces.at(0);
  EXPECT_EQ(with_name(shapes, surface.group), "bspatch");
  EXPECT_EQ(free_form_domain(surface.basis, surface.u), std::pair(0.0, 1.0));
  EXPECT_TRUE(shapes.warnings.empty());
  expect_round_trip(text);
}

TEST(FreeForm, TaylorCurve) {
  const FreeForm shapes =
      parse_free_form(vertices(8) + "cstype taylor\ndeg 3\ncurv 0.5 1.6 1 2 3 4 5 6 7 8\nparm u 0 1 2\nend\n", "a.obj");
  EXPECT_EQ(shapes.curves.at(0).u.count, 8);
  EXPECT_EQ(shapes.curves[0].u.first, 0.5);
  EXPECT_EQ(shapes.curves[0].u.last, 1.6);
}

TEST(FreeForm, CountsOfEveryBasis) {
  struct Case {
    FreeFormBasis basis;
    int degree;
    Index step;
    std::int64_t points, parameters;
  };
  // K + 1 points: knots K + n + 2; K/n + 1; K - 1; (K + 1)/(n + 1) + 1; (K - n)/s + 2.
  for (const Case& c : {Case{FreeFormBasis::bspline, 3, 0, 7, 11}, Case{FreeFormBasis::bezier, 3, 0, 7, 3},
                        Case{FreeFormBasis::bezier, 1, 0, 7, 7}, Case{FreeFormBasis::cardinal, 3, 0, 7, 5},
                        Case{FreeFormBasis::taylor, 3, 0, 8, 3}, Case{FreeFormBasis::bmatrix, 3, 2, 8, 4},
                        Case{FreeFormBasis::bmatrix, 2, 5, 8, 3}}) {
    const FreeFormCounts counts(c.basis, c.degree, c.step);
    EXPECT_TRUE(counts.fits(c.points)) << counts.text();
    EXPECT_EQ(counts.parameters(c.points), c.parameters) << counts.text();
    EXPECT_EQ(counts.points(c.parameters), c.points) << counts.text();
    EXPECT_EQ(counts.points(counts.least_parameters() - 1), 0);
    EXPECT_FALSE(counts.fits(c.degree)) << counts.text();
  }
}

TEST(FreeForm, TrimsAndSpecialPointsAreKept) {
  const std::string text =
      "vp 0.5\nvp 0.7\nvp 1.1\nvp 0.2 0.95\nv 0.3 1.5 0.1\n" + vertices(4) +
      "cstype bezier\ndeg 3\ncurv 0.2 0.9 -4 -3 -2 -1\nsp 1\nparm u 0 1\nend\n" + trimming_curve +
      "cstype rat bezier\nvp -0.185 0.322\nvp 0.214 0.818\nvp 1.652 0.207\nvp 1.652 -0.455\n"
      "curv2 -4 -3 -2 -1\nparm u 2 10\nsp 2 3\nend\n" +
      weighted_net +
      "cstype rat bspline\ndeg 2 2\nsurf -1 2.5 -2 2 -9 -8 -7 -6 -5 -4 -3 -2 -1\nparm u -1 -1 -1 2.5 2.5 2.5\n"
      "parm v -2 -2 -2 2 2 2\ntrim 0 2 1\nhole 0 1 1 1 2 -2\nscrv 4.2 9.7 2\nsp 4\nend\n"
      "surf -1 2.5 -2 2 -1 -2 -3 -4 -5 -6 -7 -8 -9\nparm u -1 -1 -1 2.5 2.5 2.5\nparm v -2 -2 -2 2 2 2\nend\n"
      "con 1 2.0 2.5 1 -1 4.2 3.0 2\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  ASSERT_EQ(shapes.surfaces.size(), 2u);
  const FreeFormSurface& surface = shapes.surfaces[0];
  EXPECT_EQ(surface.points, (Indices{5, 6, 7, 8, 9, 10, 11, 12, 13}));
  EXPECT_EQ(surface.special_points, (Indices{3}));
  ASSERT_EQ(surface.loops.size(), 3u);
  EXPECT_EQ(surface.loops[0].kind, FreeFormLoop::Kind::trim);
  EXPECT_EQ(surface.loops[1].kind, FreeFormLoop::Kind::hole);
  ASSERT_EQ(surface.loops[1].parts.size(), 2u);
  EXPECT_EQ(surface.loops[1].parts[1].curve, 0);
  EXPECT_EQ(surface.loops[1].parts[1].last, 2);
  EXPECT_EQ(surface.loops[2].kind, FreeFormLoop::Kind::scrv);
  EXPECT_EQ(surface.loops[2].parts[0].curve, 1);
  ASSERT_EQ(shapes.curves_2d.size(), 2u);
  EXPECT_EQ(shapes.curves_2d[0].points, (Indices{4, 5, 6, 7, 8, 9, 4}));
  EXPECT_EQ(shapes.curves_2d[1].special_points, (Indices{1, 2}));
  EXPECT_EQ(shapes.curves_2d[1].u.first, 2);
  EXPECT_EQ(shapes.curves_2d[1].u.last, 10);
  EXPECT_EQ(shapes.parameter_weights[4], 3);
  EXPECT_EQ(shapes.curves.at(0).special_points, (Indices{0}));
  ASSERT_EQ(shapes.connections.size(), 1u);
  EXPECT_EQ(shapes.connections[0].surfaces[1], 1);
  EXPECT_EQ(shapes.connections[0].parts[1].curve, 1);
  EXPECT_EQ(shapes.connections[0].parts[1].first, 4.2);
  EXPECT_TRUE(shapes.warnings.empty());
  expect_round_trip(text);
}

TEST(FreeForm, StateHoldsUntilItIsChanged) {
  const std::string text =
      vertices(4) +
      "o thing\ng left side\ncstype rat bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n"
      "curv 0 1 2 3\nparm u 0 1\nend\ng\ncstype bezier\ndeg 3 2\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  ASSERT_EQ(shapes.curves.size(), 3u);
  EXPECT_EQ(with_name(shapes, shapes.curves[1].group), "left side");
  EXPECT_EQ(with_name(shapes, shapes.curves[1].object), "thing");
  EXPECT_TRUE(shapes.curves[1].rational);
  EXPECT_EQ(shapes.curves[2].group, -1);
  EXPECT_FALSE(shapes.curves[2].rational);
  EXPECT_EQ(shapes.curves[2].u.degree, 3);
  EXPECT_EQ(shapes.curves[2].line, 18);
  expect_round_trip(text);
}

TEST(FreeForm, PointsMayComeLaterAndLinesMayBeContinued) {
  const FreeForm shapes = parse_free_form(
      "cstype bspline\r\ndeg 1\r\ncurv 0 \\\r\n 1 1 \\\r\n2 3\r\nparm \\\r\n u 0 0 \\\r\n .5 1 1\r\nend\r\n" +
          vertices(3),
      "a.obj");
  EXPECT_EQ(shapes.curves.at(0).points, (Indices{0, 1, 2}));
  EXPECT_EQ(shapes.curves[0].u.parameters, (Numbers{0, 0, 0.5, 1, 1}));
}

TEST(FreeForm, KnotsWithoutTheFirstAndTheLastAreCompleted) {
  const std::string state = "cstype bspline\ndeg 3 2\n";
  const FreeForm curve =
      parse_free_form(vertices(5) + state + "curv 0 2 1 2 3 4 5\nparm u 0 0 0 1 2 2 2\nend\n", "a.obj");
  EXPECT_EQ(curve.curves.at(0).u.parameters, (Numbers{0, 0, 0, 0, 1, 2, 2, 2, 2}));
  ASSERT_EQ(curve.warnings.size(), 1u);
  EXPECT_EQ(curve.warnings[0],
            "a.obj:9: parm u has 7 knots for 5 control points, without the first and the last; these are doubled");
  const FreeForm surface = parse_free_form(
      vertices(12) + state + "surf 0 1 0 1 1 2 3 4 5 6 7 8 9 10 11 12\nparm u 0 0 0 1 1 1\nparm v 0 0 1 1\nend\n",
      "a.obj");
  EXPECT_EQ(surface.surfaces.at(0).u.count, 4);
  EXPECT_EQ(surface.surfaces[0].v.parameters, (Numbers{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(surface.warnings.size(), 2u);
}

TEST(FreeForm, RangesAreCutToTheDomain) {
  // As Blender writes an open uniform curve: the knots fill 0 to 1, so the domain does not.
  const FreeForm shapes = parse_free_form(
      vertices(4) + "cstype bspline\ndeg 2\ncurv 0 1 -1 -2 -3 -4\nparm u 0 0.125 0.25 0.5 0.75 0.875 1\nend\n",
      "a.obj");
  EXPECT_EQ(shapes.curves.at(0).u.first, 0.25);
  EXPECT_EQ(shapes.curves[0].u.last, 0.75);
  ASSERT_EQ(shapes.warnings.size(), 1u);
  EXPECT_EQ(shapes.warnings[0],
            "a.obj:7: curv: the range 0 to 1 is cut to the domain, which is 0.25 to 0.75 by parm u");
}

TEST(FreeForm, WeightsThatAreUnusualAreToldOf) {
  const std::string net = "v 0 0 0 2\nv 1 0 0\nv 2 0 0 -1\nv 3 0 0 0\nv 4 0 0 1 0.5 0.25\nv 5 0 0 1 1 1 1\n";
  const std::string curve = "deg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n";
  const FreeForm plain = parse_free_form(net + "cstype bezier\n" + curve, "a.obj");
  ASSERT_EQ(plain.warnings.size(), 2u);
  EXPECT_EQ(plain.warnings[0].substr(0, 36), "a.obj:6: vertex of 7 numbers, whose ");
  EXPECT_EQ(plain.warnings[1],
            "a.obj:9: curv: weight 2 of control point 1 ignored; only elements under 'cstype rat ...' use weights");
  EXPECT_EQ(plain.weights, (Numbers{2, 1, -1, 0, 1, 1}));
  const FreeForm rational =
      parse_free_form(net + "cstype rat bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n", "a.obj");
  ASSERT_EQ(rational.warnings.size(), 2u);
  EXPECT_EQ(rational.warnings[1],
            "a.obj:9: curv: weight -1 of control point 3 is not positive; there may be poles, and no convex hull");
}

TEST(FreeForm, WarningsDoNotGrowWithTheFile) {
  std::string text = "v 0 0 0 2\nv 1 0 0\ncstype bezier\ndeg 1\n";
  for (int i = 0; i < 1000; ++i) text += "curv -1 3 1 2\nparm u 0 1\nend\nk" + format_number(i) + "\n";
  const FreeForm shapes = parse_free_form(text, "a.obj");
  EXPECT_EQ(shapes.curves.size(), 1000u);
  EXPECT_LE(shapes.warnings.size(), 50u);
}

TEST(FreeForm, MeshAndCurvesOfOneFileAreBothRead) {
  const std::string text = vertices(4) +
                           "vn 0 0 1\ng a\nf 1 2 3\nl 1 2 3\ncstype bezier\ndeg 1 1\ncurv 0 1 1 2\nparm u 0 1\nend\n"
                           "usemtl steel\nsurf 0 1 0 1 1//1 2//1 3//1 4//1\nparm u 0 1\nparm v 0 1\nend\nf 2 3 4\n"
                           "t crease 2/1/0 1 2 3\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n";
  const Mesh mesh = parse_obj(text, "a.obj");
  EXPECT_EQ(mesh.num_faces(), 2);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(
      mesh.warnings[0],
      "a.obj:11: the file also holds 1 curve and 2 surfaces (free-form statements), which are no part of the mesh");
  const FreeForm shapes = parse_free_form(text, "a.obj");
  EXPECT_EQ(shapes.num_faces, 2);
  EXPECT_EQ(shapes.curves.size(), 1u);
  EXPECT_EQ(shapes.surfaces.size(), 2u);
  EXPECT_EQ(shapes.surfaces[0].normals, (Indices{0, 0, 0, 0}));
  EXPECT_TRUE(shapes.surfaces[0].texture.empty());
  EXPECT_TRUE(shapes.warnings.empty());
  const ControlPolygon polygon = parse_polygon_obj(text, "a.obj");
  EXPECT_EQ(polygon.curves.size(), 1u);
  EXPECT_EQ(polygon.warnings.size(), 2u);
}

TEST(FreeForm, CurvesAreNoMeshAndNoPolygon) {
  const std::string text = trimming_curve + vertices(2) + "deg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n";
  for (const auto& read : {std::function<void()>([&] { parse_obj(text, "a.obj"); }),
                           std::function<void()>([&] { parse_polygon_obj(text, "a.obj"); })})
    expect_error<InvalidMesh>(read, {"a.obj:9: the file holds 1 curve and 1 curve in parameter space", "free-form"});
  expect_error<InvalidMesh>([&] { parse_free_form(vertices(3) + "f 1 2 3\n", "a.obj"); },
                            {"a.obj: no curves and no surfaces, but a mesh of 1 face", "'curv' and 'surf'"});
  expect_error<InvalidMesh>([&] { parse_free_form("# nothing\n", "a.obj"); }, {"a.obj: no curves and no surfaces;"});
}

TEST(FreeForm, MillionKnotsAreReadInLinearTime) {
  const auto seconds = [](int count) {
    std::string text = "v 0 0 0\ncstype bspline\ndeg 3\ncurv 3 " + format_number(count);
    for (int i = 0; i < count; ++i) text += " 1";
    text += "\nparm u";
    for (int i = 0; i < count + 4; ++i) text += (i % 10 == 9 ? " \\\n " : " ") + format_number(i);
    text += "\nend\n";
    const auto start = std::chrono::steady_clock::now();
    const FreeForm shapes = parse_free_form(text, "a.obj");
    EXPECT_EQ(shapes.curves.at(0).u.parameters.size(), static_cast<std::size_t>(count) + 4);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  seconds(100000);
  EXPECT_LT(seconds(1000000), 10);  // 0.1 s; a quadratic reader takes hours
}

// Numbers of any exponent, none of them round.
double any_number(std::mt19937& random) {
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-1070, 1000);
  return std::ldexp(mantissa(random), exponent(random));
}

Numbers rising(std::mt19937& random, std::int64_t count, bool knots, int degree) {
  Numbers values;
  double value = std::uniform_real_distribution<double>(-5, 5)(random);
  while (std::int64_t(values.size()) < count) {
    value += std::uniform_real_distribution<double>(0.01, 1)(random);
    const int times = knots ? std::uniform_int_distribution<int>(1, degree)(random) : 1;
    for (int i = 0; i < times && std::int64_t(values.size()) < count; ++i) values.push_back(value);
  }
  return values;
}

TEST(FreeForm, RandomShapesReadBackToTheSameBits) {
  std::mt19937 random(18);
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  for (int round = 0; round < 100; ++round) {
    FreeForm shapes;
    const int n = 1 + below(60);
    shapes.vertices.resize(n, 3);
    shapes.parameters.resize(n, 2);
    shapes.texture.resize(n, 3);
    shapes.normals.resize(n, 3);
    for (Points* const points : {&shapes.vertices, &shapes.parameters, &shapes.texture, &shapes.normals})
      for (Eigen::Index i = 0; i < points->size(); ++i) points->data()[i] = any_number(random);
    for (int i = 0; i < n; ++i) {
      shapes.weights.push_back(below(2) ? 1 : any_number(random));
      shapes.parameter_weights.push_back(below(2) ? 1 : any_number(random));
    }
    shapes.names = {"body", "two words", "a\\"};
    for (const int degree : {1, 2, 3}) {
      shapes.matrices.emplace_back();
      for (int i = 0; i < (degree + 1) * (degree + 1); ++i) shapes.matrices.back().values.push_back(any_number(random));
    }
    const auto element = [&](FreeFormElement& e) {
      constexpr FreeFormBasis bases[] = {FreeFormBasis::bmatrix, FreeFormBasis::bezier, FreeFormBasis::bspline,
                                         FreeFormBasis::cardinal, FreeFormBasis::taylor};
      e.basis = bases[below(5)];
      e.rational = below(2);
      e.group = below(4) - 1;
      e.object = below(4) - 1;
      for (int i = below(3); i > 0; --i) e.special_points.push_back(below(n));
    };
    const auto direction = [&](FreeFormBasis basis, bool whole) {
      FreeFormDirection d;
      d.degree = basis == FreeFormBasis::cardinal ? 3 : basis == FreeFormBasis::bmatrix ? 1 + below(3) : 1 + below(9);
      if (basis == FreeFormBasis::bmatrix) {
        d.matrix = d.degree - 1;
        d.step = 1 + below(3);
      }
      const FreeFormCounts counts(basis, d.degree, d.step);
      const std::int64_t parameters = counts.least_parameters() + below(4);
      d.count = static_cast<Index>(counts.points(parameters));
      do {  // a domain of its own end knots only may be empty
        d.parameters = rising(random, parameters, basis == FreeFormBasis::bspline, d.degree);
        std::tie(d.first, d.last) = free_form_domain(basis, d);
      } while (!(d.first < d.last));
      if (!whole) d.last = d.first + (d.last - d.first) / 3;
      return d;
    };
    const auto points = [&](std::int64_t count) {
      Indices indices;
      while (std::int64_t(indices.size()) < count) indices.push_back(below(n));
      return indices;
    };
    for (int i = 1 + below(3); i > 0; --i) {
      for (std::vector<FreeFormCurve>* const curves : {&shapes.curves, &shapes.curves_2d}) {
        FreeFormCurve curve;
        element(curve);
        curve.u = direction(curve.basis, curves == &shapes.curves_2d);
        curve.points = points(curve.u.count);
        curves->push_back(curve);
      }
      FreeFormSurface surface;
      element(surface);
      surface.u = direction(surface.basis, below(2));
      surface.v = direction(surface.basis, below(2));
      surface.points = points(std::int64_t{surface.u.count} * surface.v.count);
      if (below(2)) surface.texture = points(std::int64_t(surface.points.size()));
      if (below(2)) surface.normals = points(std::int64_t(surface.points.size()));
      for (const auto kind : {FreeFormLoop::Kind::trim, FreeFormLoop::Kind::hole, FreeFormLoop::Kind::scrv})
        surface.loops.push_back({.kind = kind,
                                 .parts = {{.curve = 0, .first = any_number(random), .last = any_number(random)},
                                           {.curve = 0, .first = any_number(random), .last = any_number(random)}}});
      shapes.surfaces.push_back(surface);
    }
    shapes.connections.push_back({.surfaces = {0, 0},
                                  .parts = {{.curve = 0, .first = 0, .last = any_number(random)},
                                            {.curve = 0, .first = any_number(random), .last = 1}}});
    const std::string text = format_free_form(shapes);
    expect_same(shapes, parse_free_form(text, "written.obj"));
    for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
      end = text.find('\n', start);
      ASSERT_LE(std::min(end, text.size()) - start, 101u);
    }
    if (HasFailure()) FAIL() << text;
  }
}

TEST(FreeForm, NamesThatEndInABackslashDoNotContinueALine) {
  const FreeForm shapes =
      parse_free_form("v 0 0 0\nv 1 2 3\ng a\\ #\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n", "a.obj");
  EXPECT_EQ(shapes.names, std::vector<std::string>{"a\\"});
  expect_same(shapes, parse_free_form(format_free_form(shapes), "written.obj"));
}

TEST(FreeForm, FilesAreWrittenWhole) {
  const TemporaryDirectory directory;
  const FreeForm shapes = parse_free_form(trimming_curve, "a.obj");
  write_free_form(directory / "a.obj", shapes);
  expect_same(shapes, read_free_form(directory / "a.obj"));
  EXPECT_EQ(directory.num_files(), 1);
  expect_error<IoError>([&] { read_free_form(directory / "none.obj"); }, {"none.obj", "No such file"});
}

}  // namespace
}  // namespace sublimit::testing
