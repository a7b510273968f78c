// SPDX-License-Identifier: Apache-2.0
#include "meshes/free_form_shapes.h"

#include <array>
#include <cmath>

#include "sublimit/patches/detail/finer_knots.h"

namespace sublimit::testing {
namespace {

const double half = std::sqrt(0.5);
/// x, y, weight of a full circle.
const double circle[9][3] = {{1, 0, 1},      {1, 1, half}, {0, 1, 1},     {-1, 1, half}, {-1, 0, 1},
                             {-1, -1, half}, {0, -1, 1},   {1, -1, half}, {1, 0, 1}};

Knots<double> circle_knots() { return Knots<double>::open(2, 9, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}); }

/// A profile of points (x, z, weight), turned about z.
RationalShape turned(const std::vector<std::array<double, 3>>& profile, Knots<double> knots) {
  Points columns(std::ssize(profile) * 9, 4);
  for (size_t j = 0; j < profile.size(); ++j)
    for (size_t i = 0; i < 9; ++i) {
      const auto& [x, z, w] = profile[j];
      const double weight = w * circle[i][2];
      columns.row(Eigen::Index(9 * j + i)) << weight * x * circle[i][0], weight * x * circle[i][1], weight * z, weight;
    }
  return {SplineSurface(circle_knots(), std::move(knots)), std::move(columns)};
}

// F. Crow, The origins of the teapot, IEEE CG&A 1987; the quarter and half shapes as GLUT 3.7 has them.
constexpr int teapot_patches[10][16] = {
    {102, 103, 104, 105, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},                // rim
    {12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27},              // body
    {24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40},              //
    {96, 96, 96, 96, 97, 98, 99, 100, 101, 101, 101, 101, 0, 1, 2, 3},             // lid
    {0, 1, 2, 3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117},      //
    {118, 118, 118, 118, 124, 122, 119, 121, 123, 126, 125, 120, 40, 39, 38, 37},  // bottom
    {41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56},              // handle
    {53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 28, 65, 66, 67},              //
    {68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83},              // spout
    {80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95}};
constexpr double teapot_points[127][3] = {{0.2, 0, 2.7},
                                          {0.2, -0.112, 2.7},
                                          {0.112, -0.2, 2.7},
                                          {0, -0.2, 2.7},
                                          {1.3375, 0, 2.53125},
                                          {1.3375, -0.749, 2.53125},
                                          {0.749, -1.3375, 2.53125},
                                          {0, -1.3375, 2.53125},
                                          {1.4375, 0, 2.53125},
                                          {1.4375, -0.805, 2.53125},
                                          {0.805, -1.4375, 2.53125},
                                          {0, -1.4375, 2.53125},
                                          {1.5, 0, 2.4},
                                          {1.5, -0.84, 2.4},
                                          {0.84, -1.5, 2.4},
                                          {0, -1.5, 2.4},
                                          {1.75, 0, 1.875},
                                          {1.75, -0.98, 1.875},
                                          {0.98, -1.75, 1.875},
                                          {0, -1.75, 1.875},
                                          {2, 0, 1.35},
                                          {2, -1.12, 1.35},
                                          {1.12, -2, 1.35},
                                          {0, -2, 1.35},
                                          {2, 0, 0.9},
                                          {2, -1.12, 0.9},
                                          {1.12, -2, 0.9},
                                          {0, -2, 0.9},
                                          {-2, 0, 0.9},
                                          {2, 0, 0.45},
                                          {2, -1.12, 0.45},
                                          {1.12, -2, 0.45},
                                          {0, -2, 0.45},
                                          {1.5, 0, 0.225},
                                          {1.5, -0.84, 0.225},
                                          {0.84, -1.5, 0.225},
                                          {0, -1.5, 0.225},
                                          {1.5, 0, 0.15},
                                          {1.5, -0.84, 0.15},
                                          {0.84, -1.5, 0.15},
                                          {0, -1.5, 0.15},
                                          {-1.6, 0, 2.025},
                                          {-1.6, -0.3, 2.025},
                                          {-1.5, -0.3, 2.25},
                                          {-1.5, 0, 2.25},
                                          {-2.3, 0, 2.025},
                                          {-2.3, -0.3, 2.025},
                                          {-2.5, -0.3, 2.25},
                                          {-2.5, 0, 2.25},
                                          {-2.7, 0, 2.025},
                                          {-2.7, -0.3, 2.025},
                                          {-3, -0.3, 2.25},
                                          {-3, 0, 2.25},
                                          {-2.7, 0, 1.8},
                                          {-2.7, -0.3, 1.8},
                                          {-3, -0.3, 1.8},
                                          {-3, 0, 1.8},
                                          {-2.7, 0, 1.575},
                                          {-2.7, -0.3, 1.575},
                                          {-3, -0.3, 1.35},
                                          {-3, 0, 1.35},
                                          {-2.5, 0, 1.125},
                                          {-2.5, -0.3, 1.125},
                                          {-2.65, -0.3, 0.9375},
                                          {-2.65, 0, 0.9375},
                                          {-2, -0.3, 0.9},
                                          {-1.9, -0.3, 0.6},
                                          {-1.9, 0, 0.6},
                                          {1.7, 0, 1.425},
                                          {1.7, -0.66, 1.425},
                                          {1.7, -0.66, 0.6},
                                          {1.7, 0, 0.6},
                                          {2.6, 0, 1.425},
                                          {2.6, -0.66, 1.425},
                                          {3.1, -0.66, 0.825},
                                          {3.1, 0, 0.825},
                                          {2.3, 0, 2.1},
                                          {2.3, -0.25, 2.1},
                                          {2.4, -0.25, 2.025},
                                          {2.4, 0, 2.025},
                                          {2.7, 0, 2.4},
                                          {2.7, -0.25, 2.4},
                                          {3.3, -0.25, 2.4},
                                          {3.3, 0, 2.4},
                                          {2.8, 0, 2.475},
                                          {2.8, -0.25, 2.475},
                                          {3.525, -0.25, 2.49375},
                                          {3.525, 0, 2.49375},
                                          {2.9, 0, 2.475},
                                          {2.9, -0.15, 2.475},
                                          {3.45, -0.15, 2.5125},
                                          {3.45, 0, 2.5125},
                                          {2.8, 0, 2.4},
                                          {2.8, -0.15, 2.4},
                                          {3.2, -0.15, 2.4},
                                          {3.2, 0, 2.4},
                                          {0, 0, 3.15},
                                          {0.8, 0, 3.15},
                                          {0.8, -0.45, 3.15},
                                          {0.45, -0.8, 3.15},
                                          {0, -0.8, 3.15},
                                          {0, 0, 2.85},
                                          {1.4, 0, 2.4},
                                          {1.4, -0.784, 2.4},
                                          {0.784, -1.4, 2.4},
                                          {0, -1.4, 2.4},
                                          {0.4, 0, 2.55},
                                          {0.4, -0.224, 2.55},
                                          {0.224, -0.4, 2.55},
                                          {0, -0.4, 2.55},
                                          {1.3, 0, 2.55},
                                          {1.3, -0.728, 2.55},
                                          {0.728, -1.3, 2.55},
                                          {0, -1.3, 2.55},
                                          {1.3, 0, 2.4},
                                          {1.3, -0.728, 2.4},
                                          {0.728, -1.3, 2.4},
                                          {0, -1.3, 2.4},
                                          {0, 0, 0},
                                          {1.425, -0.798, 0},
                                          {1.5, 0, 0.075},
                                          {1.425, 0, 0},
                                          {0.798, -1.425, 0},
                                          {0, -1.5, 0.075},
                                          {0, -1.425, 0},
                                          {1.5, -0.84, 0.075},
                                          {0.84, -1.5, 0.075}};

}  // namespace

RationalShape unit_sphere() {
  return turned({{0, -1, 1}, {1, -1, half}, {1, 0, 1}, {1, 1, half}, {0, 1, 1}},
                Knots<double>::open(2, 5, {0, 0, 0, 1, 1, 2, 2, 2}));
}

RationalShape torus() {
  std::vector<std::array<double, 3>> profile;
  for (const auto& [x, z, w] : circle) profile.push_back({3 + x, z, w});
  return turned(profile, circle_knots());
}

RationalShape pipe() {
  Points columns(18, 4);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 9; ++i) {
      const auto& [y, z, w] = circle[i];
      columns.row(9 * j + i) << w * 4 * j, w * y / 2, w * z / 2, w;
    }
  return {SplineSurface(circle_knots(), Knots<double>::open(1, 2, {0, 0, 1, 1})), std::move(columns)};
}

RationalShape elevated(const RationalShape& shape) {
  const SplineSurface& s = shape.surface;
  const SplineSurface in_u(elevated_knots(s.u()), s.v()), both(in_u.u(), elevated_knots(s.v()));
  return {both, refinement_matrix(in_u, both) * (refinement_matrix(s, in_u) * shape.columns)};
}

FreeForm free_form_of(const std::vector<RationalShape>& shapes) {
  FreeForm file;
  Eigen::Index count = 0;
  for (const RationalShape& shape : shapes) count += shape.columns.rows();
  file.vertices.resize(count, 3);
  Index next = 0;
  for (const RationalShape& shape : shapes) {
    FreeFormSurface s;
    s.basis = FreeFormBasis::bspline;
    s.rational = true;
    const auto direction = [](const Knots<double>& knots) {
      FreeFormDirection d;
      d.degree = knots.degree();
      d.count = knots.num_points();
      d.parameters.assign(knots.all().begin(), knots.all().end());
      d.first = knots.begin(), d.last = knots.end();
      return d;
    };
    s.u = direction(shape.surface.u());
    s.v = direction(shape.surface.v());
    for (const auto& column : shape.columns.rowwise()) {
      file.vertices.row(next) = column.head(3) / column[3];
      file.weights.push_back(column[3]);
      s.points.push_back(next++);
    }
    file.surfaces.push_back(std::move(s));
  }
  return file;
}

FreeForm teapot() {
  FreeForm file;
  file.vertices.resize(32 * 16, 3);
  Index next = 0;
  for (int p = 0; p < 10; ++p)
    for (int copy = 0; copy < (p < 6 ? 4 : 2); ++copy) {
      // A mirrored patch runs the other way along its rows, so that all are wound alike.
      const double y = copy % 2 ? -1 : 1, x = copy / 2 ? -1 : 1;
      const bool turned_round = x * y < 0;
      FreeFormSurface s;
      s.basis = FreeFormBasis::bezier;
      s.u = s.v = {.degree = 3, .count = 4, .parameters = {0, 1}, .first = 0, .last = 1};
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          const double* const point = teapot_points[teapot_patches[p][4 * j + (turned_round ? 3 - i : i)]];
          file.vertices.row(next) << x * point[0], y * point[1], point[2];
          s.points.push_back(next++);
        }
      file.surfaces.push_back(std::move(s));
    }
  file.weights.assign(size_t(next), 1);
  return file;
}

}  // namespace sublimit::testing
