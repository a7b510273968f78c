// SPDX-License-Identifier: Apache-2.0
// Surfaces as B-splines are the surfaces that they were: other bases, parts of domains, both.
#include "sublimit/report/free_form/spline_patches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sublimit/patches/detail/free_form_patches.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

std::string grid_of(int m, int n) {
  std::string text;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i)
      text +=
          "v " + std::to_string(i) + " " + std::to_string(j) + " " + std::to_string((7 * i + 3 * i * j + j) % 5) + "\n";
  return text;
}
std::string all_points(int count) {
  std::string text;
  for (int i = 1; i <= count; ++i) text += " " + std::to_string(i);
  return text;
}

/// Points at the parameters of the file, by its own patches and by splines.
void expect_same(const std::string& text, bool converted) {
  const FreeForm shapes = parse_free_form(text, "surface.obj");
  const FreeFormPatches own = free_form_patches(shapes, "surface.obj");
  const SplinePatches spline = spline_patches(shapes, "surface.obj");
  ASSERT_EQ(spline.patches.size(), shapes.surfaces.size());
  EXPECT_EQ(spline.is_converted[0], converted);
  const FreeFormSurface& s = shapes.surfaces[0];
  EXPECT_EQ(spline.surfaces[0]->u().begin(), s.u.first);
  EXPECT_EQ(spline.surfaces[0]->v().end(), s.v.last);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      const Patch::Parameters at{.u = s.u.first + (s.u.last - s.u.first) * i / 10,
                                 .v = s.v.first + (s.v.last - s.v.first) * j / 10};
      const Place a = own.patches.members()[0].patch->place(at), b = spline.surfaces[0]->place(at);
      const Points x =
          own.patches.members()[0]
              .patch->evaluate(own.patches.columns_of(0, own.columns), {&a, 1}, 0, own.patches.coordinates())
              .position;
      const Points y = spline.surfaces[0]->evaluate(spline.patches[0].columns, {&b, 1}, 0, spline.coordinates).position;
      EXPECT_LE((x - y).norm(), rounding(64, 16)) << at.u << ", " << at.v;
    }
}

TEST(SplinePatches, AreTheSurfacesOfTheFile) {
  expect_same(
      grid_of(4, 4) + "cstype bezier\ndeg 3 3\nsurf 0 1 0 1" + all_points(16) + "\nparm u 0 1\nparm v 0 1\nend\n",
      false);
  expect_same(
      grid_of(5, 5) + "cstype cardinal\ndeg 3 3\nsurf 0 2 0 2" + all_points(25) + "\nparm u 0 1 2\nparm v 0 1 2\nend\n",
      true);
  expect_same(
      grid_of(3, 6) + "cstype taylor\ndeg 2 2\nsurf 0 1 0 2" + all_points(18) + "\nparm u 0 1\nparm v 0 1 2\nend\n",
      true);
}

TEST(SplinePatches, OfAPartEndWhereItEnds) {
  expect_same(grid_of(6, 5) + "cstype bspline\ndeg 3 2\nsurf 3.25 5.5 2 4.75" + all_points(30) +
                  "\nparm u 0 1 2 3 4 5 6 7 8 9\nparm v 0 1 2 3 4 5 6 7\nend\n",
              true);
  expect_same(grid_of(5, 5) + "cstype cardinal\ndeg 3 3\nsurf 0.5 2 0 1.25" + all_points(25) +
                  "\nparm u 0 1 2\nparm v 0 1 2\nend\n",
              true);
}

}  // namespace
}  // namespace sublimit::testing
