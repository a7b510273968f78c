// SPDX-License-Identifier: Apache-2.0
// The program's samples of random rational surfaces, against SciPy.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "meshes/free_form_shapes.h"
#include "stencils/cli/python_with_scipy.h"
#include "stencils/cli_program.h"
#include "sublimit/base/detail/format_number.h"

namespace sublimit::testing {
namespace {

Knots<double> random_open_knots(std::mt19937& random, int degree) {
  const bool clamped = random() % 2 == 0;
  std::vector<double> knots;
  double t = 0;
  const auto step = [&] { return t += 0.25 + std::uniform_real_distribution<>(0, 1)(random); };
  for (int i = 0; i <= degree; ++i) knots.push_back(clamped || i == 0 ? t : step());
  for (auto inner = random() % 5; inner > 0; --inner) {
    step();
    knots.insert(knots.end(), 1 + random() % unsigned(degree), t);
  }
  step();
  for (int i = 0; i <= degree; ++i) knots.push_back(clamped || i == 0 ? t : step());
  return Knots<double>::open(degree, static_cast<Index>(knots.size()) - degree - 1, knots);
}

TEST(CliSciPy, SamplesOfRandomSurfacesAreTheSame) {
  const std::string python = python_with_scipy();
  SUBLIMIT_NEEDS_SCIPY;
  std::mt19937 random(12);
  std::vector<RationalShape> shapes;
  std::string places = "patch,u,v\n";
  for (int s = 0; s < 200; ++s) {
    const SplineSurface surface(random_open_knots(random, 1 + s % 5), random_open_knots(random, 1 + int(random() % 5)));
    Points columns(surface.num_points(), 4);
    for (Eigen::Index i = 0; i < columns.rows(); ++i) {
      const double w = std::uniform_real_distribution<>(0.3, 3)(random);
      for (int c = 0; c < 3; ++c) columns(i, c) = w * std::uniform_real_distribution<>(-1, 1)(random);
      columns(i, 3) = w;
    }
    for (int i = 0; i < 5; ++i) {
      const double u = std::uniform_real_distribution<>(surface.u().begin(), surface.u().end())(random);
      const double v = std::uniform_real_distribution<>(surface.v().begin(), surface.v().end())(random);
      places += std::to_string(s) + "," + format_number(u) + "," + format_number(v) + "\n";
    }
    shapes.push_back({surface, columns});
  }
  const TemporaryDirectory directory;
  const std::string obj = (directory / "shapes.obj").string(), out = (directory / "out.csv").string();
  write_free_form(obj, free_form_of(shapes));
  const std::string at = directory.write("at.csv", places).string();
  expect_done(sublimit({"sample", obj, "--at", at, "--derivatives", "2", "-o", out}));
  EXPECT_EQ(
      std::system((python + " " + SUBLIMIT_SOURCE + "/tests/stencils/cli/scipy_splines.py " + obj + " " + out).c_str()),
      0);
}

}  // namespace
}  // namespace sublimit::testing
