// SPDX-License-Identifier: Apache-2.0
// Shapes from their published data through all commands, one after the other: info, refine, sample, bake, apply,
// analyze. Points are those of the closed forms throughout.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_program.h"
#include "stencils/csv_fields.h"
#include "stencils/markup.h"
#include "sublimit/base/detail/format_number.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// A shape, and how far a place of it is from its closed form.
struct ChainShape {
  std::string name;
  FreeForm shapes;
  std::function<double(int face, double u, double v, const Eigen::Vector3d& x)> distance;
  std::vector<std::string> info;  ///< that `info` should say
};

/// The bicubic patch of a face, by Bernstein's polynomials.
Eigen::Vector3d bernstein_point(const FreeForm& shapes, int face, double u, double v) {
  const auto weights = [](double t) {
    const double s = 1 - t;
    return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto in_u = weights(u), in_v = weights(v);
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i)
      x += in_u[i] * in_v[j] * shapes.vertices.row(shapes.surfaces[size_t(face)].points[i + 4 * j]).transpose().eval();
  return x;
}

std::vector<ChainShape> chain_shapes() {
  using V = const Eigen::Vector3d&;
  return {{"sphere",
           free_form_of({elevated(unit_sphere())}),
           [](int, double, double, V x) { return x.norm() - 1; },
           {"rat bspline of degree 3 x 3", "the side v = 0", "the side v = 2"}},
          {"torus",
           free_form_of({torus()}),
           [](int, double, double, V x) { return std::hypot(std::hypot(x[0], x[1]) - 3, x[2]) - 1; },
           {"rat bspline of degree 2 x 2, 9 x 9 control points"}},
          {"pipe",
           free_form_of({pipe()}),
           [](int, double, double, V x) { return std::hypot(x[1], x[2]) - 0.5; },
           {"rat bspline of degree 2 x 1, 9 x 2 control points"}},
          {"teapot",
           teapot(),
           [shapes = teapot()](int face, double u, double v, V x) {
             return (x - bernstein_point(shapes, face, u, v)).norm();
           },
           {"32 surfaces", "bezier of degree 3 x 3, 4 x 4 control points"}}};
}

TEST(CliFreeFormChain, FromInfoToReport) {
  for (const ChainShape& shape : chain_shapes()) {
    SCOPED_TRACE(shape.name);
    const TemporaryDirectory directory;
    const auto path = [&](const std::string& name) { return (directory / name).string(); };
    const std::string obj = path(shape.name + ".obj"), fine = path("fine.obj"), table = path("t.safetensors");
    write_free_form(obj, shape.shapes);
    const double size = shape.shapes.vertices.cwiseAbs().maxCoeff();

    const std::string info = expect_done(sublimit({"info", obj})).out;
    for (const std::string& part : shape.info) expect_parts(info, {part});

    // Samples, and tables applied, are on the closed form, with unit normals.
    const auto expect_shape = [&](const std::string& file, bool by_table) {
      const std::vector<CsvRow> rows = csv_rows(file);
      ASSERT_GT(rows.size(), 81u);
      ASSERT_EQ(rows[0][4], "x");
      size_t without_normal = 0;
      for (size_t i = 1; i < rows.size(); ++i) {
        const CsvRow& row = rows[i];
        const Eigen::Vector3d x(csv_number(row[4]), csv_number(row[5]), csv_number(row[6]));
        const int face = int(csv_number(row[0]));
        EXPECT_NEAR(shape.distance(face, csv_number(row[1]), csv_number(row[2]), x), 0, rounding(16, size)) << i;
        if (row.back().empty()) {
          EXPECT_EQ(row[3], "undefined-normal");
          ++without_normal;
          continue;
        }
        const size_t n = row.size() - 3;
        EXPECT_NEAR(std::hypot(csv_number(row[n]), csv_number(row[n + 1]), csv_number(row[n + 2])), 1, rounding(4));
      }
      // Normals of sides that are one point are limits, which a table does not know.
      if (!by_table) {
        EXPECT_EQ(without_normal, 0u);
      }
    };
    expect_done(sublimit({"sample", obj, "--grid", "9", "--derivatives", "1", "-o", path("s.csv")}));
    expect_shape(path("s.csv"), false);
    expect_done(sublimit({"bake", obj, "--grid", "9", "--derivatives", "1", "--precision", "double", "-o", table}));
    expect_done(sublimit({"verify", table}));
    expect_done(sublimit({"apply", table, obj, "-o", path("a.csv")}));
    expect_shape(path("a.csv"), true);

    // The finer net is the same surface; its points tend to it.
    expect_done(sublimit({"refine", obj, "-l", "1", "-o", fine}));
    EXPECT_EQ(read_free_form(fine).surfaces.size(), shape.shapes.surfaces.size());
    std::string places = "patch,u,v\n";
    for (size_t p = 0; p < shape.shapes.surfaces.size(); ++p)
      for (int i = 0; i <= 4; ++i) {
        const FreeFormSurface& s = shape.shapes.surfaces[p];
        places += std::to_string(p) + "," + format_number(s.u.first + (s.u.last - s.u.first) * i / 4.0) + "," +
                  format_number(s.v.first + (s.v.last - s.v.first) * 0.3) + "\n";
      }
    const std::string at = directory.write("at.csv", places).string();
    expect_done(sublimit({"sample", obj, "--at", at, "-o", path("coarse.csv")}));
    expect_done(sublimit({"sample", fine, "--at", at, "-o", path("fine.csv")}));
    const std::vector<CsvRow> coarse = csv_rows(path("coarse.csv")), finer = csv_rows(path("fine.csv"));
    ASSERT_EQ(finer.size(), coarse.size());
    for (size_t i = 1; i < coarse.size(); ++i)
      for (size_t k = 4; k < 7; ++k)
        EXPECT_NEAR(csv_number(finer[i][k]), csv_number(coarse[i][k]), rounding(32, size)) << i;

    const Outcome said =
        sublimit({"analyze", obj, "-o", path("page.html"), "--picture", path("p.svg"), "--json", path("r.json")});
    EXPECT_EQ(said.status, 0) << said.err;
    EXPECT_EQ(read_markup(read_file(path("page.html"))).fault, "");
    EXPECT_EQ(read_markup(read_file(path("p.svg"))).fault, "");
    const auto report = nlohmann::ordered_json::parse(read_file(path("r.json")))["free_form"];
    EXPECT_EQ(report["patches"].size(), shape.shapes.surfaces.size());
    expect_done(sublimit({"verify", path("r.json")}));
  }
}

/// Warnings of a report: what they say, and of how many.
std::string told_of(const FreeForm& shapes, std::vector<int>& boundary) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "pot.obj").string(), json = (directory / "r.json").string();
  write_free_form(obj, shapes);
  EXPECT_EQ(sublimit({"analyze", obj, "--json", json, "--quiet"}).status, 0);
  const auto report = nlohmann::ordered_json::parse(read_file(json))["free_form"];
  boundary = {report["seams"]["kinds"]["boundary"].get<int>(), report["seams"]["boundary_loops"].get<int>()};
  return report["warnings"].dump();
}

TEST(CliFreeFormChain, TheTeapotIsReportedAsItIs) {
  std::vector<int> whole, open;
  const std::string says = told_of(teapot(), whole);
  // The lid's knob has a row of one point inside of each of its four patches; its tip and the bottom's centre are
  // poles.
  expect_parts(says, {R"("says":"an inner row of control points is one point")", R"("patches":[12,13,14,15])",
                      "a side is one point, a pole with a limit of normals", "sides without a partner"});
  // Without its bottom, as it was published first: the four sides around it are one loop more.
  FreeForm pot = teapot();
  pot.surfaces.erase(pot.surfaces.begin() + 20, pot.surfaces.begin() + 24);
  told_of(pot, open);
  EXPECT_EQ(open[0], whole[0] + 4);
  EXPECT_EQ(open[1], whole[1] + 1);
}

}  // namespace
}  // namespace sublimit::testing
