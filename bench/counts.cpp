// SPDX-License-Identifier: Apache-2.0
// What the stages make and take that no clock measures, on small meshes: matrix entries, types, bytes of tables,
// allocations and what they ask for. One thread, so that the numbers are the same in every run of the same build.
// `counts FILE.json`; bench/run_all compares it with bench/counts.json.
#include <tbb/global_control.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/surface/limit_surface.h"
#include "support/allocations.h"

namespace sublimit::bench {
namespace {

using testing::allocations;
using Counts = nlohmann::ordered_json;

struct Case {
  std::string mesh, scheme;
  Mesh control;
};

std::vector<Case> cases() {
  using namespace testing;
  Mesh creased = disjoint_union(grid(5, 4), cube());
  add_crease(creased, {6, 7, 8, 9}, 2.5f);
  add_crease(creased, {30, 31, 33, 32}, 10);
  std::vector<Case> list;
  for (const char* scheme : {"catmull-clark", "doo-sabin", "kobbelt"}) {
    list.push_back({"torus", scheme, torus(12, 8)});
    list.push_back({"split triangles", scheme, quads_from_triangles(triangle_torus(5, 4))});
  }
  list.push_back({"creased grid and cube", "catmull-clark", creased});
  list.push_back({"prism", "catmull-clark", prism(5)});
  for (const char* scheme : {"loop", "sqrt3", "modified-butterfly"}) {
    list.push_back({"triangle torus", scheme, triangle_torus(8, 6)});
    list.push_back({"icosahedron", scheme, icosahedron()});
  }
  return list;
}

/// Allocations of a stage, and the bytes that they ask for, one after the other.
template <class Stage>
void count_memory(Counts& counts, const std::string& name, const Stage& stage) {
  const std::int64_t calls = allocations(), bytes = testing::allocated_bytes();
  stage();
  const std::int64_t more_calls = allocations() - calls, more_bytes = testing::allocated_bytes() - bytes;
  counts[name + ": allocations"] = more_calls;
  counts[name + ": bytes allocated"] = more_bytes;
}

constexpr int levels = 2;

void count_refinement(Counts& counts, const Case& c, const Scheme<double>& scheme) {
  count_memory(counts, "refine", [&] {
    std::int64_t entries = 0;
    for (const Level& level : refine(scheme, c.control, levels)) entries += level.S.nonZeros();
    counts["refine: matrix entries"] = entries;
  });
  count_memory(counts, "refined mesh",
               [&] { counts["refined mesh: points"] = refined_mesh(scheme, c.control, levels).positions.rows(); });
}

void count_table(Counts& counts, const Case& c, const Scheme<double>& scheme, const std::string& name,
                 const BakeRequest& request) {
  Patterns patterns(scheme);
  PatternTable<float> table;
  const auto make = [&] {
    const Baked baked = bake(patterns, c.control, request);
    counts[name + ": types"] = baked.statistics.types;
    counts[name + ": groups"] = baked.statistics.groups;
    counts[name + ": points"] = baked.statistics.points;
    counts[name + ": weights"] = baked.statistics.weights;
    table = in_float(baked.table.table);
    counts[name + ": table bytes"] = table.num_bytes();
  };
  count_memory(counts, name, make);
  count_memory(counts, name + ", types known", make);
  const std::vector<float> points(c.control.positions.data(), c.control.positions.data() + c.control.positions.size());
  std::vector<float> made(size_t(table.num_points() * table.quantities() * 3));
  std::optional<PatternEvaluator<float>> evaluator;
  count_memory(counts, name + ", evaluator", [&] { evaluator.emplace(table); });
  counts[name + ", evaluator: bytes"] = evaluator->num_bytes();
  evaluator->apply(points, 3, made);
  count_memory(counts, name + ", second apply", [&] { evaluator->apply(points, 3, made); });
}

void count_limits(Counts& counts, const Case& c, const Scheme<double>& scheme) {
  std::optional<LimitMap> surface;
  std::optional<LimitSurface> bound;
  count_memory(counts, "limit surface, prepared", [&] {
    surface.emplace(scheme, c.control);
    surface->prepare();
  });
  count_memory(counts, "limit surface, bound", [&] { bound.emplace(*surface, c.control.positions); });
  std::vector<Place> places;
  for (Index face = 0; face < surface->faces().size; ++face) places.push_back({face, 0.25, 0.5});
  LimitSamples samples;
  bound->evaluate(places, 1, true, samples);
  count_memory(counts, "limit surface, second samples", [&] { bound->evaluate(places, 1, true, samples); });
}

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "counts: usage: counts FILE.json\n");
    return 2;
  }
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  Counts all;
  for (const Case& c : cases()) {
    const Scheme<double> scheme = find_scheme(c.scheme).value();
    Counts counts = Counts::object();
    count_refinement(counts, c, scheme);
    count_table(counts, c, scheme, "level", {.rows = TableRows::level, .level = levels});
    count_table(counts, c, scheme, "grid", {.rows = TableRows::grid, .grid = 4, .derivatives = 1});
    count_limits(counts, c, scheme);
    all[c.scheme + " of " + c.mesh] = counts;
  }
  std::ofstream file(argv[1]);
  file << Counts{{"program", "counts"}, {"counts", all}}.dump(1) << "\n";
  if (file.flush()) return 0;
  std::fprintf(stderr, "counts: cannot write %s\n", argv[1]);
  return 3;
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
