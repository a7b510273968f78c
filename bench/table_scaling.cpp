// SPDX-License-Identifier: Apache-2.0
// What tables take as meshes grow, and what else is counted in milliseconds: Catmull-Clark, float, all threads.
//   scaling  torus of 10^4 to 10^7 faces, level 2: bake with known types, bytes of the table, peak memory, apply
//   edit     a face of a 100k-face torus extruded, a crease set, again and again: one edit of an editable table
//   load     a table of 1 GB in a file (a list of rows), mapped and applied once | applied again
//   small    500 faces, level 2: one apply
// `table_scaling [largest exponent = 7]`
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "measuring.h"
#include "sublimit/bake/bake.h"
#include "sublimit/bake/editable_table.h"
#include "sublimit/pattern_evaluator.h"
#include "sublimit/schemes.h"
#include "sublimit/table_file.h"
#include "support/meshes.h"

namespace sublimit::bench {
namespace {

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

template <class Work>
double median_seconds(int repetitions, const Work& work) {
  std::vector<double> times;
  for (int r = 0; r < repetitions; ++r) times.push_back(seconds(work));
  return median(times);
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

Scheme<double> catmull_clark() { return find_scheme("catmull-clark").value(); }

std::vector<float> positions(const ControlMesh& mesh) {
  return {mesh.positions.data(), mesh.positions.data() + mesh.positions.size()};
}

void scaling(int exponent) {
  const auto n = static_cast<Index>(std::lround(std::pow(10.0, exponent)));
  const ControlMesh mesh = testing::torus(n / 100, 100);
  const double given = peak_bytes();
  Patterns patterns(catmull_clark());
  bake_level(patterns, testing::torus(5, 5), 2);  // its type is known
  PatternTable<float> table;
  const double bake = seconds([&] { table = in_float(bake_level(patterns, mesh, 2).table.table); });
  const double peak = peak_bytes();
  const PatternEvaluator<float> evaluator(table);
  const std::vector<float> points = positions(mesh);
  std::vector<float> made(size_t(table.num_points()) * 3);
  const double apply = median_seconds(5, [&] { evaluator.apply(points, 3, made); });
  std::printf(
      "%9d faces: bake %8.1f ms, %5.0f ns a face; table %7.1f MB, %4.0f bytes a face; peak %6.0f MB (mesh %5.0f MB); "
      "apply %7.2f ms, %.2f ns a point\n",
      n, bake * 1e3, bake * 1e9 / n, double(table.num_bytes()) / 1e6, double(table.num_bytes()) / n, peak / 1e6,
      given / 1e6, apply * 1e3, apply * 1e9 / double(table.num_points()));
  std::fflush(stdout);
}

void edits() {
  Patterns patterns(catmull_clark());
  const ControlMesh mesh = testing::torus(400, 250);
  EditableTable<float> table(patterns, mesh, 2);
  std::vector<double> extrusions, tags;
  size_t faces = 0, tagged = 0;
  for (int i = 0; i < 21; ++i) {
    const Index face = 1000 + 4000 * i;
    const auto* c = mesh.face_vertices.data() + 4 * face;
    const Index v = table.num_control_points();
    MeshEdit extrude, tag;
    extrude.removed_faces = {face};
    extrude.added_vertices = 4;
    for (Index k = 0; k < 4; ++k) extrude.added_faces.push_back({c[k], c[(k + 1) % 4], v + (k + 1) % 4, v + k});
    extrude.added_faces.push_back({v, v + 1, v + 2, v + 3});
    extrusions.push_back(seconds([&] { faces = table.edit(extrude).faces.size(); }));
    const auto* d = mesh.face_vertices.data() + 4 * (face + 2000);
    tag.creases = {{d[0], d[1], 10}};
    tags.push_back(seconds([&] { tagged = table.edit(tag).faces.size(); }));
  }
  std::printf(
      "edit, 100k faces, 21 of each: extrusion %.3f ms, %zu faces; crease %.3f ms, %zu faces (medians; first %.2f, "
      "%.2f ms: new types)\n",
      median(extrusions) * 1e3, faces, median(tags) * 1e3, tagged, extrusions[0] * 1e3, tags[0] * 1e3);
}

void load() {
  const auto path = std::filesystem::temp_directory_path() / ("sublimit_bench_" + std::to_string(::getpid()));
  constexpr std::int64_t rows = 8'000'000, per_row = 15;
  constexpr std::int32_t points = 1'000'000;
  {
    std::vector<std::int64_t> offsets(rows + 1);
    std::vector<std::int32_t> columns(rows * per_row);
    for (std::int64_t r = 0; r <= rows; ++r) offsets[r] = r * per_row;
    for (std::int64_t k = 0; k < rows * per_row; ++k)
      columns[k] = static_cast<std::int32_t>((k / per_row / 8 + k % per_row) % points);
    PatternTable<float>::Arrays arrays;
    arrays.rest = StencilTable<float>(points, std::move(offsets), std::move(columns),
                                      std::vector<float>(size_t(rows * per_row), 1.0f / per_row));
    BakedTable<float> table;
    table.table = PatternTable<float>(points, std::move(arrays));
    table.info.scheme = "none";
    save_table(path, table);
  }
  const std::vector<float> control(size_t(points) * 3, 1.0f);
  std::vector<float> made(size_t(rows) * 3);
  std::optional<AnyTable> loaded;
  std::optional<PatternEvaluator<float>> evaluator;
  const double load_time = seconds([&] {
    loaded = load_table(path);
    evaluator.emplace(std::get<BakedTable<float>>(*loaded).table);
  });
  const double first = seconds([&] { evaluator->apply(control, 3, made); });
  const double again = median_seconds(5, [&] { evaluator->apply(control, 3, made); });
  std::printf("load: a file of %.2f GB: checked and ready after %.1f ms, first frame %.1f ms, later ones %.1f ms\n",
              double(std::filesystem::file_size(path)) / 1e9, load_time * 1e3, first * 1e3, again * 1e3);
  std::filesystem::remove(path);
}

void small() {
  Patterns patterns(catmull_clark());
  const ControlMesh mesh = testing::torus(25, 20);
  const PatternTable<float> table = in_float(bake_level(patterns, mesh, 2).table.table);
  const PatternEvaluator<float> evaluator(table);
  const std::vector<float> points = positions(mesh);
  std::vector<float> made(size_t(table.num_points()) * 3);
  const double time = median_seconds(2001, [&] { evaluator.apply(points, 3, made); });
  std::printf("small: 500 faces, level 2, %lld points: apply %.1f us\n", static_cast<long long>(table.num_points()),
              time * 1e6);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) {
  using namespace sublimit::bench;
  const int largest = argc > 1 ? std::atoi(argv[1]) : 7;
  for (int exponent = 4; exponent <= largest; ++exponent) scaling(exponent);  // first: peaks do not fall
  small();
  edits();
  load();
}
