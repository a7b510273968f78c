// SPDX-License-Identifier: Apache-2.0
// Refinement against OpenSubdiv, in one run: topology, matrices and positions of all levels against Create + RefineUniform +
// Interpolate, and P_k against StencilTableFactory. `refine_bench --ratios [repetitions]` takes turns and prints medians with
// their spread and the ratios; otherwise Google Benchmark's own options hold.
#include <benchmark/benchmark.h>
#include <sched.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "opensubdiv_peer.h"
#include "sublimit/mesh/read_mesh.h"
#include "sublimit/refine.h"
#include "sublimit/schemes.h"
#include "sublimit/sparse_product.h"
#include "support/meshes.h"

namespace {

using namespace sublimit;

struct Case {
  std::string name, scheme;
  ControlMesh mesh;
};

/// A control mesh with the numbers of its elements shuffled as little as an exporter would: as made.
std::vector<Case> cases() {
  using namespace sublimit::testing;
  std::vector<Case> list;
  const std::filesystem::path car = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / "catmark_car.obj";
  if (std::filesystem::exists(car)) {
    list.push_back({"car", "catmull-clark", read_mesh(car)});
  } else {
    std::fprintf(stderr, "refine_bench: NO %s: the car is not measured\n", car.c_str());
  }
  list.push_back({"torus100k", "catmull-clark", torus(400, 250)});
  list.push_back({"split_triangles100k", "catmull-clark", quads_from_triangles(triangle_torus(182, 92))});
  list.push_back({"loop_torus100k", "loop", triangle_torus(250, 200)});
  return list;
}
const std::vector<Case>& all_cases() {
  static const std::vector<Case> list = cases();
  return list;
}

bench::PeerMesh peer_mesh(const Case& c) {
  static std::map<std::string, std::pair<std::vector<int>, std::vector<float>>> creases;
  auto& [pairs, sharpness] = creases[c.name];
  if (pairs.empty())
    for (const auto& crease : c.mesh.creases) {
      pairs.insert(pairs.end(), {crease.tail, crease.head});
      sharpness.push_back(crease.sharpness);
    }
  bench::PeerMesh mesh;
  mesh.scheme = c.scheme == "loop" ? bench::PeerScheme::loop : bench::PeerScheme::catmull_clark;
  mesh.num_vertices = c.mesh.num_vertices();
  mesh.face_sizes = c.mesh.face_sizes;
  mesh.face_vertices = c.mesh.face_vertices;
  mesh.crease_vertices = pairs;
  mesh.crease_sharpness = sharpness;
  return mesh;
}

// What is measured. Each returns something that depends on all of its work.
double ours_refine(const Case& c, int levels) {
  const std::vector<Level> refined = refine(find_scheme(c.scheme).value(), c.mesh, levels);
  Points x = c.mesh.positions;
  for (int k = 1; k <= levels; ++k) x = apply(refined[k].S, x);
  return x(x.rows() / 2, 0);
}
double theirs_refine(const Case& c, int levels) {
  const bench::PeerRefiner refiner(peer_mesh(c), levels);
  return refiner.refine(std::span<const double>(c.mesh.positions.data(), size_t(c.mesh.positions.size()))).checksum;
}

struct Prepared {
  std::vector<Level> levels;
  std::unique_ptr<bench::PeerRefiner> refiner;
};
const Prepared& prepared(const Case& c, int levels) {
  static std::string key;
  static Prepared p;
  const std::string wanted = c.name + std::to_string(levels);
  if (key != wanted) {
    p = {};
    p.levels = refine(find_scheme(c.scheme).value(), c.mesh, levels);
    p.refiner = std::make_unique<bench::PeerRefiner>(peer_mesh(c), levels);
    key = wanted;
  }
  return p;
}
double ours_stencils(const Case& c, int levels) {
  return double(refinement_matrix(prepared(c, levels).levels).nonZeros());
}
double theirs_stencils(const Case& c, int levels) {
  return double(prepared(c, levels).refiner->stencils_double().weights);
}

struct Measured {
  const char* name;
  double (*ours)(const Case&, int);
  double (*theirs)(const Case&, int);
};
constexpr Measured measured[] = {{"refine", ours_refine, theirs_refine}, {"stencils", ours_stencils, theirs_stencils}};

double write_bandwidth() {  // bytes per second of writing memory that is there already
  std::vector<char> block(size_t{1} << 28, 1);
  double best = 0;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    std::memset(block.data(), i, block.size());
    benchmark::DoNotOptimize(block.data());
    benchmark::ClobberMemory();
    best = std::max(best, double(block.size()) / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

int print_ratios(int repetitions) {
  std::printf("write bandwidth, one thread: %.1f GB/s\n", write_bandwidth() / 1e9);
  std::printf("%-9s %-20s %5s %7s %22s %22s %7s\n", "what", "mesh", "level", "threads", "ours ms (min..max)",
              "OpenSubdiv ms", "ratio");
  cpu_set_t all;
  sched_getaffinity(0, sizeof all, &all);
  for (const int threads : {1, int(tbb::info::default_concurrency())}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, size_t(threads));
    if (threads == 1) {  // pinned, so that the scheduler does not move the one thread
      cpu_set_t one;
      CPU_ZERO(&one);
      for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
        if (CPU_ISSET(cpu, &all)) {
          CPU_SET(cpu, &one);
          break;
        }
      sched_setaffinity(0, sizeof one, &one);
    } else {
      sched_setaffinity(0, sizeof all, &all);
    }
    for (const Measured& m : measured)
      for (const Case& c : all_cases())
        for (const int levels : {2, 3}) {
          std::vector<double> times[2];
          for (int r = 0; r < repetitions; ++r)
            for (const int who : {0, 1}) {
              if (m.ours == ours_stencils) prepared(c, levels);
              const auto start = std::chrono::steady_clock::now();
              benchmark::DoNotOptimize((who == 0 ? m.ours : m.theirs)(c, levels));
              times[who].push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
            }
          for (auto& t : times) std::sort(t.begin(), t.end());
          const auto median = [&](int who) { return times[who][times[who].size() / 2]; };
          std::printf("%-9s %-20s %5d %7d %9.1f (%.1f..%.1f) %9.1f (%.1f..%.1f) %6.2fx\n", m.name, c.name.c_str(), levels, threads,
                      median(0), times[0].front(), times[0].back(), median(1), times[1].front(), times[1].back(),
                      median(1) / median(0));
          std::fflush(stdout);
        }
  }
  return 0;
}

void register_benchmarks() {
  for (const Measured& m : measured)
    for (const Case& c : all_cases())
      for (const int levels : {2, 3})
        for (const auto& [who, run] : {std::pair("ours", m.ours), std::pair("opensubdiv", m.theirs)}) {
          const std::string name =
              std::string("BM_") + m.name + "/" + who + "/" + c.name + "/level:" + std::to_string(levels);
          const auto work = run;
          benchmark::RegisterBenchmark(name.c_str(), [&c, levels, work](benchmark::State& state) {
            for (auto _ : state) benchmark::DoNotOptimize(work(c, levels));
            state.counters["faces"] = c.mesh.num_faces();
          })->Unit(benchmark::kMillisecond)->UseRealTime();
        }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--ratios") return print_ratios(argc > 2 ? std::stoi(argv[2]) : 5);
  register_benchmarks();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
