// SPDX-License-Identifier: Apache-2.0
// Points of classical patches, ours and others', in one run: a bicubic rational B-spline of 100 x 100 control points
// and 1000 bicubic Bezier patches, at random places (sorted by nothing) and 8 x 8 on every face.
//   order 0: points;  1: points with du and dv
// Others are OpenCASCADE's D0 and D1 (its adaptor keeps the piece it was on last), SISL's s1424 and s1421, and a loop
// of our own that keeps Bezier pieces and nothing else, as an engine would write it. `table` is a baked table in double
// at the places of the grid, applied. All write to memory that is there; preparation is left out. On one thread the
// processor's time is taken. The limit is the time to write the doubles, at the bandwidth of one thread.
//
// `patches_bench --ratios [turns]` takes turns (report.h).
#include <sisl.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>

#include "bench_report.h"
#include "measuring.h"
#include "peers/opencascade_reference.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/patches/detail/bezier_pieces.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit::bench {
namespace {

using Places = std::vector<Place>;
/// Evaluates all places into 3 or 9 numbers each.
using Run = std::function<void()>;

struct Case {
  std::string name;
  std::unique_ptr<PatchSet> set;
  Points columns;
};

Points random_net(Index m, Index n, bool rational, std::mt19937& random) {
  std::uniform_real_distribution<> height(-0.5, 0.5), weight(0.5, 2);
  Points columns(m * n, rational ? 4 : 3);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) {
      const double w = rational ? weight(random) : 1;
      columns.row(i + m * j).head(3) << w * i, w * j, w * height(random);
      if (rational) columns(i + m * j, 3) = w;
    }
  return columns;
}

Case nurbs_surface() {
  std::mt19937 random(1);
  std::vector<double> knots{0, 0, 0};
  for (int i = 0; i <= 97; ++i) knots.push_back(i);
  knots.insert(knots.end(), 3, 97.0);
  const auto k = Knots<double>::open(3, 100, knots);
  return {
      "NURBS 100 x 100",
      std::make_unique<PatchSet>(std::vector<std::shared_ptr<const Patch>>{std::make_shared<const SplineSurface>(k, k)},
                                 Coordinates::homogeneous),
      random_net(100, 100, true, random)};
}

Case bezier_patches() {
  std::mt19937 random(2);
  const auto k = Knots<double>::open(3, 4, {0, 0, 0, 0, 1, 1, 1, 1});
  std::vector<std::shared_ptr<const Patch>> patches;
  Points columns(16000, 3);
  for (int i = 0; i < 1000; ++i) {
    patches.push_back(std::make_shared<const SplineSurface>(k, k));
    columns.middleRows(16 * i, 16) = random_net(4, 4, false, random);
  }
  return {"1000 Beziers", std::make_unique<PatchSet>(patches), columns};
}

struct Peers {
  std::vector<std::function<void(std::span<const Patch::Parameters>, bool, std::span<double>)>> opencascade;
  std::vector<SISLSurf*> sisl;
  ~Peers() {
    for (SISLSurf* surface : sisl) freeSurf(surface);
  }
  explicit Peers(const Case& c) {
    for (size_t p = 0; p < c.set->members().size(); ++p) {
      const auto& spline = static_cast<const SplineSurface&>(*c.set->members()[p].patch);
      const Points own = c.set->columns_of(p, c.columns);
      opencascade.push_back(testing::opencascade_run(spline.u(), spline.v(), own));
      std::vector<double> ku(spline.u().all().begin(), spline.u().all().end()),
          kv(spline.v().all().begin(), spline.v().all().end());
      sisl.push_back(newSurf(spline.u().num_points(), spline.v().num_points(), spline.u().degree() + 1,
                             spline.v().degree() + 1, ku.data(), kv.data(), const_cast<double*>(own.data()),
                             own.cols() == 4 ? 2 : 1, 3, 1));
    }
  }
};

/// As an engine would write it: Bezier pieces, Bernstein polynomials written out.
class TunedLoop {
 public:
  TunedLoop(const Case& c) : rational_(c.columns.cols() == 4) {
    for (size_t p = 0; p < c.set->members().size(); ++p) {
      const auto& spline = static_cast<const SplineSurface&>(*c.set->members()[p].patch);
      const Points own = c.set->columns_of(p, c.columns);
      for (Index face = 0; face < spline.num_faces(); ++face) {
        const auto u = bezier_rows(spline.u(), face % spline.u().num_faces()),
                   v = bezier_rows(spline.v(), face / spline.u().num_faces());
        const std::vector<Index> slots = spline.slots(face);
        for (int b = 0; b < 4; ++b)
          for (int a = 0; a < 4; ++a) {
            Eigen::Array4d sum = Eigen::Array4d::Zero();
            for (int j = 0; j < 4; ++j)
              for (int i = 0; i < 4; ++i) {
                Eigen::Array4d column(0, 0, 0, 1);
                column.head(c.columns.cols()) = own.row(slots[size_t(i + 4 * j)]).transpose().array();
                sum += u[a][size_t(i)] * v[b][size_t(j)] * column;
              }
            pieces_.push_back(sum);
          }
      }
    }
  }
  void points(const Places& places, bool derivatives, double* out) const {
    for (const Place& s : places) {
      const Eigen::Array4d* piece = pieces_.data() + 16 * s.face;
      const double u = s.u, v = s.v, x = 1 - u, y = 1 - v;
      const double bu[4] = {x * x * x, 3 * u * x * x, 3 * u * u * x, u * u * u},
                   bv[4] = {y * y * y, 3 * v * y * y, 3 * v * v * y, v * v * v};
      const double du[4] = {-3 * x * x, 3 * x * x - 6 * u * x, 6 * u * x - 3 * u * u, 3 * u * u},
                   dv[4] = {-3 * y * y, 3 * y * y - 6 * v * y, 6 * v * y - 3 * v * v, 3 * v * v};
      Eigen::Array4d A = Eigen::Array4d::Zero(), Au = A, Av = A;
      for (int j = 0; j < 4; ++j, piece += 4) {
        const Eigen::Array4d row = bu[0] * piece[0] + bu[1] * piece[1] + bu[2] * piece[2] + bu[3] * piece[3];
        A += bv[j] * row;
        if (!derivatives) continue;
        Av += dv[j] * row;
        Au += bv[j] * (du[0] * piece[0] + du[1] * piece[1] + du[2] * piece[2] + du[3] * piece[3]);
      }
      const double over = rational_ ? 1 / A[3] : 1;
      for (int c = 0; c < 3; ++c) out[c] = A[c] * over;
      if (derivatives)
        for (int c = 0; c < 3; ++c) {
          out[3 + c] = rational_ ? (Au[c] - Au[3] * out[c]) * over : Au[c];
          out[6 + c] = rational_ ? (Av[c] - Av[3] * out[c]) * over : Av[c];
        }
      out += derivatives ? 9 : 3;
    }
  }

 private:
  bool rational_;
  std::vector<Eigen::Array4d> pieces_;
};

/// All who take part, with memory for their results.
struct Race {
  Case of;
  Places places;
  int order;
  Peers peers;
  TunedLoop loop;
  BezierPieces bound;
  LimitSamples samples;
  std::vector<double> numbers;
  std::vector<std::vector<Patch::Parameters>> parameters;  // by patch, in the order of the places
  std::optional<BakedTable<double>> table;
  std::optional<PatternEvaluator<double>> evaluator;
  std::vector<std::vector<double>> quantities;

  Race(Case c, Places p, int order_, bool grid)
      : of(std::move(c)), places(std::move(p)), order(order_), peers(of), loop(of), bound(*of.set, of.columns) {
    numbers.resize(places.size() * (order ? 9 : 3));
    parameters.resize(of.set->members().size());
    for (const Place& s : places) {
      const size_t patch = of.set->patch_of(s.face);
      parameters[patch].push_back(
          of.set->members()[patch].patch->parameters({s.face - of.set->first_face(patch), s.u, s.v}));
    }
    if (!grid) return;
    BakeRequest request;
    request.rows = TableRows::grid;
    request.grid = 8;
    request.derivatives = order;
    table.emplace(bake(*of.set, request).table);
    evaluator.emplace(table->table);
    quantities.assign(order ? 3 : 1, std::vector<double>(places.size() * 3));
  }

  struct Racer {
    std::string name;
    Role role;
    Run run;
  };
  std::vector<Racer> racers() {
    std::vector<Racer> all{{"ours", Role::ours, [this] { bound.evaluate(places, order, false, samples); }},
                           {"OpenCASCADE", Role::peer,
                            [this] {
                              size_t at = 0;
                              const size_t width = order ? 9 : 3;
                              for (size_t p = 0; p < parameters.size(); ++p) {
                                peers.opencascade[p](parameters[p], order > 0,
                                                     std::span<double>(numbers).subspan(at * width));
                                at += parameters[p].size();
                              }
                            }},
                           {"SISL", Role::peer,
                            [this] {
                              double* out = numbers.data();
                              for (size_t p = 0; p < parameters.size(); ++p) {
                                int left_u = 0, left_v = 0, status = 0;
                                for (const Patch::Parameters& at : parameters[p]) {
                                  double both[2] = {at.u, at.v}, normal[3], found[9];
                                  s1421(peers.sisl[p], order, both, &left_u, &left_v, found, normal, &status);
                                  out = std::copy_n(found, order ? 9 : 3, out);
                                }
                              }
                            }},
                           {"tuned loop", Role::shown, [this] { loop.points(places, order > 0, numbers.data()); }}};
    if (table)
      all.push_back({"our table", Role::ours, [this] {
                       Evaluation<double> e;
                       e.channels = static_cast<int>(of.columns.cols());
                       e.rational = e.channels == 4;
                       e.points = {of.columns.data(), size_t(of.columns.size())};
                       for (size_t q = 0; q < quantities.size(); ++q) e.quantities[q] = quantities[q];
                       evaluator->apply(e);
                     }});
    return all;
  }
};

Places random_places(const PatchSet& set, int count) {
  std::mt19937_64 random(3);
  Places places;
  for (int i = 0; i < count; ++i)
    places.push_back({static_cast<Index>(random() % std::uint64_t(set.faces().size)), double(random() >> 11) * 0x1p-53,
                      double(random() >> 11) * 0x1p-53});
  return places;
}

int take_turns(Report& report) {
  for (const int threads : report.threads()) {
    const Threads pinned(threads);
    for (const bool grid : {false, true})
      for (const int which : {0, 1})
        for (const int order : {0, 1}) {
          Case c = which == 0 ? nurbs_surface() : bezier_patches();
          Places places = grid ? c.set->grid(8) : random_places(*c.set, report.quick() ? 2000 : 200000);
          const Work work{"patches", c.name, std::string(grid ? "8 x 8" : "random") + ", D" + std::to_string(order),
                          threads,   "ns",   1e9 / double(places.size())};
          if (!report.wants(work.work, work.mesh, work.detail)) continue;
          Race race(std::move(c), std::move(places), order, grid);
          std::vector<Contender> contenders;
          for (const Race::Racer& racer : race.racers())
            contenders.push_back({racer.name, racer.role, [threads, run = racer.run] { return timed(threads, run); }});
          report.measure(work, contenders);
          if (race.table)
            report.count("table of " + work.mesh + ", " + work.detail, "table bytes",
                         double(race.table->table.num_bytes()));
        }
  }
  return report.finish();
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) {
  using namespace sublimit::bench;
  Report report("patches_bench", argc, argv);
  if (report.turns()) return take_turns(report);
  register_write_bandwidth();
  std::vector<std::shared_ptr<Race>> races;
  for (const int which : {0, 1})
    for (const int order : {0, 1})
      for (const bool grid : {false, true}) {
        Case c = which == 0 ? nurbs_surface() : bezier_patches();
        auto places = grid ? c.set->grid(8) : random_places(*c.set, report.quick() ? 2000 : 200000);
        auto one = std::make_shared<Race>(std::move(c), std::move(places), order, grid);
        races.push_back(one);
        for (const Race::Racer& racer : one->racers())
          benchmark::RegisterBenchmark(
              (one->of.name + (grid ? "/grid" : "/random") + "/order " + std::to_string(order) + "/" + racer.name)
                  .c_str(),
              [one, racer](benchmark::State& state) {
                for (auto _ : state) racer.run();
                state.SetItemsProcessed(state.iterations() * std::int64_t(one->places.size()));
              });
      }
  return run_benchmarks(argc, argv);
}
