// SPDX-License-Identifier: Apache-2.0
// Control meshes of level sets beside OpenVDB's polygons.
//   a cell   time of one cell of the grid: OpenVDB's meshing of a sampled field, and all of ours: sampling, meshing,
//            projection, fits, at the same number of cells
//   faces    of the coarsest polygons, with vertices moved onto the surface, that are as near to it as the limit of our
//            cage; distances are |F| / |grad F| on grids inside faces, over the diagonal of the surface
//
// `implicit_bench --ratios [turns]` takes turns (report.h).
#include <algorithm>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measuring.h"
#include "bench_report.h"
#include "sublimit/implicit/detail/combinations.h"
#include "sublimit/implicit/detail/level_set_mesh.h"
#include "sublimit/implicit/polygonize/polygonize.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::bench {
namespace {

using Eigen::Vector3d;

struct Shape {
  std::string name;
  FieldPointer field;
  std::optional<Eigen::AlignedBox3d> box = std::nullopt;
};

Eigen::AlignedBox3d box_of(const Shape& shape, int cells) {
  return shape.box ? *shape.box : padded_extent(*shape.field, cells);
}

std::vector<Shape> shapes() {
  std::vector<FieldPointer> chain;
  const Vector3d joints[] = {{0, 0, 0}, {1, 0, 0}, {1.6, .8, 0}, {1.6, .8, 1}};
  for (int i = 0; i < 3; ++i) chain.push_back(distance_to_segment(joints[i], joints[i + 1], .35));
  return {
      {"sphere", sphere_field({0, 0, 0}, 1)},
      {"torus", distance_to_circle({0, 0, 0}, {0, 0, 1}, 1, .4)},
      {"quartic",
       polynomial_field(
           {{1, 4, 0, 0}, {-5, 2, 0, 0}, {1, 0, 4, 0}, {-5, 0, 2, 0}, {1, 0, 0, 4}, {-5, 0, 0, 2}, {11.8, 0, 0, 0}}),
       Eigen::AlignedBox3d(Vector3d(-3, -3, -3), Vector3d(3, 3, 3))},
      {"metaballs", metaballs_field(.4, {{{0, 0, 0}, 1, 1}, {{.9, 0, 0}, 1, 1}, {{.4, .8, 0}, 1, 1}})},
      {"capsule chain", smooth_union_field(chain, .2)},
      {"part", difference_field({box_field({0, 0, 0}, {1, 1, .5}), distance_to_line({0, 0, 0}, {0, 0, 1}, .5)})}};
}

/// Largest distance of places inside the faces, vertices being on the surface, those on sharp edges on the edges.
double polygon_error(const Field& field, const Mesh& mesh) {
  double largest = 0;
  constexpr int n = 4;  // middles of faces, too
  size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    const auto at = [&](size_t i) { return Vector3d(mesh.positions.row(mesh.face_vertices[first + i])); };
    const size_t last = size == 4 ? 3 : 2;  // triangles are squares with a side of no length
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double u = double(i) / n, v = double(j) / n;
        const Vector3d x = (1 - v) * ((1 - u) * at(0) + u * at(1)) + v * ((1 - u) * at(last) + u * at(2));
        const FieldJet jet = field.jet(x);
        largest = std::max(largest, std::abs(jet.value) / std::max(1e-12, jet.gradient.norm()));
      }
    first += size_t(size);
  }
  return largest;
}

/// Polygons with vertices moved onto the surface; onto its edges if it has some.
Mesh polygons(const Shape& shape, int cells) {
  const FieldGrid grid = sample_field(*shape.field, box_of(shape, cells), cells);
  Mesh mesh = polygonize(grid);
  if (shape.field->has_edges()) return make_cage(std::move(mesh), FieldSides(shape.field, true), grid.cell).mesh;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const Projection p = project(*shape.field, mesh.positions.row(v), 3 * grid.cell);
    if (p.converged) mesh.positions.row(v) = p.point;
  }
  return mesh;
}

/// Faces of the coarsest polygons that are as near; 0 beyond 400 cells.
Index polygons_as_near(const Shape& shape, double distance) {
  for (int cells = 8; cells <= 400; cells += std::max(1, cells / 8)) {
    const Mesh mesh = polygons(shape, cells);
    if (polygon_error(*shape.field, mesh) <= distance) return mesh.num_faces();
  }
  return 0;
}

int take_turns(Report& report) {
  for (const char* name : {"catmull-clark", "loop", "modified-butterfly"})
    for (const Shape& shape : shapes()) {
      if (!report.wants("level set", shape.name, name)) continue;
      const Scheme<double> scheme = find_scheme(name).value();
      LevelSetMesh made = level_set_mesh(shape.field, scheme, polygonize, {.box = shape.box});
      const int cells = made.attempt.cells;  // their number is searched for once
      const auto ours = [&] {
        return seconds(
            [&] { made = level_set_mesh(shape.field, scheme, polygonize, {.box = shape.box, .cells = cells}); });
      };
      const FieldGrid grid = sample_field(*shape.field, box_of(shape, cells), cells);
      report.measure(
          {"level set", shape.name, name, report.threads().back(), "ns a cell", 1e9 / std::pow(cells, 3)},
          {{"ours", Role::ours, ours}, {"OpenVDB's polygons", Role::shown, [&] {
                                          return seconds([&] { benchmark::DoNotOptimize(polygonize(grid)); });
                                        }}});
      const double distance = made.attempt.error.largest;
      const Index plain = report.quick() ? 0 : polygons_as_near(shape, distance);
      std::printf("    %d cells, %d faces, distance %.2g; polygons as near %d, %.1f times as many\n", cells,
                  int(made.attempt.faces), distance / made.diagonal, int(plain),
                  double(plain) / double(made.attempt.faces));
      report.count("level set of " + shape.name + ", " + name, "faces", double(made.attempt.faces));
    }
  return report.finish();
}

void register_benchmarks() {
  static const std::vector<Shape> all = shapes();
  for (const Shape& shape : all) {
    benchmark::RegisterBenchmark(("BM_Polygons/" + shape.name).c_str(), [&](benchmark::State& state) {
      const FieldGrid grid = sample_field(*shape.field, box_of(shape, 32), 32);
      for (auto _ : state) benchmark::DoNotOptimize(polygonize(grid));
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("BM_ControlMesh/" + shape.name).c_str(), [&](benchmark::State& state) {
      for (auto _ : state)
        benchmark::DoNotOptimize(
            level_set_mesh(shape.field, find_scheme("catmull-clark").value(), polygonize, {.box = shape.box}));
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) {
  using namespace sublimit::bench;
  Report report("implicit_bench", argc, argv);
  if (report.turns()) return take_turns(report);
  register_benchmarks();
  return run_benchmarks(argc, argv);
}
