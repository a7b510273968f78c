// SPDX-License-Identifier: Apache-2.0
// What refinement and tables take as meshes grow, and what else is counted in milliseconds: Catmull-Clark.
//   refine, bake, apply  a torus of 10^3 to 10^7 faces, level 2: time, and bytes of memory a point made | OpenSubdiv's
//            refinement in double, stencil table in float, Osd::CpuEvaluator
//   edit     a face of a 100k-face torus extruded, a crease set, again and again: one edit of an editable table
//   load     a table of 1 GB in a file (a list of rows), mapped and applied once | applied again
//   small    500 faces, level 2: one apply
// Each job of the first row is done by a process of its own, for memory is what that holds at most, its peak resident
// set, above what it held when it had the mesh: whoever asks for memory, and however, it counts. What would take more
// than the machine has is left out.
//
// `table_scaling [--ratios turns] [--largest exponent = 7]`, and what report.h takes.
#include <sys/sysinfo.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "bench_meshes.h"
#include "bench_report.h"
#include "measuring.h"
#include "opensubdiv_table.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/pattern_edits.h"

namespace sublimit::bench {
namespace {

Scheme<double> catmull_clark() { return find_scheme("catmull-clark").value(); }

std::vector<float> positions(const Mesh& mesh) {
  return {mesh.positions.data(), mesh.positions.data() + mesh.positions.size()};
}

constexpr int levels = 2;

/// Of some turns of a job: what they took, the memory of the first, and of all that the job did before and then.
struct Taken {
  std::vector<double> times;
  double bytes = 0, points = 0, all_bytes = 0;
};

/// Turns of a job in this process, which has done nothing else.
Taken take(const std::string& work, bool ours, int exponent, int turns) {
  const auto n = static_cast<Index>(std::lround(std::pow(10.0, exponent)));
  const Case mesh{"torus", "catmull-clark", testing::torus(n / 20, 20)};
  const double at_first = forget_peak_bytes();
  const PeerCase peer(mesh);
  Patterns patterns(catmull_clark());
  (void)bake_level(patterns, testing::torus(5, 5), levels);  // its type is known
  Taken taken;
  const auto run = [&](const auto& turn) {
    for (int i = 0; i < turns; ++i) {
      taken.all_bytes = std::max(taken.all_bytes, peak_bytes() - at_first);
      const double before = forget_peak_bytes();
      taken.times.push_back(seconds([&] { taken.points = double(turn()); }));
      if (i == 0) taken.bytes = peak_bytes() - before;
    }
  };
  if (work == "refine" && ours) {
    std::optional<Mesh> refined;
    run([&] {
      refined.reset();
      return refined.emplace(refined_mesh(catmull_clark(), mesh.mesh, levels)).positions.rows();
    });
  } else if (work == "refine") {
    const std::span<const double> points{mesh.mesh.positions.data(), size_t(mesh.mesh.positions.size())};
    std::optional<PeerRefiner> refiner;
    run([&] {
      refiner.reset();
      refiner.emplace(peer.mesh, levels).refine(points);
      return refiner->num_vertices(levels);
    });
  } else if (ours) {
    PatternTable<float> table;
    const auto bake = [&] {
      table = {};
      table = in_float(bake_level(patterns, mesh.mesh, levels).table.table);
      return table.num_points();
    };
    if (work == "bake") {
      run(bake);
    } else {
      bake();
      const PatternEvaluator<float> evaluator(table);
      const std::vector<float> points = positions(mesh.mesh);
      std::vector<float> made(size_t(table.num_points()) * 3);
      evaluator.apply(points, 3, made);
      run([&] {
        evaluator.apply(points, 3, made);
        return table.num_points();
      });
    }
  } else {
    std::optional<PeerTable> table;
    const auto bake = [&] {
      table.reset();
      return table.emplace(peer.mesh, levels).num_points();
    };
    if (work == "bake") {
      run(bake);
    } else {
      const std::vector<float> points = positions(mesh.mesh);
      std::vector<float> made(bake() * 3);
      table->apply_osd(points, made);
      run([&] {
        table->apply_osd(points, made);
        return table->num_points();
      });
    }
  }
  taken.all_bytes = std::max(taken.all_bytes, peak_bytes() - at_first);
  return taken;
}

/// The same by a process of its own.
/// @return  nothing if the system ended it, which it does where memory is short
/// @throws std::runtime_error  it fails
std::optional<Taken> take_elsewhere(const std::string& work, bool ours, int exponent, int turns, int threads) {
  const std::string command = "'" + std::filesystem::read_symlink("/proc/self/exe").string() + "' --job " + work + " " +
                              (ours ? "ours" : "peer") + " " + std::to_string(exponent) + " " + std::to_string(turns) +
                              " " + std::to_string(threads);
  FILE* const output = ::popen(command.c_str(), "r");
  if (!output) throw std::runtime_error("cannot run " + command);
  Taken taken;
  const bool complete = std::fscanf(output, "%lf %lf %lf", &taken.bytes, &taken.points, &taken.all_bytes) == 3;
  for (double time; std::fscanf(output, "%lf", &time) == 1;) taken.times.push_back(time);
  const int status = ::pclose(output);
  const bool killed = WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) == 128 + SIGKILL);
  if (killed) return std::nullopt;
  if (status != 0 || !complete || taken.times.empty()) throw std::runtime_error("failed: " + command);
  return taken;
}

int job(char** argv) {
  const Threads scope(std::atoi(argv[4]));
  const Taken taken = take(argv[0], argv[1] == std::string("ours"), std::atoi(argv[2]), std::atoi(argv[3]));
  std::printf("%.17g %.17g %.17g", taken.bytes, taken.points, taken.all_bytes);
  for (const double time : taken.times) std::printf(" %.17g", time);
  return 0;
}

/// Bytes of memory that are free.
double free_bytes() {
  struct sysinfo info {};
  ::sysinfo(&info);
  return double(info.freeram + info.bufferram) * info.mem_unit;
}

void scaling(Report& report, int largest) {
  for (const int threads : report.threads())
    for (const std::string work : {"refine", "bake", "apply"}) {
      double bytes[2] = {0, 0};  // of the last size, all that the job took
      for (int exponent = 3; exponent <= largest; ++exponent) {
        const std::string mesh = "10^" + std::to_string(exponent) + " faces";
        if (!report.wants(work, mesh, "level 2")) continue;
        std::vector<Report::Values> times, memory;
        for (const bool ours : {true, false}) {
          double& last = bytes[ours ? 0 : 1];
          if (10 * last > 0.9 * free_bytes()) {
            std::printf("%s, %s, %s: left out, it would take %.0f GB\n", work.c_str(), mesh.c_str(),
                        ours ? "ours" : "OpenSubdiv", last / 1e8);
            last *= 10;
            continue;
          }
          const auto done = take_elsewhere(work, ours, exponent, exponent < 7 ? report.turns() : 1, threads);
          if (!done) {
            std::printf("%s, %s, %s: left out, the system ended it\n", work.c_str(), mesh.c_str(),
                        ours ? "ours" : "OpenSubdiv");
            last *= 10;
            continue;
          }
          const Taken& taken = *done;
          last = taken.all_bytes;
          const Report::Values values{ours ? "ours" : "OpenSubdiv", ours ? Role::ours : Role::peer, {}};
          times.push_back(values);
          for (const double time : taken.times) times.back().values.push_back(1e3 * time);
          memory.push_back(values);
          memory.back().values = {taken.bytes / taken.points};
        }
        if (times.empty()) continue;
        report.add({work, mesh, "level 2", threads}, times);
        if (work != "apply") report.add({work + " memory", mesh, "level 2", threads, "B a point", 1}, memory);
      }
    }
}

void edits(Report& report) {
  Patterns patterns(catmull_clark());
  const Mesh mesh = testing::torus(400, 250);
  PatternEdits<float> table(patterns, mesh, 2);
  std::vector<double> extrusions, tags;  // in ms
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
    extrusions.push_back(1e3 * seconds([&] { faces = table.edit(extrude).faces.size(); }));
    const auto* d = mesh.face_vertices.data() + 4 * (face + 2000);
    tag.creases = {{d[0], d[1], 10}};
    tags.push_back(1e3 * seconds([&] { tagged = table.edit(tag).faces.size(); }));
  }
  std::printf("first extrusion %.2f ms, crease %.2f ms: new types\n", extrusions[0], tags[0]);
  report.add({"edit", "10^5 faces", "extrusion"}, {{"ours", Role::ours, extrusions}});
  report.add({"edit", "10^5 faces", "crease"}, {{"ours", Role::ours, tags}});
  report.count("edit of 10^5 faces", "faces of an extrusion", double(faces));
  report.count("edit of 10^5 faces", "faces of a crease", double(tagged));
}

void load(Report& report) {
  const auto path = std::filesystem::temp_directory_path() / ("sublimit_bench_" + std::to_string(::getpid()));
  constexpr std::int64_t per_row = 15;
  const std::int64_t rows = report.quick() ? 80'000 : 8'000'000;
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
  std::printf("load: a file of %.2f GB: checked and ready after %.1f ms, first frame %.1f ms\n",
              double(std::filesystem::file_size(path)) / 1e9, load_time * 1e3, first * 1e3);
  report.add({"load", "8M rows", "file to evaluator"}, {{"ours", Role::ours, {1e3 * load_time}}});
  report.measure({"load", "8M rows", "apply"},
                 {{"ours", Role::ours, [&] { return seconds([&] { evaluator->apply(control, 3, made); }); }}});
  std::filesystem::remove(path);
}

void small(Report& report) {
  Patterns patterns(catmull_clark());
  const Mesh mesh = testing::torus(25, 20);
  const PatternTable<float> table = in_float(bake_level(patterns, mesh, 2).table.table);
  const PatternEvaluator<float> evaluator(table);
  const std::vector<float> points = positions(mesh);
  std::vector<float> made(size_t(table.num_points()) * 3);
  report.measure({"apply", "500 faces", "level 2", thread_counts().back(), "us", 1e6},
                 {{"ours", Role::ours, [&] { return seconds([&] { evaluator.apply(points, 3, made); }); }}}, 2001);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) {
  using namespace sublimit::bench;
  if (argc == 7 && argv[1] == std::string("--job")) return job(argv + 2);
  Report report("table_scaling", argc, argv);
  int largest = report.quick() ? 4 : 7;
  if (argc == 3 && argv[1] == std::string("--largest")) largest = std::atoi(argv[2]);
  report.take_turns(5);
  scaling(report, largest);
  if (report.wants("apply", "500 faces", "level 2")) small(report);
  if (report.wants("edit")) edits(report);
  if (report.wants("load")) load(report);
  return report.finish();
}
