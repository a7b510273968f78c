// SPDX-License-Identifier: Apache-2.0
// Tables on GPUs, in float. On every device that there is, all of it in one run:
//   device   points and results on the device: applies in one submission, the mean of them
//            | the same table row by row, a thread a row, as OpenSubdiv's kernels for CUDA, OpenCL and Metal have it;
//            zeros: points of no columns, which are only written
//   host     points from the host, results back to it | the CPU's evaluator, all threads
//   many     1000 tables of 500 faces each, in one submission
//   copy     what the device's memory moves: copies between two large buffers
// In picoseconds a point, but for `copy`. What is made, half floats left out, is compared with the CPU's before it is
// timed. The limit of `device` is the time to write the points: `copy` counts bytes read and bytes written.
//
// `gpu_bench --ratios [turns]` takes turns (report.h), or one; `--only "device torus"` takes some rows, `--device N`
// one of the devices that `sublimit devices` lists.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "bench_meshes.h"
#include "bench_report.h"
#include "measuring.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/gpu/gpu_evaluator.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit::bench {
namespace {

/// A submission is to take so long, so that its start and its end do not count.
constexpr double seconds_of_submission = 0.02;

/// What is wanted of each point.
struct Asked {
  std::string name;
  BakeRequest request;
  bool first = false, normals = false, halves = false;
  double bytes_of_point() const { return (halves ? 2.0 : 4.0) * 3 * (1 + 2 * first + normals); }
};

/// A table on a device, its points and its results.
class Resident {
 public:
  Resident(const PatternTable<float>& table, const GpuDevice& device, std::span<const float> points, const Asked& asked)
      : device_(device),
        evaluator_(table, device),
        points_(device, std::int64_t(points.size_bytes())),
        results_(device, std::int64_t(asked.bytes_of_point() * double(table.num_points()))) {
    points_.write(std::as_bytes(points));
    evaluation_.points = points_.address();
    evaluation_.halves = asked.halves;
    const std::uint64_t of_quantity = std::uint64_t(table.num_points()) * 3 * (asked.halves ? 2 : 4);
    std::uint64_t at = results_.address();
    for (size_t q = 0; q < (asked.first ? 3 : 1); ++q, at += of_quantity) evaluation_.quantities[q] = at;
    if (asked.normals) evaluation_.normals = at;
    scratch_.emplace(device, evaluator_.num_scratch_bytes(evaluation_));
    evaluation_.scratch = scratch_->address();
    evaluator_.prepare(evaluation_);
  }
  void record(const GpuCommands& commands) const { evaluator_.record(commands, evaluation_); }
  /// After what was recorded before: streams of CUDA run one launch after the other.
  void record_next(const GpuCommands& commands) const {
    void* const handle = commands.handle();
    if (device_.info().api == GpuApi::cuda)
      evaluator_.record(static_cast<CUstream_st*>(handle), evaluation_);
    else
      evaluator_.record(static_cast<VkCommandBuffer_T*>(handle), evaluation_);
  }
  /// Of one apply.
  double seconds() {
    if (count_ == 0) {
      count_ = 1;
      run();  // warms up
      count_ = int(std::clamp(seconds_of_submission / run(), 1.0, 2000.0));
    }
    return run() / count_;
  }
  double largest_difference(std::span<const float> right) {
    GpuCommands commands(device_);
    record(commands);
    commands.submit_and_wait();
    std::vector<float> made(right.size());
    results_.read(std::as_writable_bytes(std::span(made)));
    double largest = 0;
    for (size_t i = 0; i < made.size(); ++i) largest = std::max(largest, std::abs(double(made[i]) - right[i]));
    return largest;
  }

 private:
  double run() const {
    GpuCommands commands(device_);
    return bench::seconds([&] {
      for (int i = 0; i < count_; ++i) record_next(commands);
      commands.submit_and_wait();
    });
  }
  const GpuDevice& device_;
  GpuEvaluator evaluator_;
  GpuBuffer points_, results_;
  std::optional<GpuBuffer> scratch_;
  GpuEvaluation evaluation_;
  int count_ = 0;
};

/// The same points by rows alone.
PatternTable<float> by_rows(const PatternTable<float>& table) {
  PatternTable<float>::Arrays a;
  a.quantities = table.quantities();
  a.rest = table.expanded();
  return {table.num_control_points(), std::move(a)};
}

/// As many points of nothing: what it takes to write them.
PatternTable<float> of_nothing(const PatternTable<float>& table) {
  PatternTable<float>::Arrays a;
  a.quantities = table.quantities();
  a.blocks = {{64, 0, 0}};
  std::vector<std::int32_t> rows(64);
  for (std::int32_t i = 0; i < 64; ++i) rows[size_t(i)] = i;
  a.rows = std::move(rows);
  a.groups = {{0, 64, 0, std::max<std::int64_t>(1, table.num_points() / 64)}};
  return {table.num_control_points(), std::move(a)};
}

std::string short_name(const GpuInfo& info) { return std::string(name(info.api)) + " " + info.name; }

/// Seconds to copy a byte: it is read and written.
double measure_copies(Report& report, const GpuDevice& device) {
  const std::int64_t bytes =
      std::min<std::int64_t>(device.info().kind == GpuKind::cpu ? 1 << 28 : 1 << 30, device.info().memory / 8);
  const GpuBuffer from(device, bytes);
  GpuBuffer to(device, bytes);
  constexpr int count = 20;
  const auto turn = [&] {
    GpuCommands commands(device);
    for (int i = 0; i < count; ++i) commands.copy(from, to, bytes);
    return seconds([&] { commands.submit_and_wait(); }) / count / 2 / double(bytes);
  };
  turn();
  const double second = turn();
  report.measure({"copy", short_name(device.info()), "", 1, "ps/byte", 1e12}, {{"copy", Role::shown, turn}});
  return second;
}

void measure(Report& report, const Case& c, const Asked& asked, const GpuDevice& device, double second_of_byte) {
  const std::string detail = asked.name, mesh = c.name;
  if (asked.halves && !device.info().halves) return;
  if (!report.wants("device", mesh, detail) && !report.wants("host", mesh, detail)) return;
  Patterns patterns(find_scheme(c.scheme).value());
  const PatternTable<float> table = in_float(bake(patterns, c.mesh, asked.request).table.table);
  const std::vector<float> points(c.mesh.positions.data(), c.mesh.positions.data() + c.mesh.positions.size());
  const PatternEvaluator<float> cpu(table);
  Evaluation<float> e;
  e.points = points;
  const size_t of_quantity = size_t(table.num_points()) * 3, quantities = asked.first ? 3 : 1;
  std::vector<float> right(of_quantity * (quantities + asked.normals));
  for (size_t q = 0; q < quantities; ++q) e.quantities[q] = std::span(right).subspan(q * of_quantity, of_quantity);
  if (asked.normals) e.normals = std::span(right).last(of_quantity);
  cpu.apply(e);

  Resident ours(table, device, points, asked);
  const PatternTable<float> rows = by_rows(table);
  Resident peer(rows, device, points, asked);
  const PatternTable<float> nothing = of_nothing(table);
  Resident written(nothing, device, points, asked);
  const double difference = asked.halves ? 0 : std::max(ours.largest_difference(right), peer.largest_difference(right));
  if (!(difference < 1e-4)) {
    std::fprintf(stderr, "%s, %s on %s: points differ by %g from the CPU's\n", mesh.c_str(), detail.c_str(),
                 short_name(device.info()).c_str(), difference);
    std::exit(1);
  }
  const double time = ours.seconds(), bytes = asked.bytes_of_point() * double(table.num_points());
  std::printf(
      "%s, %s on %s: %lld points, %.1f MB; %.2f of the time to copy as many bytes as are written; differ by %.0e\n",
      mesh.c_str(), detail.c_str(), short_name(device.info()).c_str(), static_cast<long long>(table.num_points()),
      double(table.num_bytes()) / 1e6, time / (bytes * second_of_byte), difference);
  const double scale = 1e12 / double(table.num_points());
  report.measure({"device", mesh, detail + ", " + name(device.info().api), 1, "ps", scale},
                 {{"ours", Role::ours, [&] { return ours.seconds(); }},
                  {"row by row", Role::peer, [&] { return peer.seconds(); }},
                  {"zeros", Role::shown, [&] { return written.seconds(); }}});
  if (asked.halves) return;
  const GpuEvaluator evaluator(table, device);
  report.measure({"host", mesh, detail + ", " + name(device.info().api), 1, "ps", scale},
                 {{"ours", Role::ours, [&] { return seconds([&] { evaluator.apply(e); }); }},
                  {"the CPU", Role::peer, [&] { return seconds([&] { cpu.apply(e); }); }}});
}

/// Tables of their own, as if each had another topology.
void measure_many(Report& report, const GpuDevice& device) {
  if (!report.wants("many")) return;
  const int tables = report.quick() ? 20 : 1000;
  const Case character{"characters", "catmull-clark", testing::torus(25, 20)};
  Patterns patterns(find_scheme(character.scheme).value());
  const Asked asked{"level 2", {.rows = TableRows::level, .level = 2}};
  const PatternTable<float> table = in_float(bake(patterns, character.mesh, asked.request).table.table);
  const std::vector<float> points(character.mesh.positions.data(),
                                  character.mesh.positions.data() + character.mesh.positions.size());
  std::vector<std::unique_ptr<Resident>> all;
  for (int i = 0; i < tables; ++i) all.push_back(std::make_unique<Resident>(table, device, points, asked));
  std::vector<float> made(size_t(table.num_points()) * 3);
  const PatternEvaluator<float> cpu(table);
  report.measure({"many", std::to_string(tables) + " tables", "500 faces, " + std::string(name(device.info().api)), 1,
                  "ps", 1e12 / double(table.num_points()) / tables},
                 {{"recorded and run", Role::ours,
                   [&] {
                     return seconds([&] {
                       GpuCommands commands(device);
                       for (const auto& one : all) one->record(commands);
                       commands.submit_and_wait();
                     });
                   }},
                  {"run", Role::shown,
                   [&] {
                     GpuCommands commands(device);
                     for (const auto& one : all) one->record(commands);
                     return seconds([&] { commands.submit_and_wait(); });
                   }},
                  {"the CPU", Role::peer, [&] {
                     return seconds([&] {
                       for (int i = 0; i < tables; ++i) cpu.apply(points, 3, made);
                     });
                   }}});
}

int main(int argc, char** argv) {
  Report report("gpu_bench", argc, argv);
  if (report.turns() == 0) report.take_turns(1);
  std::optional<size_t> only;
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string(argv[i]) == "--device") only = size_t(std::max(0, std::atoi(argv[i + 1])));
  std::string missing;
  const std::vector<GpuInfo> devices = gpu_devices(&missing);
  if (devices.empty()) std::fprintf(stderr, "NO GPU: nothing is measured: %s\n", missing.c_str());
  std::vector<Case> meshes = cases(report.quick());
  for (const char* name : {"bishop", "righthanded"}) {
    const auto path = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / ("catmark_" + std::string(name) + ".obj");
    if (std::filesystem::exists(path)) meshes.push_back({name, "catmull-clark", read_mesh(path)});
  }
  for (size_t number = 0; number < devices.size(); ++number) {
    if (only && *only != number) continue;
    const GpuDevice device{int(number)};
    std::printf("%s, %s, %.1f GB\n", short_name(device.info()).c_str(), device.info().driver.c_str(),
                double(device.info().memory) / 1e9);
    const double second_of_byte = measure_copies(report, device);
    const int level = device.info().kind == GpuKind::cpu || report.quick() ? 2 : 3;
    const std::string of_level = "level " + std::to_string(level);
    const BakeRequest points{.rows = TableRows::level, .level = level},
        limits{.rows = TableRows::limit, .level = level, .derivatives = 1};
    for (const Case& c : meshes)
      for (const Asked& asked :
           {Asked{of_level, points}, Asked{of_level + ", half", points, false, false, true},
            Asked{of_level + ", normals", limits, false, true}, Asked{of_level + ", D1", limits, true}})
        measure(report, c, asked, device, second_of_byte);
    measure_many(report, device);
  }
  return report.finish();
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
