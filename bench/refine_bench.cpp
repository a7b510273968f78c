// SPDX-License-Identifier: Apache-2.0
// Refinement against OpenSubdiv, in one run.
//   BM_RefineMesh    positions and faces of the last level       | Create + RefineUniform + PrimvarRefiner::Interpolate
//   BM_Refine        topology, S_k and positions of all levels   | Create + RefineUniform + PrimvarRefiner::Interpolate
//   BM_StencilTable  P_k, the levels given                       | StencilTableFactory::Create, the refiner given
//   BM_Baked         P_k from the control mesh                   | Create + RefineUniform + StencilTableFactory::Create
// OpenSubdiv uses one thread, always. Of its last level it makes the face vertices only, where we make all of the
// topology; BM_RefineWhole has it make all, too.
//
// `refine_bench --ratios [repetitions] [--keep-memory]` takes turns and prints medians with their spread and the
// ratios; otherwise Google Benchmark's own options hold. --keep-memory: freed memory stays with the process, so that
// the kernel's time for handing out pages is measured on neither side.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "bench_meshes.h"
#include "measuring.h"
#include "sublimit/core/sparse_product.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes.h"

namespace sublimit::bench {
namespace {

/// What a run made.
struct Made {
  double rows = 0, nonzeros = 0, bytes = 0;
};

struct Job {
  const Case& mesh;
  int levels;
  Scheme<double> scheme;
  PeerCase peer;
  std::vector<Level> ours_given;  // for BM_StencilTable
  std::unique_ptr<PeerRefiner> peer_given;
  std::unique_ptr<MeshRefiner> refiner_given;  // for BM_PointsAgain

  Job(const Case& c, int levels_, bool given)
      : mesh(c), levels(levels_), scheme(find_scheme(c.scheme).value()), peer(c) {
    if (!given) return;
    ours_given = refine(scheme, c.mesh, levels);
    peer_given = std::make_unique<PeerRefiner>(peer.mesh, levels);
    refiner_given = std::make_unique<MeshRefiner>(scheme, c.mesh, levels);
  }
};

Made made_of(const SparseMatrix& S) {
  const double rows = double(S.rows()), nonzeros = double(S.nonZeros());
  return {rows, nonzeros, 12 * nonzeros + 4 * rows};
}

Made ours_refined_mesh(const Job& job) {
  const ControlMesh refined = refined_mesh(job.scheme, job.mesh.mesh, job.levels);
  benchmark::DoNotOptimize(refined.positions.data());
  const double rows = double(refined.num_vertices()), corners = double(refined.face_vertices.size());
  return {rows, 0, 24 * rows + 4 * corners};
}
Made ours_again(const Job& job) {
  const Points points = job.refiner_given->points(job.mesh.mesh.positions);
  benchmark::DoNotOptimize(points.data());
  return {double(points.rows()), 0, 24.0 * double(points.rows())};
}
template <class Real>
Made theirs_again(const Job& job) {
  const Points& x = job.mesh.mesh.positions;
  const std::vector<Real> positions(x.data(), x.data() + x.size());
  const double rows = double(job.peer_given->refine(std::span<const Real>(positions)).vertices);
  return {rows, 0, 3 * sizeof(Real) * rows};
}
Made ours_refine(const Job& job) {
  const std::vector<Level> levels = refine(job.scheme, job.mesh.mesh, job.levels);
  std::vector<Points> positions;
  Made all;
  for (int k = 1; k <= job.levels; ++k) {
    positions.push_back(apply(levels[k].S, k == 1 ? job.mesh.mesh.positions : positions.back()));
    const Made made = made_of(levels[k].S);
    all = {all.rows + made.rows, all.nonzeros + made.nonzeros, all.bytes + made.bytes + 24 * made.rows};
  }
  benchmark::DoNotOptimize(positions.back().data());
  return all;
}
template <class Real, bool whole_last_level>
Made theirs_refine(const Job& job) {
  const Points& x = job.mesh.mesh.positions;
  const std::vector<Real> positions(x.data(), x.data() + x.size());
  const PeerRefiner refiner(job.peer.mesh, job.levels, whole_last_level);
  const double rows = double(refiner.refine(std::span<const Real>(positions)).vertices);
  return {rows, 0, 3 * sizeof(Real) * rows};
}

Made ours_stencils(const Job& job) { return made_of(refinement_matrix(job.ours_given)); }
Made ours_baked(const Job& job) { return made_of(refinement_matrix(refine(job.scheme, job.mesh.mesh, job.levels))); }
template <class Real>
Made theirs_stencils(const PeerRefiner& refiner) {
  const PeerStencils made = std::is_same_v<Real, float> ? refiner.stencils_float() : refiner.stencils_double();
  const double rows = double(made.stencils), nonzeros = double(made.weights);
  return {rows, nonzeros, (4 + sizeof(Real)) * nonzeros + 8 * rows};
}
template <class Real>
Made theirs_stencils(const Job& job) {
  return theirs_stencils<Real>(*job.peer_given);
}
Made theirs_baked(const Job& job) { return theirs_stencils<double>(PeerRefiner(job.peer.mesh, job.levels)); }

using Run = Made (*)(const Job&);
struct Measured {
  const char* name;
  bool given;  // levels or refiner, outside the clock
  Run ours, theirs, theirs_float;
};
constexpr Measured measured[] = {
    {"BM_RefineMesh", false, ours_refined_mesh, theirs_refine<double, false>, theirs_refine<float, false>},
    {"BM_PointsAgain", true, ours_again, theirs_again<double>, theirs_again<float>},
    {"BM_Refine", false, ours_refine, theirs_refine<double, false>, theirs_refine<float, false>},
    {"BM_RefineWhole", false, ours_refine, theirs_refine<double, true>, theirs_refine<float, true>},
    {"BM_StencilTable", true, ours_stencils, theirs_stencils<double>, theirs_stencils<float>},
    {"BM_Baked", false, ours_baked, theirs_baked, nullptr},
};

int print_ratios(int repetitions) {
  std::printf("write bandwidth, one thread: %.1f GB/s; medians of %d in ms, (least..most)\n", write_bandwidth() / 1e9,
              repetitions);
  std::printf("%-16s%-17s%3s %3s %27s %27s %10s %6s %7s\n", "", "mesh", "lev", "thr", "ours", "OpenSubdiv double",
              "float", "ratio", "Mrows/s");
  const std::vector<Case> meshes = cases();
  for (const int threads : thread_counts()) {
    const Threads scope(threads);
    for (const Measured& m : measured)
      for (const Case& c : meshes)
        for (const int levels : {2, 3}) {
          const Job job(c, levels, m.given);
          std::vector<double> times[3];
          Made made;
          for (int r = -1; r < repetitions; ++r)  // the first turn warms up
            for (int who = 0; who < 3; ++who) {
              const Run run = who == 0 ? m.ours : who == 1 ? m.theirs : m.theirs_float;
              if (!run) continue;
              Made result;
              const double ms = 1e3 * seconds([&] { result = run(job); });
              if (who == 0) made = result;
              if (r >= 0) times[who].push_back(ms);
            }
          for (auto& t : times) std::sort(t.begin(), t.end());
          const auto median = [&](int who) { return times[who].empty() ? 0 : times[who][times[who].size() / 2]; };
          std::printf("%-16s%-17s%3d %3d %9.1f (%7.1f..%7.1f) %9.1f (%7.1f..%7.1f) %10.1f %5.2fx %7.1f\n", m.name,
                      c.name.c_str(), levels, threads, median(0), times[0].front(), times[0].back(), median(1),
                      times[1].front(), times[1].back(), median(2), median(1) / median(0), made.rows / median(0) / 1e3);
          std::fflush(stdout);
        }
  }
  return 0;
}

void register_benchmarks(const std::vector<Case>& meshes) {
  register_write_bandwidth();
  for (const Measured& m : measured)
    for (const Case& c : meshes)
      for (const int levels : {2, 3})
        for (const auto& [who, run] : {std::pair("ours", m.ours), std::pair("opensubdiv", m.theirs),
                                       std::pair("opensubdiv_float", m.theirs_float)})
          for (const int threads : thread_counts()) {
            if (!run || (run != m.ours && threads > 1)) continue;
            const std::string name = std::string(m.name) + "/" + who + "/" + c.name +
                                     "/level:" + std::to_string(levels) + "/threads:" + std::to_string(threads);
            const auto work = [&c, levels, threads, given = m.given, run = run](benchmark::State& state) {
              const Threads scope(threads);
              const Job job(c, levels, given);
              Made made;
              for (auto _ : state) made = run(job);
              state.counters["rows"] = benchmark::Counter(made.rows, benchmark::Counter::kIsIterationInvariantRate);
              state.counters["nonzeros"] = made.nonzeros;
              state.counters["bytes"] = benchmark::Counter(made.bytes, benchmark::Counter::kIsIterationInvariantRate);
            };
            benchmark::RegisterBenchmark(name.c_str(), work)->Unit(benchmark::kMillisecond)->UseRealTime();
          }
}

int main(int argc, char** argv) {
  if (const int repetitions = repetitions_of_ratios(argc, argv)) return print_ratios(repetitions);
  const std::vector<Case> meshes = cases();
  register_benchmarks(meshes);
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
