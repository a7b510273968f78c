// SPDX-License-Identifier: Apache-2.0
// Every surface scheme, and OpenMesh's and CGAL's subdividers beside it where they have it, in one run: two levels of
// tori and of meshes with all valences, 10k and 20k vertices. Time over the vertices made, those of both levels
// together.
//   ours      from arrays, as Mesh: topology, S_k and positions of all levels
//   again     positions of all levels for other control points: the matrices are there
//   OpenMesh  from its own half-edge mesh, built before the clock starts, refined in place: only the last level is left
//   CGAL      likewise, a Surface_mesh
// Both use one thread, always. On one thread the processor's time is taken, on several that of the wall; freeing memory
// is left out for all. That all make the same points is what the tests prove. The limit is the time to write what ours
// keeps, at the bandwidth of one thread.
//
// `subdividers_bench --ratios [turns]` takes turns (report.h); otherwise Google Benchmark's own options hold. With
// --keep-memory the kernel's time for handing out pages is measured on no side.
#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench_report.h"
#include "measuring.h"
#include "meshes/irregular_meshes.h"
#include "meshes/meshes.h"
#include "peers/cgal_reference.h"
#include "peers/openmesh_reference.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::bench {
namespace {

constexpr int levels = 2;

struct Input {
  std::string name;
  int face_size;
  Mesh mesh;
};
std::vector<Input> inputs(bool quick) {
  using namespace testing;
  if (quick) return {{"torus", 4, torus(20, 10)}, {"torus", 3, triangle_torus(20, 10)}};
  return {{"torus", 4, torus(200, 100)},
          {"torus", 3, triangle_torus(100, 100)},
          {"irregular", 4, quads_from_triangles(flipped(triangle_torus(83, 40), 6640))},
          {"irregular", 3, flipped(triangle_torus(100, 100), 20000)}};
}

/// What is measured: a call to be made once; it returns the vertices of the last level. What it makes lives as long as
/// the function.
using Run = std::function<size_t()>;

size_t apply_all(const std::vector<Level>& refined, const Mesh& mesh, std::vector<Points>& positions) {
  for (int k = 1; k <= levels; ++k)
    positions.push_back(apply(refined[k].S, k == 1 ? mesh.positions : positions.back()));
  benchmark::DoNotOptimize(positions.back().data());
  return size_t(positions.back().rows());
}

struct Refined {
  std::vector<Level> levels;
  std::vector<Points> positions;
};
Run ours(const Scheme<double>& scheme, const Mesh& mesh) {
  return [scheme, &mesh, made = std::make_shared<Refined>()] {
    made->levels = refine(scheme, mesh, levels);
    return apply_all(made->levels, mesh, made->positions);
  };
}
Run again(const Scheme<double>& scheme, const Mesh& mesh) {
  const auto made = std::make_shared<Refined>(Refined{refine(scheme, mesh, levels), {}});
  return [&mesh, made] { return apply_all(made->levels, mesh, made->positions); };
}

struct Refiner {
  std::string name;
  int threads;
  std::function<Run()> prepare;  ///< empty: does not have the scheme

  double seconds(size_t vertices) const {
    const Run run = prepare();
    const Threads scope(threads);
    size_t made = 0;
    const auto work = [&] { made = run(); };
    const double time = timed(threads, work);
    if (made != vertices) throw std::logic_error(name + " makes another mesh");
    return time;
  }
};

/// A scheme on a mesh, and who refines it.
struct Job {
  std::string scheme, mesh;
  double vertices, bytes;  ///< of all levels made: bytes of what ours keeps of them
  size_t last;             ///< vertices of the last level
  std::vector<Refiner> refiners;
};

/// Refiners: ours on one thread and on all, again, and from `first_peer` on the others.
constexpr size_t first_peer = 3;

std::vector<Job> jobs(const std::vector<Input>& meshes) {
  std::vector<Job> list;
  for (const Scheme<double>& scheme : all_schemes())
    for (const Input& input : meshes) {
      if (input.face_size != (scheme.face_size() == 3 ? 3 : 4)) continue;
      const Mesh& mesh = input.mesh;
      Job job{scheme.name, input.name, 0, 0, 0, {}};
      const std::vector<Level> refined = refine(scheme, mesh, levels);
      for (int k = 1; k <= levels; ++k) job.vertices += double(refined[k].topology().num_vertices());
      job.last = size_t(refined[levels].topology().num_vertices());
      job.bytes =
          predicted_bytes(scheme, refined[0].topology(), levels) - predicted_bytes(scheme, refined[0].topology(), 0);
      const int all_threads = thread_counts().back();
      job.refiners = {{"ours", 1, [scheme, &mesh] { return ours(scheme, mesh); }},
                      {"ours", all_threads, [scheme, &mesh] { return ours(scheme, mesh); }},
                      {"again", 1, [scheme, &mesh] { return again(scheme, mesh); }},
                      {"OpenMesh", 1, {}},
                      {"CGAL", 1, {}}};
      if (const auto peer = testing::openmesh_scheme(scheme.name))
        job.refiners[first_peer].prepare = [peer, &mesh] { return testing::openmesh_run(mesh, *peer, levels); };
      if (const auto peer = testing::cgal_scheme(scheme.name))
        job.refiners[first_peer + 1].prepare = [peer, &mesh] { return testing::cgal_run(mesh, *peer, levels); };
      list.push_back(job);
    }
  return list;
}

int take_turns(Report& report) {
  const std::vector<Input> meshes = inputs(report.quick());
  for (const Job& job : jobs(meshes)) {
    std::vector<Contender> contenders;
    for (size_t i = 0; i < job.refiners.size(); ++i) {
      const Refiner& refiner = job.refiners[i];
      if (!refiner.prepare) continue;
      contenders.push_back({refiner.threads == 1 ? refiner.name : refiner.name + ", all threads",
                            i == 0           ? Role::ours
                            : i < first_peer ? Role::shown
                                             : Role::peer,
                            [&] { return refiner.seconds(job.last); }});
    }
    report.measure({"subdivide", job.mesh, job.scheme, 1, "ns", 1e9 / job.vertices}, contenders);
    report.count(job.scheme + " of " + job.mesh, "bytes kept", job.bytes);
  }
  return report.finish();
}

void register_benchmarks(const std::vector<Job>& all) {
  register_write_bandwidth();
  for (const Job& job : all)
    for (const Refiner& refiner : job.refiners) {
      if (!refiner.prepare) continue;
      const std::string name = "BM_Subdivide/" + refiner.name + "/" + job.scheme + "/" + job.mesh +
                               "/threads:" + std::to_string(refiner.threads);
      const auto work = [&job, &refiner](benchmark::State& state) {
        for (auto _ : state) state.SetIterationTime(refiner.seconds(job.last));
        state.counters["vertices"] = benchmark::Counter(job.vertices, benchmark::Counter::kIsIterationInvariantRate);
      };
      benchmark::RegisterBenchmark(name.c_str(), work)->Unit(benchmark::kMillisecond)->UseManualTime();
    }
}

int main(int argc, char** argv) {
  Report report("subdividers_bench", argc, argv);
  if (report.turns()) return take_turns(report);
  const std::vector<Input> meshes = inputs(report.quick());
  const std::vector<Job> all = jobs(meshes);
  register_benchmarks(all);
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
