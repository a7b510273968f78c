// SPDX-License-Identifier: Apache-2.0
// Refinement against OpenSubdiv, in one run.
//   BM_RefineMesh    positions and faces of the last level       | Create + RefineUniform + PrimvarRefiner::Interpolate
//   BM_Refine        topology, S_k and positions of all levels   | Create + RefineUniform + PrimvarRefiner::Interpolate
//   BM_StencilTable  P_k, the levels given                       | StencilTableFactory::Create, the refiner given
//   BM_Baked         P_k from the control mesh                   | Create + RefineUniform + StencilTableFactory::Create
// OpenSubdiv uses one thread, always. Of its last level it makes the face vertices only, where we make all of the
// topology; BM_RefineWhole has it make all, too.
//
// `refine_bench --ratios [turns]` takes turns (report.h); otherwise Google Benchmark's own options hold. With
// --keep-memory the kernel's time for handing out pages is measured on neither side.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "bench_meshes.h"
#include "measuring.h"
#include "bench_report.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/schemes.h"

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
  std::unique_ptr<Refiner> refiner_given;  // for BM_PointsAgain

  Job(const Case& c, int levels_, bool given)
      : mesh(c), levels(levels_), scheme(find_scheme(c.scheme).value()), peer(c) {
    if (!given) return;
    ours_given = refine(scheme, c.mesh, levels);
    peer_given = std::make_unique<PeerRefiner>(peer.mesh, levels);
    refiner_given = std::make_unique<Refiner>(scheme, c.mesh, levels);
  }
};

Made made_of(const SparseMatrix& S) {
  const double rows = double(S.rows()), nonzeros = double(S.nonZeros());
  return {rows, nonzeros, 12 * nonzeros + 4 * rows};
}

Made ours_refined_mesh(const Job& job) {
  const Mesh refined = refined_mesh(job.scheme, job.mesh.mesh, job.levels);
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

int take_turns(Report& report) {
  const std::vector<Case> meshes = cases(report.quick());
  for (const int threads : report.threads()) {
    const Threads scope(threads);
    for (const Measured& m : measured)
      for (const Case& c : meshes)
        for (const int levels : {2, 3}) {
          const std::string detail = "level " + std::to_string(levels);
          if (!report.wants(m.name, c.name, detail)) continue;
          const Job job(c, levels, m.given);
          Made made;
          const auto turn = [&](Run run) { return [&job, &made, run] { return seconds([&] { made = run(job); }); }; };
          std::vector<Contender> contenders{{"ours", Role::ours, turn(m.ours)},
                                            {"OpenSubdiv", Role::peer, turn(m.theirs)}};
          if (m.theirs_float) contenders.push_back({"OpenSubdiv float", Role::shown, turn(m.theirs_float)});
          report.measure({m.name, c.name, detail, threads}, contenders);
          made = m.ours(job);
          const std::string of = std::string(m.name) + " of " + c.name + ", " + detail;
          report.count(of, "rows", made.rows);
          if (made.nonzeros > 0) report.count(of, "matrix entries", made.nonzeros);
        }
  }
  return report.finish();
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
  Report report("refine_bench", argc, argv);
  if (report.turns()) return take_turns(report);
  const std::vector<Case> meshes = cases();
  register_benchmarks(meshes);
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
