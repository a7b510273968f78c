// SPDX-License-Identifier: Apache-2.0
// Every surface scheme, and OpenMesh's and CGAL's subdividers beside it where they have it, in one run: two levels of
// tori and of meshes with all valences, 10k and 20k vertices. Time over the vertices made, those of both levels
// together.
//   ours      from arrays, as ControlMesh: topology, S_k and positions of all levels
//   again     positions of all levels for other control points: the matrices are there
//   OpenMesh  from its own half-edge mesh, built before the clock starts, refined in place: only the last level is left
//   CGAL      likewise, a Surface_mesh
// Both use one thread, always. On one thread the processor's time is taken, on several that of the wall; freeing memory
// is left out for all. That all make the same points is what the tests prove. The limit is the time to write what ours
// keeps, at the bandwidth of one thread.
//
// `subdividers_bench --ratios [repetitions] [--keep-memory]` takes turns and prints medians with their spread and the
// ratios; otherwise Google Benchmark's own options hold. --keep-memory: freed memory stays with the process, so that
// the kernel's time for handing out pages is measured on no side.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "measuring.h"
#include "sublimit/core/sparse_product.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes.h"
#include "support/cgal_reference.h"
#include "support/irregular_meshes.h"
#include "support/meshes.h"
#include "support/openmesh_reference.h"

namespace sublimit::bench {
namespace {

constexpr int levels = 2;

struct Input {
  std::string name;
  int face_size;
  ControlMesh mesh;
};
std::vector<Input> inputs() {
  using namespace testing;
  return {{"torus", 4, torus(200, 100)},
          {"torus", 3, triangle_torus(100, 100)},
          {"irregular", 4, quads_from_triangles(flipped(triangle_torus(83, 40), 6640))},
          {"irregular", 3, flipped(triangle_torus(100, 100), 20000)}};
}

/// What is measured: a call to be made once; it returns the vertices of the last level. What it makes lives as long as
/// the function.
using Run = std::function<size_t()>;

size_t apply_all(const std::vector<Level>& refined, const ControlMesh& mesh, std::vector<Points>& positions) {
  for (int k = 1; k <= levels; ++k)
    positions.push_back(apply(refined[k].S, k == 1 ? mesh.positions : positions.back()));
  benchmark::DoNotOptimize(positions.back().data());
  return size_t(positions.back().rows());
}

struct Refined {
  std::vector<Level> levels;
  std::vector<Points> positions;
};
Run ours(const Scheme<double>& scheme, const ControlMesh& mesh) {
  return [scheme, &mesh, made = std::make_shared<Refined>()] {
    made->levels = refine(scheme, mesh, levels);
    return apply_all(made->levels, mesh, made->positions);
  };
}
Run again(const Scheme<double>& scheme, const ControlMesh& mesh) {
  const auto made = std::make_shared<Refined>(Refined{refine(scheme, mesh, levels), {}});
  return [&mesh, made] { return apply_all(made->levels, mesh, made->positions); };
}

struct Contender {
  std::string name;
  int threads;
  std::function<Run()> prepare;  ///< empty: does not have the scheme

  double seconds(size_t vertices) const {
    const Run run = prepare();
    const Threads scope(threads);
    size_t made = 0;
    const auto work = [&] { made = run(); };
    const double time = threads == 1 ? cpu_seconds(work) : bench::seconds(work);
    if (made != vertices) throw std::logic_error(name + " makes another mesh");
    return time;
  }
};

/// A scheme on a mesh, and who refines it.
struct Job {
  std::string scheme, mesh;
  double vertices, bytes;  ///< of all levels made: bytes of what ours keeps of them
  size_t last;             ///< vertices of the last level
  std::vector<Contender> contenders;
};

/// Contenders: ours on one thread and on all, again, and from `first_peer` on the others.
constexpr size_t first_peer = 3;

std::vector<Job> jobs(const std::vector<Input>& meshes) {
  std::vector<Job> list;
  for (const Scheme<double>& scheme : all_schemes())
    for (const Input& input : meshes) {
      if (input.face_size != (scheme.face_size() == 3 ? 3 : 4)) continue;
      const ControlMesh& mesh = input.mesh;
      Job job{scheme.name, input.name, 0, 0, 0, {}};
      const std::vector<Level> refined = refine(scheme, mesh, levels);
      for (int k = 1; k <= levels; ++k) job.vertices += double(refined[k].topology().num_vertices());
      job.last = size_t(refined[levels].topology().num_vertices());
      job.bytes =
          predicted_bytes(scheme, refined[0].topology(), levels) - predicted_bytes(scheme, refined[0].topology(), 0);
      const int all_threads = thread_counts().back();
      job.contenders = {{"ours", 1, [scheme, &mesh] { return ours(scheme, mesh); }},
                        {"ours", all_threads, [scheme, &mesh] { return ours(scheme, mesh); }},
                        {"again", 1, [scheme, &mesh] { return again(scheme, mesh); }},
                        {"OpenMesh", 1, {}},
                        {"CGAL", 1, {}}};
      if (const auto peer = testing::openmesh_scheme(scheme.name))
        job.contenders[first_peer].prepare = [peer, &mesh] { return testing::openmesh_run(mesh, *peer, levels); };
      if (const auto peer = testing::cgal_scheme(scheme.name))
        job.contenders[first_peer + 1].prepare = [peer, &mesh] { return testing::cgal_run(mesh, *peer, levels); };
      list.push_back(job);
    }
  return list;
}

int print_ratios(int repetitions) {
  const double bandwidth = write_bandwidth();
  std::printf("write bandwidth, one thread: %.1f GB/s; medians of %d in ns a vertex made, (least..most)\n",
              bandwidth / 1e9, repetitions);
#ifndef NDEBUG
  std::printf("assertions are on: these are not the figures of a release build\n");
#endif
  const std::vector<Input> meshes = inputs();
  const std::vector<Job> all = jobs(meshes);
  std::printf("%-22s%-10s%9s%7s  ", "", "mesh", "vertices", "limit");
  for (const Contender& c : all.front().contenders)
    std::printf("%-20s",
                (c.name + ", " + std::to_string(c.threads) + (c.threads == 1 ? " thread" : " threads")).c_str());
  std::printf("best peer : ours, 1 thread\n");
  for (const Job& job : all) {
    std::vector<std::vector<double>> times(job.contenders.size());
    for (int r = -1; r < repetitions; ++r)  // the first turn warms up
      for (size_t i = 0; i < times.size(); ++i) {
        if (!job.contenders[i].prepare) continue;
        const double time = job.contenders[i].seconds(job.last);
        if (r >= 0) times[i].push_back(1e9 * time / job.vertices);
      }
    std::printf("%-22s%-10s%9.0f%7.1f  ", job.scheme.c_str(), job.mesh.c_str(), job.vertices,
                1e9 * job.bytes / bandwidth / job.vertices);
    double best_peer = 0;
    for (size_t i = 0; i < times.size(); ++i) {
      std::vector<double>& t = times[i];
      std::sort(t.begin(), t.end());
      char text[64] = "";
      if (!t.empty()) std::snprintf(text, sizeof text, "%5.0f (%.0f..%.0f)", t[t.size() / 2], t.front(), t.back());
      std::printf("%-20s", text);
      if (i < first_peer || t.empty()) continue;
      best_peer = best_peer == 0 ? t[t.size() / 2] : std::min(best_peer, t[t.size() / 2]);
    }
    if (best_peer > 0) std::printf("%.2f", best_peer / times[0][times[0].size() / 2]);
    std::printf("\n");
    std::fflush(stdout);
  }
  return 0;
}

void register_benchmarks(const std::vector<Job>& all) {
  register_write_bandwidth();
  for (const Job& job : all)
    for (const Contender& contender : job.contenders) {
      if (!contender.prepare) continue;
      const std::string name = "BM_Subdivide/" + contender.name + "/" + job.scheme + "/" + job.mesh +
                               "/threads:" + std::to_string(contender.threads);
      const auto work = [&job, &contender](benchmark::State& state) {
        for (auto _ : state) state.SetIterationTime(contender.seconds(job.last));
        state.counters["vertices"] = benchmark::Counter(job.vertices, benchmark::Counter::kIsIterationInvariantRate);
      };
      benchmark::RegisterBenchmark(name.c_str(), work)->Unit(benchmark::kMillisecond)->UseManualTime();
    }
}

int main(int argc, char** argv) {
  if (const int repetitions = repetitions_of_ratios(argc, argv)) return print_ratios(repetitions);
  const std::vector<Input> meshes = inputs();
  const std::vector<Job> all = jobs(meshes);
  register_benchmarks(all);
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
