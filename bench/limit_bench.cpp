// SPDX-License-Identifier: Apache-2.0
// Points of the limit surface of Catmull-Clark, ours and others', in one run: a torus of 100k quads, regular
// throughout, and OpenSubdiv's car, bishop and righthanded, if they are there.
//   prepared   everything that does not depend on the places is there: points alone are timed. At random places, the
//              same sorted by their face, and N x N on every face; order 0: positions, 1: with du and dv, 2: with duu,
//              duv and dvv
//   cold       from connectivity: what must be prepared and the points, at random places
//   first      from connectivity: one point and its du and dv on every face
//   file       from a file of some 500 faces to 10,000 points at random places; our reader for all
// Others are Bfr (float, double), Far's PatchTable and PatchMap (float, double; level 4, sharp patches, Gregory end
// caps) and Embree (float), see limit_peers.h. All write to memory that is there. On one thread the processor's time is
// taken, on several that of the wall. The limit is the time to write the doubles, at the bandwidth of one thread.
//
// `limit_bench --ratios [repetitions] [--keep-memory]` takes turns and prints medians with their spread and the ratio
// of the best other to ours; otherwise Google Benchmark's own options hold. `--points N`: instead of a million; `--mesh
// NAME`: that one alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>

#include "limit_peers.h"
#include "measuring.h"

namespace sublimit::bench {
namespace {

struct Options {
  int points = 1000000;
  std::string mesh;
};

/// Takes what is ours out of the arguments.
Options options(int& argc, char** argv) {
  Options result;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--points" && i + 1 < argc) {
      result.points = std::stoi(argv[++i]);
    } else if (name == "--mesh" && i + 1 < argc) {
      result.mesh = argv[++i];
    } else {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  return result;
}

std::vector<LimitContender> contenders() {
  return {{"ours", our_limits},     {"ours and normals", our_limits_and_normals},
          {"Bfr float", bfr_float}, {"Bfr double", bfr_double},
          {"Far float", far_float}, {"Far double", far_double},
          {"Embree float", embree}};
}

/// Contenders from here on are others, and whose positions the others' are compared with.
constexpr size_t first_peer = 2, reference_contender = first_peer + 3;

std::filesystem::path shared_mesh(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / ("catmark_" + name + ".obj");
  if (std::filesystem::exists(path)) return path;
  std::fprintf(stderr, "limit_bench: NO %s: it is not measured\n", path.c_str());
  return {};
}

std::vector<Case> limit_cases(const std::string& only) {
  std::vector<Case> list;
  const auto wanted = [&](const std::string& name) { return only.empty() || only == name; };
  if (wanted("torus")) list.push_back({"torus", "catmull-clark", testing::torus(400, 250)});
  for (const char* name : {"car", "bishop", "righthanded"}) {
    if (!wanted(name)) continue;
    if (const auto path = shared_mesh(name); !path.empty()) list.push_back({name, "catmull-clark", read_mesh(path)});
  }
  return list;
}

/// Where points are asked for.
struct Pattern {
  std::string name;
  std::vector<Sample> places;
};

Index num_addresses(const ControlMesh& mesh) {
  Index sum = 0;
  for (const Index size : mesh.face_sizes) sum += size == 4 ? 1 : size;
  return sum;
}

Pattern random_places(const ControlMesh& mesh, int count) {
  std::mt19937 random(1);
  std::uniform_int_distribution<Index> face(0, num_addresses(mesh) - 1);
  std::uniform_real_distribution<double> coordinate(0, 1);
  Pattern pattern{"random", {}};
  for (int i = 0; i < count; ++i) {
    const Index f = face(random);
    const double u = coordinate(random), v = coordinate(random);
    pattern.places.push_back({f, u, v});
  }
  return pattern;
}
Pattern sorted(Pattern pattern) {
  pattern.name = "sorted";
  std::stable_sort(pattern.places.begin(), pattern.places.end(),
                   [](const Sample& a, const Sample& b) { return a.face < b.face; });
  return pattern;
}
Pattern gridded(const ControlMesh& mesh, int count) {
  const Index faces = num_addresses(mesh);
  const int N = std::max(2, int(std::lround(std::sqrt(double(count) / faces))));
  Pattern pattern{"gridded", {}};
  for (Index f = 0; f < faces; ++f)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) pattern.places.push_back({f, double(i) / (N - 1), double(j) / (N - 1)});
  return pattern;
}
Pattern one_a_face(const ControlMesh& mesh) {
  Pattern pattern{"first", {}};
  for (Index f = 0; f < num_addresses(mesh); ++f) pattern.places.push_back({f, 0.375, 0.625});
  return pattern;
}
std::vector<Pattern> patterns(const ControlMesh& mesh, int count) {
  const Pattern random = random_places(mesh, count);
  return {random, sorted(random), gridded(mesh, count)};
}

double timed(int threads, const auto& work) { return threads == 1 ? cpu_seconds(work) : seconds(work); }

/// Seconds from connectivity to the points.
double cold_seconds(LimitEvaluator& evaluator, const Pattern& pattern, int order, int threads) {
  evaluator.forget();
  evaluator.set_places(pattern.places);
  return timed(threads, [&] {
    evaluator.start();
    evaluator.evaluate(order);
  });
}

/// Seconds from a file to the points: everything on the way is timed.
double file_seconds(const LimitContender& contender, const std::filesystem::path& path, const Pattern& pattern,
                    int threads) {
  std::unique_ptr<LimitEvaluator> evaluator;
  std::optional<Case> mesh;
  const double time = timed(threads, [&] {
    mesh.emplace(Case{"", "catmull-clark", read_mesh(path)});
    evaluator = contender.make(*mesh);
    evaluator->set_places(pattern.places);
    evaluator->start();
    evaluator->evaluate(0);
  });
  benchmark::DoNotOptimize(evaluator->position(0));
  return time;
}

/// Largest distance from the first evaluator that is double, over the bounding box.
/// @throws std::logic_error  one means other places
void print_differences(const std::vector<LimitContender>& who, std::vector<std::unique_ptr<LimitEvaluator>>& evaluators,
                       const Pattern& pattern, const ControlMesh& mesh) {
  const double box = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  for (auto& e : evaluators) {
    e->set_places(pattern.places);
    e->evaluate(0);
  }
  std::printf("  positions differ from those of %s by at most, over the bounding box:",
              who[reference_contender].name.c_str());
  for (size_t i = 0; i < who.size(); ++i) {
    double most = 0;
    for (size_t k = 0; k < pattern.places.size(); ++k)
      most = std::max(most, (evaluators[i]->position(k) - evaluators[reference_contender]->position(k)).norm() / box);
    std::printf("  %s %.1e", who[i].name.c_str(), most);
    if (!(most < 0.02)) throw std::logic_error(who[i].name + " means other places");
  }
  std::printf("\n");
}

/// Takes turns; nanoseconds (milliseconds for `file`) by contender, sorted.
std::vector<std::vector<double>> take_turns(size_t contenders, int repetitions, double scale,
                                            const std::function<double(size_t)>& turn) {
  std::vector<std::vector<double>> times(contenders);
  for (int r = -1; r < repetitions; ++r)  // the first turn warms up
    for (size_t i = 0; i < contenders; ++i) {
      const double time = turn(i);
      if (r >= 0) times[i].push_back(scale * time);
    }
  for (auto& t : times) std::sort(t.begin(), t.end());
  return times;
}

void print_row(const std::string& what, const std::vector<std::vector<double>>& times) {
  std::printf("%-44s", what.c_str());
  const auto median = [](const std::vector<double>& t) { return t[t.size() / 2]; };
  double best = 0;
  for (size_t i = 0; i < times.size(); ++i) {
    const std::vector<double>& t = times[i];
    char text[64];
    std::snprintf(text, sizeof text, "%7.1f (%.0f..%.0f)", median(t), t.front(), t.back());
    std::printf("%-24s", text);
    if (i >= first_peer) best = best == 0 ? median(t) : std::min(best, median(t));
  }
  if (first_peer > 0) std::printf("%.2f", best / median(times[0]));
  std::printf("\n");
  std::fflush(stdout);
}

int print_ratios(int repetitions, const Options& options) {
  const double bandwidth = write_bandwidth();
  std::printf(
      "write bandwidth, one thread: %.1f GB/s; medians of %d in ns a point (least..most); limit: ns to write it\n",
      bandwidth / 1e9, repetitions);
#ifndef NDEBUG
  std::printf("assertions are on: these are not the figures of a release build\n");
#endif
  const std::vector<LimitContender> who = contenders();
  std::printf("%-44s", "          mesh        places    order thr limit ");
  for (const LimitContender& c : who) std::printf("%-24s", c.name.c_str());
  std::printf("best other : ours\n");
  const std::vector<Case> meshes = limit_cases(options.mesh);
  for (const int threads : thread_counts()) {
    const Threads scope(threads);
    for (const Case& c : meshes) {
      std::vector<std::unique_ptr<LimitEvaluator>> evaluators;
      for (const LimitContender& contender : who) {
        evaluators.push_back(contender.make(c));
        evaluators.back()->forget();
        evaluators.back()->start();
        evaluators.back()->prepare();
      }
      const auto row = [&](const char* state, const Pattern& p, int order) {
        char text[80];
        std::snprintf(text, sizeof text, "%-10s%-12s%-10s%d     %d   %.1f", state, c.name.c_str(), p.name.c_str(),
                      order, threads, 1e9 * 12 * (order + 1) * (order + 2) / bandwidth);
        return std::string(text);
      };
      const std::vector<Pattern> all = patterns(c.mesh, options.points);
      if (threads == 1) print_differences(who, evaluators, all.front(), c.mesh);
      for (const Pattern& p : all) {
        const double scale = 1e9 / double(p.places.size());
        for (auto& e : evaluators) e->set_places(p.places);
        for (const int order : {0, 1, 2})
          print_row(row("prepared", p, order), take_turns(who.size(), repetitions, scale, [&](size_t i) {
                      return timed(threads, [&] { evaluators[i]->evaluate(order); });
                    }));
      }
      const auto cold = [&](const char* state, const Pattern& p, int order) {
        print_row(row(state, p, order),
                  take_turns(who.size(), repetitions, 1e9 / double(p.places.size()),
                             [&](size_t i) { return cold_seconds(*evaluators[i], p, order, threads); }));
      };
      for (const int order : {0, 1, 2}) cold("cold", all.front(), order);
      cold("first", one_a_face(c.mesh), 1);
    }
    for (const char* name : {"righthanded", "pawn"}) {
      const std::filesystem::path path = shared_mesh(name);
      if (path.empty() || !(options.mesh.empty() || options.mesh == name)) continue;
      const Pattern p = random_places(read_mesh(path), 10000);
      print_row(
          std::string("file      ") + name + ", 10,000 points, in ms",
          take_turns(who.size(), repetitions, 1e3, [&](size_t i) { return file_seconds(who[i], path, p, threads); }));
    }
  }
  return 0;
}

void register_benchmarks(const std::vector<Case>& meshes, int points) {
  register_write_bandwidth();
  for (const Case& c : meshes) {
    std::vector<Pattern> all = patterns(c.mesh, points);
    all.push_back(one_a_face(c.mesh));
    for (const Pattern& pattern : all) {
      const auto p = std::make_shared<const Pattern>(pattern);
      for (const LimitContender& contender : contenders())
        for (const bool cold : {false, true})
          for (const int order : {0, 1, 2})
            for (const int threads : thread_counts()) {
              if (cold ? p->name != "random" && p->name != "first" : p->name == "first") continue;
              std::string name = std::string("BM_Limit/") + (cold ? "cold/" : "prepared/") + contender.name + "/" +
                                 c.name + "/" + p->name + "/order:" + std::to_string(order) +
                                 "/threads:" + std::to_string(threads);
              std::replace(name.begin(), name.end(), ' ', '_');
              const auto work = [&c, p, contender, cold, order, threads](benchmark::State& state) {
                const Threads scope(threads);
                const std::unique_ptr<LimitEvaluator> evaluator = contender.make(c);
                evaluator->forget();
                evaluator->start();
                evaluator->prepare();
                evaluator->set_places(p->places);
                for (auto _ : state)
                  state.SetIterationTime(cold ? cold_seconds(*evaluator, *p, order, threads)
                                              : timed(threads, [&] { evaluator->evaluate(order); }));
                state.counters["points"] =
                    benchmark::Counter(double(p->places.size()), benchmark::Counter::kIsIterationInvariantRate);
              };
              benchmark::RegisterBenchmark(name.c_str(), work)->Unit(benchmark::kMillisecond)->UseManualTime();
            }
    }
  }
}

int main(int argc, char** argv) {
  const Options given = options(argc, argv);
  if (const int repetitions = repetitions_of_ratios(argc, argv)) return print_ratios(repetitions, given);
  const std::vector<Case> meshes = limit_cases(given.mesh);
  register_benchmarks(meshes, given.points);
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
