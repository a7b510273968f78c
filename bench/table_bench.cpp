// SPDX-License-Identifier: Apache-2.0
// Tables of level k, made and applied, against OpenSubdiv's in one run. In float, x y z interleaved, uniform levels.
//   bake    mesh in memory to table ready to apply, with an empty dictionary of types and with one that knows them all
//           | Create + RefineUniform + StencilTableFactory::Create
//   apply   | Osd::CpuEvaluator, Far::StencilTable::UpdateValues, Eigen's row-major sparse product of the same table;
//           ranges of stencils over the threads
//   ceil    on the torus | a loop that knows the grid and needs no table: what can be had at most
//   grid    8 x 8 places on each address of the limit with both first derivatives, applied
//           | LimitStencilTable by Osd::CpuEvaluator and by Far's loop; Bfr, Far's patches and Embree (float), prepared
// The limit of `apply` is the time to write the points at the bandwidth of one thread; of OpenSubdiv's bake one thread
// is all that it uses. What both make is compared point by point before anything is timed.
//
// `table_bench --ratios [turns]` takes turns (report.h); `--only "apply car"` takes one row. Otherwise Google
// Benchmark's own options hold.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>

#include "bench_meshes.h"
#include "bench_report.h"
#include "bicubic_torus.h"
#include "limit_peers.h"
#include "measuring.h"
#include "opensubdiv_table.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit::bench {
namespace {

/// A table ready to be applied.
struct OurTable {
  BakeStatistics statistics;
  PatternTable<float> table;
  std::optional<PatternEvaluator<float>> evaluator;
  OurTable(Patterns& patterns, const Mesh& mesh, int levels)
      : OurTable(patterns, mesh, BakeRequest{.rows = TableRows::level, .level = levels}) {}
  OurTable(Patterns& patterns, const Mesh& mesh, const BakeRequest& request) {
    const Baked baked = bake(patterns, mesh, request);
    statistics = baked.statistics;
    table = in_float(baked.table.table);
    evaluator.emplace(table);
  }
  OurTable(const OurTable&) = delete;
};

std::vector<float> control_points(const Case& c) {
  return {c.mesh.positions.data(), c.mesh.positions.data() + c.mesh.positions.size()};
}

/// Largest distance between the sorted coordinates x + 2 y + 3 z of both: orders differ.
double distance(const std::vector<float>& a, const std::vector<float>& b) {
  const auto sorted = [](const std::vector<float>& p) {
    std::vector<double> key;
    for (size_t i = 0; i + 2 < p.size(); i += 3) key.push_back(p[i] + 2.0 * p[i + 1] + 3.0 * p[i + 2]);
    std::sort(key.begin(), key.end());
    return key;
  };
  const std::vector<double> x = sorted(a), y = sorted(b);
  if (x.size() != y.size()) return INFINITY;
  double largest = 0;
  for (size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i] - y[i]));
  return largest;
}

std::function<double()> turn(const std::function<void()>& work) {
  return [work] { return seconds(work); };
}

void count(Report& report, const std::string& of, const BakeStatistics& statistics, double bytes) {
  report.count(of, "types", statistics.types);
  report.count(of, "groups", statistics.groups);
  report.count(of, "points", double(statistics.points));
  report.count(of, "weights", double(statistics.weights));
  report.count(of, "table bytes", bytes);
}

constexpr int grid = 8;

/// 8 x 8 places a face with first derivatives. Not for triangles, whose places the others arrange otherwise.
void measure_grids(Report& report, const Case& c) {
  if (c.scheme != "catmull-clark" || !report.wants("grid", c.name)) return;
  const PeerCase peer(c);
  Patterns patterns(find_scheme(c.scheme).value());
  const BakeRequest request{.rows = TableRows::grid, .grid = grid, .derivatives = 1};
  std::optional<OurTable> ours;
  std::optional<PeerLimitTable> theirs;
  const double our_bake = seconds([&] { ours.emplace(patterns, c.mesh, request); }),
               their_bake = seconds([&] { theirs.emplace(peer.mesh, grid); });
  const std::vector<float> points = control_points(c);
  std::vector<float> made(size_t(ours->table.num_points()) * 9), by_osd(theirs->num_points() * 9),
      by_far(by_osd.size());
  ours->evaluator->apply(points, 3, made);
  theirs->apply_osd(points, by_osd);
  double largest = INFINITY;
  if (made.size() == by_osd.size()) {
    largest = 0;
    for (size_t i = 0; i < made.size() / 3; ++i) largest = std::max(largest, double(std::abs(made[i] - by_osd[i])));
  }
  std::printf("%s %d x %d places: %d types, %lld points; %.2f MB : %.2f MB; made in %.0f : %.0f ms; differ by %.0e\n",
              c.name.c_str(), grid, grid, ours->statistics.types, static_cast<long long>(ours->statistics.points),
              double(ours->table.num_bytes()) / 1e6, double(theirs->num_bytes()) / 1e6, our_bake * 1e3,
              their_bake * 1e3, largest);
  std::vector<Place> places;
  for (Index f = 0; f < Index(made.size() / (9 * grid * grid)); ++f)
    for (int j = 0; j < grid; ++j)
      for (int i = 0; i < grid; ++i) places.push_back({f, double(i) / (grid - 1), double(j) / (grid - 1)});
  std::vector<std::unique_ptr<LimitEvaluator>> evaluators;
  for (const auto& make : {bfr_float, far_float, embree}) {
    evaluators.push_back(make(c));
    evaluators.back()->start();
    evaluators.back()->prepare();
    evaluators.back()->set_places(places);
  }
  count(report, "grid of " + c.name, ours->statistics, double(ours->table.num_bytes()));
  for (const int threads : report.threads()) {
    const Threads scope(threads);
    report.measure({"grid", c.name, "8 x 8, D1", threads, "ns", 1e9 / double(ours->table.num_points())},
                   {{"ours", Role::ours, turn([&] { ours->evaluator->apply(points, 3, made); })},
                    {"Osd", Role::peer, turn([&] { theirs->apply_osd(points, by_osd); })},
                    {"Far", Role::peer, turn([&] { theirs->apply_far(points, by_far); })},
                    {"Bfr", Role::peer, turn([&] { evaluators[0]->evaluate(1); })},
                    {"Far patches", Role::peer, turn([&] { evaluators[1]->evaluate(1); })},
                    {"Embree", Role::peer, turn([&] { evaluators[2]->evaluate(1); })}});
  }
}

std::vector<Case> all_cases(bool quick) {
  std::vector<Case> list = cases(quick);
  for (const char* name : {"catmark_bishop", "catmark_rook", "catmark_pawn", "catmark_righthanded"}) {
    const auto path = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / (std::string(name) + ".obj");
    if (std::filesystem::exists(path)) list.push_back({std::string(name).substr(8), "catmull-clark", read_mesh(path)});
  }
  return list;
}

int take_turns(Report& report) {
  const std::vector<Case> meshes = all_cases(report.quick());
  for (const Case& c : meshes) measure_grids(report, c);
  for (const Case& c : meshes)
    for (const int levels : {2, 3}) {
      const std::string detail = "level " + std::to_string(levels);
      const bool ceiling_too = c.name == "torus" && levels == 3 && !report.quick();
      if (!report.wants("bake", c.name, detail) && !report.wants("apply", c.name, detail) &&
          !(ceiling_too && report.wants("ceil", c.name, detail)))
        continue;
      const PeerCase peer(c);
      const Scheme<double> scheme = find_scheme(c.scheme).value();
      Patterns known(scheme);
      const OurTable ours(known, c.mesh, levels);
      const PeerTable theirs(peer.mesh, levels);
      const std::vector<float> points = control_points(c);
      std::vector<float> made(size_t(ours.table.num_points()) * 3), by_osd(theirs.num_points() * 3),
          by_far(by_osd.size()), by_eigen(by_osd.size());
      ours.evaluator->apply(points, 3, made);
      theirs.apply_osd(points, by_osd);
      theirs.apply_far(points, by_far);
      theirs.apply_eigen(points, by_eigen);
      std::printf(
          "%s level %d: %d faces, %d types, %d groups, %lld points; %.2f MB (and %.2f to apply) : %.2f MB; differ by "
          "%.0e, %.0e, %.0e\n",
          c.name.c_str(), levels, ours.statistics.faces, ours.statistics.types, ours.statistics.groups,
          static_cast<long long>(ours.statistics.points), double(ours.table.num_bytes()) / 1e6,
          double(ours.evaluator->num_bytes()) / 1e6, double(theirs.num_bytes()) / 1e6, distance(made, by_osd),
          distance(by_osd, by_far), distance(by_osd, by_eigen));
      count(report, "table of " + c.name + ", " + detail, ours.statistics, double(ours.table.num_bytes()));
      for (const int threads : report.threads()) {
        const Threads scope(threads);
        report.measure({"bake", c.name, detail, threads},
                       {{"empty", Role::ours,
                         turn([&] { const OurTable t(*std::make_unique<Patterns>(scheme), c.mesh, levels); })},
                        {"known", Role::ours, turn([&] { const OurTable t(known, c.mesh, levels); })},
                        {"OpenSubdiv", Role::peer, turn([&] { const PeerTable t(peer.mesh, levels); })}});
        const double ns_a_point = 1e9 / double(ours.table.num_points());
        const int turns = report.quick() ? 0 : std::max(report.turns(), 9);
        const Contender apply{"ours", Role::ours, turn([&] { ours.evaluator->apply(points, 3, made); })};
        report.measure({"apply", c.name, detail, threads, "ns", ns_a_point},
                       {apply,
                        {"Osd", Role::peer, turn([&] { theirs.apply_osd(points, by_osd); })},
                        {"Far", Role::peer, turn([&] { theirs.apply_far(points, by_far); })},
                        {"Eigen", Role::peer, turn([&] { theirs.apply_eigen(points, by_eigen); })}},
                       turns);
        if (!ceiling_too) continue;
        const BicubicTorus ceiling(400, 250);
        std::vector<float> by_loop(made.size());
        report.measure(
            {"ceil", c.name, detail, threads, "ns", ns_a_point},
            {apply, {"loop that knows the grid", Role::shown, turn([&] { ceiling.apply(points, by_loop); })}}, turns);
        std::printf("differ by %.0e\n", distance(made, by_loop));
      }
    }
  return report.finish();
}

int main(int argc, char** argv) {
  Report report("table_bench", argc, argv);
  if (report.turns()) return take_turns(report);
  register_write_bandwidth();
  const std::vector<Case> meshes = all_cases(report.quick());
  for (const Case& c : meshes)
    for (const int threads : thread_counts()) {
      const std::string of = "/" + c.name + "/level:3/threads:" + std::to_string(threads);
      benchmark::RegisterBenchmark(("BM_Bake" + of).c_str(),
                                   [&c, threads](benchmark::State& state) {
                                     const Threads scope(threads);
                                     for (auto _ : state) {
                                       Patterns patterns(find_scheme(c.scheme).value());
                                       const OurTable table(patterns, c.mesh, 3);
                                     }
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
      benchmark::RegisterBenchmark(("BM_Apply" + of).c_str(),
                                   [&c, threads](benchmark::State& state) {
                                     const Threads scope(threads);
                                     Patterns patterns(find_scheme(c.scheme).value());
                                     const OurTable ours(patterns, c.mesh, 3);
                                     const std::vector<float> points = control_points(c);
                                     std::vector<float> made(size_t(ours.table.num_points()) * 3);
                                     for (auto _ : state) ours.evaluator->apply(points, 3, made);
                                     state.SetItemsProcessed(state.iterations() * ours.table.num_points());
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
