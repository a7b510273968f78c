// SPDX-License-Identifier: Apache-2.0
// Free-form surfaces of an OBJ through the program: samples and tables are what the closed forms say.
#include <gtest/gtest.h>

#include <cmath>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_program.h"
#include "stencils/csv_fields.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/formats/npy.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

Eigen::Vector3d vector_at(const CsvRow& row, size_t column) {
  return {csv_number(row.at(column)), csv_number(row.at(column + 1)), csv_number(row.at(column + 2))};
}

class FreeFormFile {
 public:
  explicit FreeFormFile(const FreeForm& shapes) { write_free_form(obj, shapes); }
  std::string path(std::string_view name) const { return (directory / name).string(); }

  TemporaryDirectory directory;
  const std::string obj = (directory / "shape.obj").string(), table = (directory / "table.safetensors").string();
};

/// Bicubic: of the biquadratic one a degree more in both directions.
FreeForm bicubic_sphere() { return free_form_of({elevated(unit_sphere())}); }

TEST(CliFreeForm, SamplesABicubicSphere) {
  // Products of first and second derivatives, which near the poles are far from 1.
  constexpr double of_curvature = 1e-11;
  const FreeFormFile on(bicubic_sphere());
  const std::string out = on.path("out.csv");
  expect_done(sublimit({"sample", on.obj, "--random", "500", "--derivatives", "2", "--curvature", "-o", out}));
  const std::vector<CsvRow> rows = csv_rows(out);
  ASSERT_EQ(rows.size(), 501u);
  for (size_t i = 1; i < rows.size(); ++i) {
    const CsvRow& row = rows[i];
    EXPECT_EQ(row[3], "regular");
    const Eigen::Vector3d x = vector_at(row, 4), n = vector_at(row, row.size() - 7);
    EXPECT_NEAR(x.norm(), 1, rounding(8));
    EXPECT_LE((n - x).norm(), rounding(200));
    EXPECT_NEAR(csv_number(row[row.size() - 2]), 1, of_curvature) << "Gauss curvature";
    EXPECT_NEAR(csv_number(row[row.size() - 1]), -1, of_curvature) << "mean curvature";
  }
}

TEST(CliFreeForm, TablesHaveTheRowsOfSamples) {
  for (const FreeForm& shapes : {bicubic_sphere(), free_form_of({torus(), elevated(pipe())}), teapot()})
    for (const char* derivatives : {"0", "1", "2"})
      for (const bool at : {false, true}) {
        const FreeFormFile on(shapes);
        const std::string sampled = on.path("sampled.csv"), applied = on.path("applied.csv");
        std::vector<std::string> places{"--grid", "4"};
        if (at) {
          std::string text = "face,u,v\n";
          for (int i = 0; i < 30; ++i)
            text +=
                std::to_string(i % 4) + "," + format_number((i * 7 % 31) / 31.0) + "," + format_number(i / 29.0) + "\n";
          places = {"--at", on.directory.write("in.csv", text).string()};
        }
        std::vector<std::string> sample{"sample", on.obj, "--derivatives", derivatives, "-o", sampled};
        std::vector<std::string> bake{"bake",   on.obj, "--derivatives", derivatives, "--precision",
                                      "double", "-o",   on.table};
        sample.insert(sample.end(), places.begin(), places.end());
        bake.insert(bake.end(), places.begin(), places.end());
        expect_done(sublimit(sample));
        expect_done(sublimit(bake));
        expect_done(sublimit({"apply", on.table, on.obj, "-o", applied}));
        expect_done(sublimit({"verify", on.table}));
        const std::vector<CsvRow> expected = csv_rows(sampled), made = csv_rows(applied);
        ASSERT_EQ(made.size(), expected.size());
        const bool has_address = made[0][0] == "face";
        ASSERT_TRUE(has_address);
        const size_t numbers = 3 * size_t(derivatives[0] == '0' ? 1 : derivatives[0] == '1' ? 3 : 6);
        for (size_t i = 1; i < made.size(); ++i) {
          for (size_t k = 0; k < 3; ++k) EXPECT_EQ(made[i][k], expected[i][k]);
          // A sphere's pole has a normal, as the limit of those around; a table has derivatives alone.
          const bool collapsed = made[i][3] == "undefined-normal" && derivatives[0] != '0';
          // `sample` takes first derivatives for its normals, and says where these have sides.
          if (numbers > 3 && !collapsed && expected[i][3] != "undefined-normal") {
            EXPECT_EQ(made[i][3], expected[i][3]) << i;
          }
          for (size_t k = 4; k < 4 + numbers; ++k) {
            ASSERT_EQ(made[i][k].empty(), expected[i][k].empty()) << i;
            if (made[i][k].empty()) continue;
            EXPECT_NEAR(csv_number(made[i][k]), csv_number(expected[i][k]), reference) << i << " " << k;
          }
          if (numbers == 3 || collapsed || expected[i][3] == "undefined-normal") continue;
          constexpr double printed_normal = 1e-11;  // crossed derivatives, from a table and from the surface
          EXPECT_LE((vector_at(made[i], 4 + numbers) - vector_at(expected[i], 4 + numbers)).norm(), printed_normal)
              << i;
        }
      }
}

TEST(CliFreeForm, TablesTakePlacesOfPatches) {
  const FreeFormFile on(free_form_of({torus(), unit_sphere()}));
  const std::string own = on.directory.write("own.csv", "patch,u,v\n1,0.5,1.25\n0,3.75,0.125\n1,1,1\n").string();
  const std::string sampled = on.path("sampled.csv"), applied = on.path("applied.csv");
  expect_done(sublimit({"sample", on.obj, "--at", own, "-o", sampled}));
  expect_done(sublimit({"bake", on.obj, "--at", own, "--precision", "double", "-o", on.table}));
  expect_done(sublimit({"apply", on.table, on.obj, "-o", applied}));
  const std::vector<CsvRow> expected = csv_rows(sampled), made = csv_rows(applied);
  ASSERT_EQ(made.size(), 4u);
  EXPECT_EQ(made[0][0], "face");     // the place on the face that the parameters name
  constexpr double printed = 1e-14;  // the same weights, applied in another order
  for (size_t i = 1; i < made.size(); ++i)
    EXPECT_LE((vector_at(made[i], 4) - vector_at(expected[i], 4)).norm(), printed);
  expect_failure(sublimit({"bake", on.obj, "--at", own, "--derivatives", "1", "-o", on.table}), 2, {"face,u,v"});
}

TEST(CliFreeForm, TablesDivideEveryFrame) {
  const FreeFormFile on(bicubic_sphere());
  expect_done(sublimit({"bake", on.obj, "--grid", "9", "--derivatives", "1", "-o", on.table}));
  // Frames of columns: the sphere, and the sphere twice as large with all weights 3.
  const RationalShape shape = elevated(unit_sphere());
  const auto count = static_cast<std::int64_t>(shape.columns.rows());
  const std::string frames = on.path("frames.npy"), out = on.path("out.npy");
  {
    NpyWriter writer(frames, DType::F64, {2, count, 4});
    std::vector<double> all(shape.columns.data(), shape.columns.data() + shape.columns.size());
    writer.write<double>(all);
    for (size_t i = 0; i < all.size(); ++i) all[i] *= i % 4 == 3 ? 3 : 6;
    writer.write<double>(all);
    writer.commit();
  }
  expect_done(sublimit({"apply", on.table, frames, "-o", out}));
  const NpyArray array(out);
  const std::int64_t points = 8 * 81;
  ASSERT_EQ(array.shape(), (std::vector<std::int64_t>{2, 3, points, 3}));
  std::vector<float> numbers(static_cast<size_t>(array.size()));
  array.read<float>(0, numbers);
  for (std::int64_t f = 0; f < 2; ++f)
    for (std::int64_t p = 0; p < points; ++p) {
      const auto vector = [&](std::int64_t q) {
        const float* const x = numbers.data() + ((f * 3 + q) * points + p) * 3;
        return Eigen::Vector3d(x[0], x[1], x[2]);
      };
      constexpr double in_float = 2e-6;     // a few last bits
      constexpr double of_tangents = 2e-5;  // these are up to ten times as long
      EXPECT_NEAR(vector(0).norm(), double(f + 1), in_float);
      EXPECT_NEAR(vector(0).dot(vector(1)), 0, of_tangents);
      EXPECT_NEAR(vector(0).dot(vector(2)), 0, of_tangents);
    }
  // A mesh of the grids, with normals.
  expect_done(sublimit({"apply", on.table, on.obj, "-o", on.path("out.ply")}));
  expect_done(sublimit({"apply", on.table, on.obj, "-o", on.path("out.obj")}));
}

TEST(CliFreeForm, LevelsAreNetsThatTendToTheSurface) {
  const FreeFormFile on(teapot());
  expect_done(sublimit({"bake", on.obj, "-l", "2", "--precision", "double", "-o", on.table}));
  expect_done(sublimit({"apply", on.table, on.obj, "-o", on.path("out.csv")}));
  // Halved twice, a cubic piece has 7 control points a side.
  EXPECT_EQ(csv_rows(on.path("out.csv")).size(), 1 + 32 * 49u);
}

/// Points of samples at a grid of every face, by rows.
Points sampled(const FreeFormFile& on, const std::string& file, const std::vector<std::string>& more) {
  std::vector<std::string> all{"sample", file, "-o", on.path("points.csv")};
  all.insert(all.end(), more.begin(), more.end());
  expect_done(sublimit(all));
  const std::vector<CsvRow> rows = csv_rows(on.path("points.csv"));
  Points points(std::ssize(rows) - 1, 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const size_t column = size_t(std::ranges::find(rows[0], "x") - rows[0].begin());
    points.row(i) = vector_at(rows[size_t(i) + 1], column);
  }
  return points;
}

TEST(CliFreeForm, RefinedNetsAreTheSameSurface) {
  for (const FreeForm& shapes : {bicubic_sphere(), free_form_of({pipe(), torus()}), teapot()}) {
    const FreeFormFile on(shapes);
    const std::string twice = on.path("twice.obj"), once = on.path("once.obj"), again = on.path("again.obj");
    expect_done(sublimit({"refine", on.obj, "-l", "2", "-o", twice, "--matrix", on.path("S.mtx")}));
    expect_done(sublimit({"refine", on.obj, "-l", "1", "-o", once}));
    expect_done(sublimit({"refine", once, "-l", "1", "-o", again}));
    const FreeForm a = read_free_form(twice), b = read_free_form(again);
    ASSERT_EQ(a.vertices.rows(), b.vertices.rows());
    EXPECT_LE((a.vertices - b.vertices).cwiseAbs().maxCoeff(), rounding(64));
    // At their own parameters all three are one surface.
    std::string text = "patch,u,v,side\n";
    for (size_t p = 0; p < shapes.surfaces.size(); ++p)
      for (int i = 0; i <= 10; ++i) {
        const FreeFormSurface& s = shapes.surfaces[p];
        const double u = s.u.first + (s.u.last - s.u.first) * i / 10.0, v = s.v.first + (s.v.last - s.v.first) * 0.3;
        text += std::to_string(p) + "," + format_number(u) + "," + format_number(v) + (i % 2 ? ",+-\n" : ",\n");
      }
    const std::string places = on.directory.write("own.csv", text).string();
    const Points x = sampled(on, on.obj, {"--at", places}), y = sampled(on, twice, {"--at", places});
    EXPECT_LE((x - y).cwiseAbs().maxCoeff(), rounding(64));
    // Limits of the net's points, as a mesh.
    for (const char* name : {"limit.ply", "limit.obj"})
      expect_done(sublimit({"limit", on.obj, "-l", "3", "--normals", "-o", on.path(name)}));
    expect_done(sublimit({"refine", on.obj, "-l", "1", "-o", on.path("net.ply")}));
  }
  const FreeFormFile on(bicubic_sphere());
  expect_done(sublimit({"limit", on.obj, "-l", "1", "-o", on.path("limit.obj")}));
  EXPECT_LE((read_mesh(on.path("limit.obj")).positions.rowwise().norm().array() - 1).abs().maxCoeff(), rounding(16));
}

TEST(CliFreeForm, OwnParametersGiveDerivativesPerUnitOfThem) {
  const FreeFormFile on(free_form_of({torus()}));
  // u = 1 is a knot: the columns' derivative has two sides there.
  const std::string own = on.directory.write("own.csv", "patch,u,v,side\n0,1,0.5,+-\n0,1,0.5,--\n0,1.5,2,\n").string();
  expect_done(sublimit({"sample", on.obj, "--at", own, "--derivatives", "2", "-o", on.path("own.out.csv")}));
  const std::vector<CsvRow> rows = csv_rows(on.path("own.out.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(CsvRow(rows[0].begin(), rows[0].begin() + 6), (CsvRow{"patch", "u", "v", "side", "status", "x"}));
  EXPECT_EQ(rows[1][3], "+-");
  EXPECT_EQ(rows[1][4], "crease");
  // The circle is C^1 though the columns are not; second derivatives jump.
  constexpr double two_sides = 1e-13;  // tangents of both sides by the quotient rule
  EXPECT_LE((vector_at(rows[1], 8) - vector_at(rows[2], 8)).norm(), two_sides);
  EXPECT_GT((vector_at(rows[1], 14) - vector_at(rows[2], 14)).norm(), 1);
  const std::string plain = on.directory.write("plain.csv", "patch,u,v\n0,9,0\n").string();
  expect_failure(sublimit({"sample", on.obj, "--at", plain, "-o", on.path("x.csv")}), 3,
                 {"plain.csv:2", "9", "0", "4"});
  const std::string side = on.directory.write("side.csv", "patch,u,v,side\n0,1,0,+\n").string();
  expect_failure(sublimit({"sample", on.obj, "--at", side, "-o", on.path("x.csv")}), 3,
                 {"side.csv:2", "two of + and -"});
  const std::string patch = on.directory.write("patch.csv", "patch,u,v\n1,1,0\n").string();
  expect_failure(sublimit({"sample", on.obj, "--at", patch, "-o", on.path("x.csv")}), 3, {"patch.csv:2", "0 to 0"});
}

TEST(CliFreeForm, InfoTellsWhatThereIs) {
  const FreeFormFile on(free_form_of({unit_sphere(), elevated(torus())}));
  const Outcome text = expect_done(sublimit({"info", on.obj}));
  expect_parts(text.out, {"2 surfaces, 0 curves", "rat bspline of degree 2 x 2, 9 x 5 control points", "degree 3 x 3",
                          "faces            8 to 23", "C^0 at 1 2 3", "the side v = 0", "the side v = 2",
                          "weights          0.5"});
  const Outcome json = expect_done(sublimit({"info", on.obj, "--json"}));
  expect_parts(json.out, {"\"collapsed_sides\"", "\"rational\": true", "\"degree\": 3"});
  const FreeFormFile kettle(teapot());
  const Outcome pot = expect_done(sublimit({"info", kettle.obj}));
  EXPECT_EQ(count_of(pot.out, "bezier of degree 3 x 3"), 32u);
  EXPECT_EQ(count_of(pot.out, "one point"), 8u) << "of the lid and the bottom";
}

TEST(CliFreeForm, PolesAreSaid) {
  // w = 1 - 2 u: zero in the middle.
  const TemporaryDirectory directory;
  const std::string obj = directory
                              .write("pole.obj",
                                     "v 0 0 0 1\nv 1 0 0 -1\nv 0 1 0 1\nv 1 1 0 -1\n"
                                     "cstype rat bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n")
                              .string();
  const std::string table = (directory / "t.safetensors").string(), out = (directory / "out.csv").string();
  expect_done(sublimit({"sample", obj, "--grid", "3", "-o", out}), true);
  EXPECT_EQ(csv_rows(out)[2][3], "pole");
  expect_done(sublimit({"bake", obj, "--grid", "3", "--derivatives", "1", "-o", table}), true);
  expect_done(sublimit({"apply", table, obj, "-o", out}), true);
  const std::vector<CsvRow> rows = csv_rows(out);
  for (size_t i = 1; i < rows.size(); ++i) {
    const bool pole = rows[i][1] == "0.5";
    EXPECT_EQ(rows[i][3] == "pole", pole) << i;
    EXPECT_EQ(rows[i][4].empty(), pole) << i;
    EXPECT_EQ(rows[i].back().empty(), pole) << i;
  }
}

TEST(CliFreeForm, RefusesWhatDoesNotFit) {
  const FreeFormFile on(bicubic_sphere()), other(free_form_of({torus()}));
  expect_done(sublimit({"bake", on.obj, "--grid", "3", "-o", on.table}));
  expect_failure(sublimit({"apply", on.table, other.obj, "-o", on.path("out.csv")}), 3,
                 {other.obj, "other knots", on.table});
  const std::string plain = on.directory.write("plain.csv", "x,y,z\n0,0,0\n").string();
  expect_failure(sublimit({"apply", on.table, plain, "-o", on.path("out.csv")}), 2, {"3 channels", "w x, w y, w z, w"});
  expect_failure(sublimit({"bake", on.obj, "--grid", "3", "--boundary", "none", "-o", on.table}), 2, {"--boundary"});
  expect_failure(sublimit({"bake", on.obj, "-l", "1", "--limit", "-o", on.table}), 2, {"--limit", "--grid"});
  expect_failure(sublimit({"bake", on.obj, "-l", "1", "--tags", "-o", on.table}), 2, {"--tags"});
  expect_failure(sublimit({"bake", on.obj, "--grid", "3", "--plan"}), 2, {"--plan"});
  expect_failure(sublimit({"bake", on.path("mesh.ply"), "--grid", "3", "-o", on.table}), 2, {"-s SCHEME is missing"});
}

}  // namespace
}  // namespace sublimit::testing
