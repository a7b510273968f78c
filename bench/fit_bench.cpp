// SPDX-License-Identifier: Apache-2.0
// Linear systems of fitting, solved by us and by Eigen's solvers in one run: from the rows to the solution.
//   points    LeastSquaresConjugateGradient, SparseLU of C, SimplicialLLT of C C^T
//   normals   LeastSquaresConjugateGradient without preconditioner (least change), SimplicialLLT of C C^T
//   fairness  SimplicialLDLT and SparseLU of [H, C^T; C, -1e-9]
//   places    LeastSquaresConjugateGradient, ConjugateGradient and SimplicialLLT of A^T A
// Eigen's SparseQR is left out: on a tenth of these sizes it takes longer than all the others here together.
// Of every solution the largest residual is printed: |C x - d|, without conditions of A^T (A x - b). Eigen's iterations
// stop at 1e-14. Memory is what the process holds at most meanwhile, above what it held before.
//
// `fit_bench --ratios [turns]` takes turns (report.h); `--only "fit normals"` takes one system. Otherwise Google
// Benchmark's own options hold.
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cstdio>

#include "fit_systems.h"
#include "measuring.h"
#include "bench_report.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/conditioning.h"

namespace sublimit::bench {
namespace {

using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

struct Solver {
  const char* name;
  std::function<Points()> run;
};

template <class Factors>
Points factored(const Columns& M, const Points& right) {
  Factors solver(M);
  if (solver.info() != Eigen::Success) return Points::Constant(right.rows(), right.cols(), NAN);
  const Eigen::MatrixXd x = solver.solve(Eigen::MatrixXd(right));
  return x;
}

template <class Iteration>
Points iterated(const SparseMatrix& M, const Points& right) {
  Iteration solver(M);
  solver.setTolerance(1e-14);
  solver.setMaxIterations(2000);
  const Eigen::MatrixXd x = solver.solve(Eigen::MatrixXd(right));
  return x;
}

/// C x = d, the x nearest to x0, by C C^T.
Points least_change(const FitProblem& p) {
  const SparseMatrix Ct = p.C.transpose();
  const Points gap = p.d - apply(p.C, p.x0);
  return p.x0 + apply(Ct, factored<Eigen::SimplicialLLT<Columns>>(Columns(product(p.C, Ct)), gap));
}

/// [H, C^T; C, -1e-9]: indefinite but for the last, small block, as factors without pivots need it.
Columns saddle(const FitProblem& p) {
  const Index n = Index(p.C.cols());
  std::vector<Eigen::Triplet<double>> entries;
  for (Index r = 0; r < n; ++r)
    for (SparseMatrix::InnerIterator e(p.H, r); e; ++e) entries.emplace_back(r, e.col(), e.value());
  for (Index r = 0; r < p.C.rows(); ++r) {
    entries.emplace_back(n + r, n + r, -1e-9);
    for (SparseMatrix::InnerIterator e(p.C, r); e; ++e) {
      entries.emplace_back(n + r, e.col(), e.value());
      entries.emplace_back(e.col(), n + r, e.value());
    }
  }
  Columns K(n + p.C.rows(), n + p.C.rows());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

template <class Factors>
Points by_saddle(const FitProblem& p) {
  Points right = Points::Zero(p.C.cols() + p.C.rows(), p.d.cols());
  right.bottomRows(p.C.rows()) = p.d;
  return factored<Factors>(saddle(p), right).topRows(p.C.cols());
}

std::vector<Solver> peers(const std::string& name, const FitProblem& p) {
  using Eigen::IdentityPreconditioner;
  if (name == "points")
    return {{"LSCG", [&] { return iterated<Eigen::LeastSquaresConjugateGradient<SparseMatrix>>(p.C, p.d); }},
            {"SparseLU", [&] { return factored<Eigen::SparseLU<Columns>>(Columns(p.C), p.d); }},
            {"LLT", [&] { return least_change(p); }}};
  if (name == "normals")
    return {
        {"LSCG",
         [&] {
           return Points(p.x0 + iterated<Eigen::LeastSquaresConjugateGradient<SparseMatrix, IdentityPreconditioner>>(
                                    p.C, Points(p.d - apply(p.C, p.x0))));
         }},
        {"LLT", [&] { return least_change(p); }}};
  if (name == "fairness")
    return {{"LDLT", [&] { return by_saddle<Eigen::SimplicialLDLT<Columns>>(p); }},
            {"SparseLU", [&] { return by_saddle<Eigen::SparseLU<Columns>>(p); }}};
  const auto normal = [&] {
    const SparseMatrix At = p.A.transpose();
    return std::pair(product(At, p.A), apply(At, p.b));
  };
  return {{"LSCG", [&] { return iterated<Eigen::LeastSquaresConjugateGradient<SparseMatrix>>(p.A, p.b); }},
          {"CG",
           [normal] {
             const auto [M, right] = normal();
             return iterated<Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper>>(M, right);
           }},
          {"LLT", [normal] {
             const auto [M, right] = normal();
             return factored<Eigen::SimplicialLLT<Columns>>(Columns(M), right);
           }}};
}

double residual(const FitProblem& p, const Points& x) {
  if (p.C.rows() > 0) return (apply(p.C, x) - p.d).cwiseAbs().maxCoeff();
  return (p.A.transpose() * (p.A * x - p.b)).cwiseAbs().maxCoeff();
}

/// Of 100,000 vertices.
std::vector<FitSystem> systems(bool quick) { return fit_systems(quick ? 1000 : 100000); }

Points ours(const FitProblem& p, FitMethod method) { return solve(p, {.method = method}).x; }

/// What a solver needed besides time.
struct Needed {
  double memory = 0, residual = 0;
};

void measure(Report& report, const FitSystem& system, const FitProblem& p, int threads,
             const std::vector<std::pair<Role, Solver>>& solvers) {
  std::vector<Needed> needed(solvers.size());
  std::vector<Contender> contenders;
  for (size_t i = 0; i < solvers.size(); ++i)
    contenders.push_back({solvers[i].second.name, solvers[i].first, [&, i] {
                            const double before = forget_peak_bytes();
                            Points x;
                            const double time = seconds([&] { x = solvers[i].second.run(); });
                            needed[i] = {std::max(needed[i].memory, peak_bytes() - before), residual(p, x)};
                            return time;
                          }});
  report.measure({"fit", system.name, std::to_string(p.x0.rows()) + " unknowns", threads, "s", 1}, contenders);
  for (size_t i = 0; i < solvers.size(); ++i)
    std::printf("    %-10s residual %.0e  %5.0f MB\n", contenders[i].name.c_str(), needed[i].residual,
                needed[i].memory / 1e6);
}

int take_turns(Report& report) {
  for (const FitSystem& system : systems(report.quick())) {
    if (!report.wants("fit", system.name)) continue;
    const FitProblem p = system.make();
    std::printf("%s: %s; %d unknowns in %d channels, %d conditions, %d targets\n", system.name.c_str(),
                system.what.c_str(), int(p.x0.rows()), int(p.x0.cols()), int(p.C.rows()), int(p.A.rows()));
    for (const int threads : report.threads()) {
      const Threads scope(threads);
      std::vector<std::pair<Role, Solver>> solvers{
          {Role::ours, {"automatic", [&] { return ours(p, FitMethod::automatic); }}},
          {Role::shown, {"direct", [&] { return ours(p, FitMethod::direct); }}}};
      if (system.name != "fairness")
        solvers.push_back({Role::shown, {"iterative", [&] { return ours(p, FitMethod::iterative); }}});
      if (threads == 1)  // they use one
        for (const Solver& peer : peers(system.name, p)) solvers.push_back({Role::peer, peer});
      measure(report, system, p, threads, solvers);
      if (system.name != "points") continue;
      Conditioning c;
      const double time = seconds([&] { c = conditioning(p.C); });
      std::printf("    conditioning %.2f s: rank %d of %d, %.6f .. %.6f\n", time, c.rank, c.columns, c.smallest,
                  c.largest);
    }
  }
  return report.finish();
}

int main(int argc, char** argv) {
  Report report("fit_bench", argc, argv);
  if (report.turns()) return take_turns(report);
  std::vector<FitProblem> problems;
  const std::vector<FitSystem> list = systems(report.quick());
  problems.reserve(list.size());
  for (const FitSystem& system : list) {
    const FitProblem& p = problems.emplace_back(system.make());
    for (const int threads : thread_counts())
      benchmark::RegisterBenchmark(("BM_Fit/" + system.name + "/threads:" + std::to_string(threads)).c_str(),
                                   [&p, threads](benchmark::State& state) {
                                     const Threads scope(threads);
                                     for (auto _ : state) benchmark::DoNotOptimize(ours(p, FitMethod::automatic));
                                     state.SetItemsProcessed(state.iterations() * p.x0.rows());
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
  }
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
