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
// `limit_bench --ratios [turns]` takes turns (report.h), otherwise Google Benchmark's own options hold. `--points N`:
// instead of a million; `--mesh NAME`: that one alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>

#include "limit_peers.h"
#include "measuring.h"
#include "bench_report.h"

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

std::vector<Case> limit_cases(const std::string& only, bool quick) {
  std::vector<Case> list;
  const auto wanted = [&](const std::string& name) { return only.empty() || only == name; };
  if (wanted("torus"))
    list.push_back({"torus", "catmull-clark", quick ? testing::torus(40, 25) : testing::torus(400, 250)});
  for (const char* name : {"car", "bishop", "righthanded"}) {
    if (!wanted(name)) continue;
    if (const auto path = shared_mesh(name); !path.empty()) list.push_back({name, "catmull-clark", read_mesh(path)});
  }
  return list;
}

/// Where points are asked for.
struct Pattern {
  std::string name;
  std::vector<Place> places;
};

Index num_addresses(const Mesh& mesh) {
  Index sum = 0;
  for (const Index size : mesh.face_sizes) sum += size == 4 ? 1 : size;
  return sum;
}

Pattern random_places(const Mesh& mesh, int count) {
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
                   [](const Place& a, const Place& b) { return a.face < b.face; });
  return pattern;
}
Pattern gridded(const Mesh& mesh, int count) {
  const Index faces = num_addresses(mesh);
  const int N = std::max(2, int(std::lround(std::sqrt(double(count) / faces))));
  Pattern pattern{"gridded", {}};
  for (Index f = 0; f < faces; ++f)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) pattern.places.push_back({f, double(i) / (N - 1), double(j) / (N - 1)});
  return pattern;
}
Pattern one_a_face(const Mesh& mesh) {
  Pattern pattern{"first", {}};
  for (Index f = 0; f < num_addresses(mesh); ++f) pattern.places.push_back({f, 0.375, 0.625});
  return pattern;
}
std::vector<Pattern> patterns(const Mesh& mesh, int count) {
  const Pattern random = random_places(mesh, count);
  return {random, sorted(random), gridded(mesh, count)};
}

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
                       const Pattern& pattern, const Mesh& mesh) {
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

/// @param turn  of a contender, by its number
std::vector<Contender> all_of(const std::vector<LimitContender>& who, const std::function<double(size_t)>& turn) {
  std::vector<Contender> list;
  for (size_t i = 0; i < who.size(); ++i)
    list.push_back({who[i].name,
                    i == 0           ? Role::ours
                    : i < first_peer ? Role::shown
                                     : Role::peer,
                    [turn, i] { return turn(i); }});
  return list;
}

void measure_mesh(Report& report, const Case& c, int points, int threads) {
  if (!report.wants("prepared", c.name) && !report.wants("cold", c.name) && !report.wants("first", c.name)) return;
  const std::vector<LimitContender> who = contenders();
  std::vector<std::unique_ptr<LimitEvaluator>> evaluators;
  for (const LimitContender& contender : who) {
    evaluators.push_back(contender.make(c));
    evaluators.back()->forget();
    evaluators.back()->start();
    evaluators.back()->prepare();
  }
  const auto work = [&](const char* state, const Pattern& p, int order) {
    return Work{state, c.name, p.name + ", D" + std::to_string(order), threads, "ns", 1e9 / double(p.places.size())};
  };
  const std::vector<Pattern> all = patterns(c.mesh, points);
  if (threads == 1) print_differences(who, evaluators, all.front(), c.mesh);
  for (const Pattern& p : all) {
    for (auto& e : evaluators) e->set_places(p.places);
    for (const int order : {0, 1, 2})
      report.measure(work("prepared", p, order),
                     all_of(who, [&](size_t i) { return timed(threads, [&] { evaluators[i]->evaluate(order); }); }));
  }
  const auto cold = [&](const char* state, const Pattern& p, int order) {
    report.measure(work(state, p, order),
                   all_of(who, [&](size_t i) { return cold_seconds(*evaluators[i], p, order, threads); }));
  };
  for (const int order : {0, 1, 2}) cold("cold", all.front(), order);
  cold("first", one_a_face(c.mesh), 1);
}

int take_turns(Report& report, const Options& options) {
  const int points = report.quick() ? 2000 : options.points;
  const std::vector<Case> meshes = limit_cases(options.mesh, report.quick());
  for (const int threads : report.threads()) {
    const Threads scope(threads);
    for (const Case& c : meshes) measure_mesh(report, c, points, threads);
    for (const char* name : {"righthanded", "pawn"}) {
      const std::filesystem::path path = shared_mesh(name);
      if (path.empty() || !(options.mesh.empty() || options.mesh == name)) continue;
      const Pattern p = random_places(read_mesh(path), 10000);
      const std::vector<LimitContender> who = contenders();
      report.measure({"file", name, "10,000 points", threads},
                     all_of(who, [&](size_t i) { return file_seconds(who[i], path, p, threads); }));
    }
  }
  return report.finish();
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
  Report report("limit_bench", argc, argv);
  if (report.turns()) return take_turns(report, given);
  const std::vector<Case> meshes = limit_cases(given.mesh, report.quick());
  register_benchmarks(meshes, given.points);
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
