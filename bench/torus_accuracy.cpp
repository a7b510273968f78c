// SPDX-License-Identifier: Apache-2.0
// How far the scheme of torus pieces is from surfaces that are known, by level, as a table in Markdown: the largest
// distance, angle of normals, and error of both principal curvatures at vertices; and the largest angle between
// triangles and the normals of their corners' data. Data of level 0 are exact.
//
// `torus_accuracy [PICTURE.svg]` draws them, too.
#include <cmath>
#include <cstdio>
#include <functional>

#include "meshes/meshes.h"
#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/geometric/torus_pieces.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/page.h"
#include "sublimit/report/page/plot.h"
#include "truth/deviation.h"

namespace sublimit::bench {
namespace {

using testing::Deviation;
using testing::deviations;
using testing::ImplicitSurface;
using testing::targets_on;

using Eigen::Vector3d;
constexpr int levels = 5;

/// The graph of a function with its derivatives up to the second: f, fx, fy, fxx, fxy, fyy.
ImplicitSurface graph(std::function<Eigen::Matrix<double, 6, 1>(double, double)> f) {
  return {[f = std::move(f)](const Vector3d& x) {
    const auto d = f(x[0], x[1]);
    ImplicitSurface::Jet jet{.value = x[2] - d[0], .gradient = {-d[1], -d[2], 1}};
    jet.hessian.topLeftCorner<2, 2>() << -d[3], -d[4], -d[4], -d[5];
    return jet;
  }};
}

struct Subject {
  std::string name;
  ImplicitSurface surface;
  double half;  // of the square over which the data lie
  Index squares;
};

CurvatureMesh data_of(const Subject& subject) {
  const Index n = subject.squares;
  Mesh mesh = testing::triangle_grid(n, n);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const double x = subject.half * (2.0 * (v % (n + 1)) / n - 1), y = subject.half * (2.0 * (v / (n + 1)) / n - 1);
    mesh.positions.row(v) << x, y, -subject.surface.at({x, y, 0}).value;
  }
  return curvature_mesh(mesh, targets_on(subject.surface, mesh));
}

struct Column {
  const char* name;
  double (*of)(const Deviation&);
};
constexpr Column columns[] = {
    {"position", [](const Deviation& d) { return d.position.largest; }},
    {"normal, rad", [](const Deviation& d) { return d.normal.largest; }},
    {"larger curvature", [](const Deviation& d) { return d.k1.largest; }},
    {"smaller curvature", [](const Deviation& d) { return d.k2.largest; }},
    {"triangle to normals, rad", [](const Deviation& d) { return d.triangle.largest; }},
};

/// One plot of all columns from level 1 on: level 0 is exact.
std::string plot(const Subject& subject, const std::vector<Deviation>& rows) {
  page::Plot plot{.title = subject.name,
                  .description = "deviations by level",
                  .x_name = "level",
                  .y_name = subject.name,
                  .whole_x = true,
                  .log_y = true,
                  .height = 280};
  int kind = 0;
  for (const Column& column : columns) {
    page::Series series{.name = column.name, .kind = kind++};
    for (const Deviation& row : rows)
      if (row.level > 0) series.points.emplace_back(row.level, column.of(row));
    plot.series.push_back(std::move(series));
  }
  return page::string(page::at(page::figure(plot), "svg"));
}

/// Plots beside each other, and below them what the signs mean.
std::string picture(const std::vector<std::string>& plots) {
  const double width = 390, height = 330;
  std::string body = "<style>" + page::style() + "</style><rect width=\"100%\" height=\"100%\" fill=\"#fcfbf8\"/>";
  for (size_t i = 0; i < plots.size(); ++i)
    body += "<g transform=\"translate(" + std::to_string(5 + int(width) * int(i)) +
            " 0)\"><svg width=\"380\" height=\"280\"" + plots[i].substr(std::string("<svg").size()) + "</g>";
  double x = 30;
  for (int kind = 0; const Column& column : columns) {
    body += page::mark(kind++, x, height - 22);
    body += page::text(x + 9, height - 18, column.name);
    x += 34 + 7.2 * double(std::string(column.name).size());
  }
  const double whole = width * double(plots.size());
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + std::to_string(int(whole)) + " " +
         std::to_string(int(height)) + "\" width=\"" + std::to_string(int(whole)) + "\" height=\"" +
         std::to_string(int(height)) + "\" font-family=\"system-ui, DejaVu Sans, sans-serif\" font-size=\"13\">" +
         body + "</svg>\n";
}

int run(int argc, char** argv) {
  const ImplicitSurface saddle =
      graph([](double x, double y) { return Eigen::Matrix<double, 6, 1>{x * y, y, x, 0, 1, 0}; });
  const ImplicitSurface waves = graph([](double x, double y) {
    const double s = std::sin(x), c = std::cos(x), S = std::sin(y), C = std::cos(y);
    return Eigen::Matrix<double, 6, 1>{s * C, c * C, -s * S, -s * C, -c * S, -s * C};
  });
  const std::vector<Subject> subjects = {{"saddle z = x y, 8 x 8", saddle, 1, 8},
                                         {"saddle, 16 x 16", saddle, 1, 16},
                                         {"z = sin x cos y, 12 x 12", waves, M_PI, 12},
                                         {"z = sin x cos y, 24 x 24", waves, M_PI, 24}};
  std::printf("| data | level | vertices |");
  for (const Column& column : columns) std::printf(" %s |", column.name);
  std::printf("\n|---|---|---|");
  for (size_t i = 0; i < std::size(columns); ++i) std::printf("---|");
  std::printf("\n");
  std::vector<std::string> plots;
  for (const Subject& subject : subjects) {
    const std::vector<Deviation> rows = deviations(torus_pieces({}), data_of(subject), levels, subject.surface);
    for (const Deviation& row : rows) {
      std::printf("| %s | %d | %d |", subject.name.c_str(), row.level, row.vertices);
      for (const Column& column : columns) std::printf(" %.1e |", column.of(row));
      std::printf("\n");
    }
    plots.push_back(plot(subject, rows));
  }
  if (argc < 2) return 0;
  AtomicFile file(argv[1]);
  file.write(picture({plots[0], plots[2], plots[3]}));
  file.commit();
  return 0;
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::run(argc, argv); }
