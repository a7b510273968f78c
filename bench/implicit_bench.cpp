// SPDX-License-Identifier: Apache-2.0
// Control meshes of level sets beside OpenVDB's polygons.
//   a cell   time of one cell of the grid: OpenVDB's meshing of a sampled field, and all of ours: sampling, meshing,
//            projection, fits, at the same number of cells
//   faces    of the coarsest polygons, with vertices moved onto the surface, that are as near to it as the limit of our
//            cage; distances are |F| / |grad F| on grids inside faces, over the diagonal of the surface
//
// `implicit_bench --ratios [repetitions]` takes turns and prints medians.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "measuring.h"
#include "sublimit/implicit/combinations.h"
#include "sublimit/implicit/level_set_mesh.h"
#include "sublimit/implicit/polygonize/polygonize.h"
#include "sublimit/schemes.h"

namespace sublimit::bench {
namespace {

using Eigen::Vector3d;

struct Shape {
  std::string name;
  FieldPointer field;
};

std::vector<Shape> shapes() {
  std::vector<FieldPointer> chain;
  const Vector3d joints[] = {{0, 0, 0}, {1, 0, 0}, {1.6, .8, 0}, {1.6, .8, 1}};
  for (int i = 0; i < 3; ++i) chain.push_back(distance_to_segment(joints[i], joints[i + 1], .35));
  return {{"sphere", sphere_field({0, 0, 0}, 1)},
          {"torus", distance_to_circle({0, 0, 0}, {0, 0, 1}, 1, .4)},
          {"metaballs", metaballs_field(.4, {{{0, 0, 0}, 1, 1}, {{.9, 0, 0}, 1, 1}, {{.4, .8, 0}, 1, 1}})},
          {"capsule chain", smooth_union_field(chain, .2)},
          {"part", difference_field({box_field({0, 0, 0}, {1, 1, .5}), distance_to_line({0, 0, 0}, {0, 0, 1}, .5)})}};
}

/// Largest distance of places inside the faces, vertices being on the surface.
double polygon_error(const Field& field, const ControlMesh& mesh, double cell) {
  Points corners = mesh.positions;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const Projection p = project(field, corners.row(v), 3 * cell);
    if (p.converged) corners.row(v) = p.point;
  }
  double largest = 0;
  constexpr int n = 3;
  size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    const auto at = [&](size_t i) { return Vector3d(corners.row(mesh.face_vertices[first + i])); };
    for (int i = 0; size == 4 && i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double u = double(i) / n, v = double(j) / n;
        const Vector3d x = (1 - v) * ((1 - u) * at(0) + u * at(1)) + v * ((1 - u) * at(3) + u * at(2));
        const FieldJet jet = field.jet(x);
        largest = std::max(largest, std::abs(jet.value) / std::max(1e-12, jet.gradient.norm()));
      }
    first += size_t(size);
  }
  return largest;
}

ControlMesh polygons(const Field& field, int cells) {
  return polygonize(sample_field(field, padded_extent(field, cells), cells));
}

/// Faces of the coarsest polygons that are as near; 0 beyond 400 cells.
Index polygons_as_near(const Field& field, double distance) {
  for (int cells = 8; cells <= 400; cells += cells / 4) {
    const ControlMesh mesh = polygons(field, cells);
    const double side = padded_extent(field, cells).sizes().maxCoeff() / cells;
    if (polygon_error(field, mesh, side) <= distance) return mesh.num_faces();
  }
  return 0;
}

double median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
  return times[times.size() / 2];
}

void print_ratios(int repetitions) {
  std::printf("%-14s %-15s %7s %6s %10s %9s %6s | ns a cell: %9s %9s\n", "surface", "scheme", "cells", "faces",
              "distance", "polygons", "ratio", "OpenVDB", "ours");
  for (const Shape& shape : shapes())
    for (const char* name : {"catmull-clark", "loop", "modified-butterfly"}) {
      const Scheme<double> scheme = find_scheme(name).value();
      LevelSetMesh made;
      std::vector<double> ours, theirs;
      for (int i = 0; i < repetitions; ++i) {
        LevelSetOptions options;
        if (i > 0) options.cells = made.attempt.cells;
        ours.push_back(seconds([&] { made = level_set_mesh(shape.field, scheme, polygonize, options); }));
        const FieldGrid grid =
            sample_field(*shape.field, padded_extent(*shape.field, made.attempt.cells), made.attempt.cells);
        theirs.push_back(seconds([&] { benchmark::DoNotOptimize(polygonize(grid)); }));
      }
      if (ours.size() > 1) ours.erase(ours.begin());  // the search for the number of cells
      const double cells = std::pow(made.attempt.cells, 3), distance = made.attempt.error.largest;
      const Index plain = polygons_as_near(*shape.field, distance);
      std::printf("%-14s %-15s %7d %6d %10.2g %9d %6.1f |            %9.0f %9.0f\n", shape.name.c_str(), name,
                  made.attempt.cells, int(made.attempt.faces), distance / made.diagonal, int(plain),
                  double(plain) / double(made.attempt.faces), 1e9 * median(theirs) / cells, 1e9 * median(ours) / cells);
      std::fflush(stdout);
    }
}

void register_benchmarks() {
  static const std::vector<Shape> all = shapes();
  for (const Shape& shape : all) {
    benchmark::RegisterBenchmark(("BM_Polygons/" + shape.name).c_str(), [&](benchmark::State& state) {
      const FieldGrid grid = sample_field(*shape.field, padded_extent(*shape.field, 32), 32);
      for (auto _ : state) benchmark::DoNotOptimize(polygonize(grid));
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("BM_ControlMesh/" + shape.name).c_str(), [&](benchmark::State& state) {
      for (auto _ : state)
        benchmark::DoNotOptimize(level_set_mesh(shape.field, find_scheme("catmull-clark").value(), polygonize));
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) {
  using namespace sublimit::bench;
  if (const int repetitions = repetitions_of_ratios(argc, argv)) {
    print_ratios(repetitions);
    return 0;
  }
  register_benchmarks();
  return run_benchmarks(argc, argv);
}
