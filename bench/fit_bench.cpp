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
// `fit_bench --ratios [repetitions]` takes turns and prints medians with their spread; SUBLIMIT_BENCH_CASE=NAME takes
// one system, SUBLIMIT_BENCH_VERTICES another size than 100000. Otherwise Google Benchmark's own options hold.
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "fit_systems.h"
#include "measuring.h"
#include "sublimit/core/sparse_product.h"
#include "sublimit/fit/conditioning.h"

namespace sublimit::bench {
namespace {

using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

struct Contender {
  const char* name;
  std::function<Points()> run;
};

template <class Solver>
Points factored(const Columns& M, const Points& right) {
  Solver solver(M);
  if (solver.info() != Eigen::Success) return Points::Constant(right.rows(), right.cols(), NAN);
  const Eigen::MatrixXd x = solver.solve(Eigen::MatrixXd(right));
  return x;
}

template <class Solver>
Points iterated(const SparseMatrix& M, const Points& right) {
  Solver solver(M);
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

template <class Solver>
Points by_saddle(const FitProblem& p) {
  Points right = Points::Zero(p.C.cols() + p.C.rows(), p.d.cols());
  right.bottomRows(p.C.rows()) = p.d;
  return factored<Solver>(saddle(p), right).topRows(p.C.cols());
}

std::vector<Contender> peers(const std::string& name, const FitProblem& p) {
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

/// Bytes that the process held at most since the last call of `forget_peak`.
double peak() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::atof(line.c_str() + 6);
  return 0;
}
double forget_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
  return peak();
}

std::vector<FitSystem> systems() {
  const char *only = std::getenv("SUBLIMIT_BENCH_CASE"), *size = std::getenv("SUBLIMIT_BENCH_VERTICES");
  std::vector<FitSystem> list = fit_systems(size ? std::atoi(size) : 100000);
  if (only) std::erase_if(list, [&](const FitSystem& s) { return s.name != only; });
  return list;
}

Points ours(const FitProblem& p, FitMethod method) { return solve(p, {.method = method}).x; }

void print_turns(const std::string& name, const std::vector<Contender>& contenders, const FitProblem& p, int threads,
                 int repetitions) {
  for (const Contender& c : contenders) {
    std::vector<double> times;
    double memory = 0, error = 0;
    for (int r = 0; r < repetitions; ++r) {
      const double before = forget_peak();
      Points x;
      times.push_back(seconds([&] { x = c.run(); }));
      memory = std::max(memory, peak() - before);
      error = residual(p, x);
    }
    std::sort(times.begin(), times.end());
    std::printf("%-9s %d  %-10s %7.2f s (%.2f..%.2f)  residual %.0e  %5.0f MB\n", name.c_str(), threads, c.name,
                times[times.size() / 2], times.front(), times.back(), error, memory / 1e6);
    std::fflush(stdout);
  }
}

int print_ratios(int repetitions) {
  for (const FitSystem& system : systems()) {
    const FitProblem p = system.make();
    std::printf("%s: %s; %d unknowns in %d channels, %d conditions, %d targets; medians of %d (least..most)\n",
                system.name.c_str(), system.what.c_str(), int(p.x0.rows()), int(p.x0.cols()), int(p.C.rows()),
                int(p.A.rows()), repetitions);
    std::vector<int> counts = thread_counts();
    if (counts.back() > 2) counts.insert(counts.begin() + 1, 2);
    for (const int threads : counts) {
      const Threads scope(threads);
      std::vector<Contender> contenders = {{"automatic", [&] { return ours(p, FitMethod::automatic); }},
                                           {"direct", [&] { return ours(p, FitMethod::direct); }}};
      if (system.name != "fairness") contenders.push_back({"iterative", [&] { return ours(p, FitMethod::iterative); }});
      print_turns(system.name, contenders, p, threads, repetitions);
      if (threads == 1) print_turns(system.name, peers(system.name, p), p, threads, repetitions);  // they use one
      if (system.name != "points") continue;
      Conditioning c;
      const double time = seconds([&] { c = conditioning(p.C); });
      std::printf("%-9s %d  conditioning %.2f s: rank %d of %d, %.6f .. %.6f\n", system.name.c_str(), threads, time,
                  c.rank, c.columns, c.smallest, c.largest);
    }
  }
  return 0;
}

int main(int argc, char** argv) {
  if (const int repetitions = repetitions_of_ratios(argc, argv)) return print_ratios(repetitions);
  std::vector<FitProblem> problems;
  const std::vector<FitSystem> list = systems();
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
