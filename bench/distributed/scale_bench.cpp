// SPDX-License-Identifier: Apache-2.0
// How time, memory and what is sent grow with ranks and faces, under mpirun. Tori of any size: of the mesh in a file,
// or made in memory, where no rank ever has more than its run. One line of JSON from the first rank.
//
//   mpirun -n 2 scale_bench file torus.ply -l 2        read, connect, divide, bake, apply
//   mpirun -n 2 scale_bench torus 3162 3162 -l 4 --shards 64     produced shard by shard, and checked: the control
//   points
//     are those of products of cosines, so level k is the product of two curves refined k times by (1, 4, 6, 4, 1) / 8
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "sublimit/base/error.h"
#include "sublimit/distributed/jobs/shard_jobs.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"

namespace {

using namespace sublimit;

struct Options {
  std::string file;
  std::int64_t rows = 0, columns = 0;
  int levels = 1, shards = 0, frames = 3;
  bool runs = false;
};

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Most that this process ever had, bytes.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stod(line.substr(6));
  return 0;
}

/// Times of phases that all ranks pass.
class Phases {
 public:
  explicit Phases(const Ranks& ranks) : ranks_(ranks), start_(seconds()) {}
  void end(const char* name) {
    const double now = ranks_.largest(seconds());
    text_ +=
        fmt::format(R"("{}": {:.3f}, "{} memory": {:.0f}, )", name, now - start_, name, ranks_.largest(peak_memory()));
    start_ = now;
  }
  const std::string& text() const { return text_; }

 private:
  const Ranks& ranks_;
  double start_;
  std::string text_;
};

double angle(std::int64_t i, std::int64_t count) { return 2 * std::numbers::pi * double(i) / double(count); }

/// Radii 2 and 1; vertex i * columns + j, the face of the same number is on its far side.
SpreadMesh torus(const Ranks& ranks, std::int64_t rows, std::int64_t columns) {
  SpreadMesh mesh;
  mesh.vertices = mesh.faces = Runs::equal(rows * columns, ranks.size());
  const std::int64_t first = mesh.faces.begin(ranks.rank()), count = mesh.faces.size(ranks.rank());
  mesh.positions.resize(count, 3);
  mesh.face_sizes.assign(size_t(count), 4);
  mesh.face_vertices.reserve(size_t(4 * count));
  for (std::int64_t f = 0; f < count; ++f) {
    const std::int64_t i = (first + f) / columns, j = (first + f) % columns, below = (i + 1) % rows,
                       right = (j + 1) % columns;
    const double a = angle(i, rows), b = angle(j, columns);
    mesh.positions.row(f) << (2 + std::cos(b)) * std::cos(a), (2 + std::cos(b)) * std::sin(a), std::sin(b);
    mesh.face_vertices.insert(mesh.face_vertices.end(),
                              {i * columns + j, below * columns + j, below * columns + right, i * columns + right});
  }
  return mesh;
}

/// A closed polygon after so many steps of cubic splines.
std::vector<double> refined(std::vector<double> points, int levels) {
  for (int level = 0; level < levels; ++level) {
    const size_t n = points.size();
    std::vector<double> fine(2 * n);
    for (size_t i = 0; i < n; ++i) {
      const double next = points[(i + 1) % n];
      fine[2 * i] = (points[(i + n - 1) % n] + 6 * points[i] + next) / 8;
      fine[2 * i + 1] = (points[i] + next) / 2;
    }
    points = std::move(fine);
  }
  return points;
}

/// Level k of the torus, from curves.
struct Truth {
  std::int64_t rows, columns;
  int levels;
  std::vector<double> cos_a, sin_a, cos_b, sin_b;
  Truth(std::int64_t m, std::int64_t n, int k) : rows(m), columns(n), levels(k) {
    std::vector<double> ca, sa, cb, sb;
    for (std::int64_t i = 0; i < m; ++i) ca.push_back(std::cos(angle(i, m))), sa.push_back(std::sin(angle(i, m)));
    for (std::int64_t j = 0; j < n; ++j) cb.push_back(std::cos(angle(j, n))), sb.push_back(std::sin(angle(j, n)));
    cos_a = refined(ca, k), sin_a = refined(sa, k), cos_b = refined(cb, k), sin_b = refined(sb, k);
  }
  /// At (s, t) steps along the first side and away from it, of a face of which another corner comes first.
  std::array<double, 3> point(std::int64_t face, int turn, std::int64_t s, std::int64_t t) const {
    const std::int64_t side = std::int64_t{1} << levels;
    for (int k = 0; k < (4 - turn) % 4; ++k) std::swap(s, t), t = side - t;  // to what the corner before calls them
    const auto i = size_t((face / columns * side + s) % std::ssize(cos_a)),
               j = size_t((face % columns * side + t) % std::ssize(cos_b));
    return {(2 + cos_b[j]) * cos_a[i], (2 + cos_b[j]) * sin_a[i], sin_b[j]};
  }
};

/// Points of a shard and how far they are from what they should be, some of them.
struct Checked {
  double error = 0;
  std::int64_t points = 0;
};

Checked check_some(const Shard& shard, std::span<const std::int64_t> faces, std::span<const double> points,
                   const Truth& truth, int count, unsigned seed) {
  const auto& table = shard.table.table;
  const Lattice lattice{std::int32_t(1) << truth.levels, false};
  std::mt19937 random(seed);
  Checked checked;
  for (int n = 0; n < count; ++n) {
    const size_t p = random() % shard.patches.size();
    const PatchPlace& patch = shard.patches[p];
    const std::vector<std::int32_t> rows = LatticeRanks::rows(lattice, patch.share);
    if (rows.empty()) continue;
    const size_t k = random() % rows.size();
    const std::int64_t point = table.arrays().patch_points[p] + std::int64_t(k);
    const std::array<double, 3> right =
        truth.point(faces[size_t(patch.face)], patch.turn, rows[k] % (lattice.n + 1), rows[k] / (lattice.n + 1));
    for (size_t c = 0; c < 3; ++c)
      checked.error = std::max(checked.error, std::abs(points[size_t(3 * point) + c] - right[c]));
    ++checked.points;
  }
  return checked;
}

void file_bench(const Ranks& ranks, const Options& options) {
  Phases phases(ranks);
  SpreadMesh mesh =
      options.file.empty() ? torus(ranks, options.rows, options.columns) : read_spread_mesh(ranks, options.file);
  phases.end("read");
  const SpreadJob job = spread_job(ranks, {.scheme = "catmull-clark"}, std::move(mesh), "mesh");
  phases.end("connect");
  const BakeRequest request{.rows = TableRows::level, .level = options.levels};
  Patterns patterns(job.scheme);
  const SpreadShards shards = divide(ranks, job, patterns, request, {options.shards, options.runs});
  phases.end("divide");
  std::vector<LoadedShard> own;
  std::int64_t halo = 0;
  for (int number = 0; number < ranks.largest(std::ssize(shards.owned)); ++number) {
    Shard shard = made_shard(ranks, job, patterns, request, shards, number, true);
    if (size_t(number) < shards.owned.size()) {
      halo += std::ssize(shard.inputs);
      own.push_back({std::move(shard.table), std::move(shard.inputs), std::move(shard.runs), {}});
    }
  }
  phases.end("bake");
  const std::int64_t sent = bytes_sent();
  const SpreadTable table(ranks, std::move(own), job.mesh.vertices);
  const std::span<const double> x(job.mesh.positions.data(), size_t(job.mesh.positions.size()));
  std::vector<double> points(size_t(3 * table.num_points()));
  table.apply(x, 3, points);
  ranks.wait();
  double best = 1e30;
  for (int frame = 0; frame < options.frames; ++frame) {
    const double start = seconds();
    table.apply(x, 3, points);
    best = std::min(best, ranks.largest(seconds() - start));
  }
  phases.end("apply");
  const auto faces = double(job.mesh.faces.size());
  const std::string line = fmt::format(
      R"({{"ranks": {}, "faces": {:.0f}, "levels": {}, {}"frame": {:.4f}, "GB/s": {:.3f}, "points": {}, "sent a face": {:.1f}, "halo a face": {:.4f}, "remote": {}}})",
      ranks.size(), faces, options.levels, phases.text(), best, 24e-9 * double(ranks.sum(table.num_points())) / best,
      ranks.sum(table.num_points()), double(ranks.sum(sent)) / faces,
      double(ranks.sum(halo)) / double(job.mesh.vertices.size()) - 1, ranks.sum(table.halo().num_remote()));
  if (ranks.is_first()) fmt::print("{}\n", line);
}

void torus_bench(const Ranks& ranks, const Options& options) {
  Phases phases(ranks);
  const SpreadJob job =
      spread_job(ranks, {.scheme = "catmull-clark"}, torus(ranks, options.rows, options.columns), "torus");
  const BakeRequest request{.rows = TableRows::level, .level = options.levels};
  Patterns patterns(job.scheme);
  const SpreadShards shards = divide(ranks, job, patterns, request, {options.shards, options.runs});
  phases.end("divide");
  const Truth truth(options.rows, options.columns, options.levels);
  std::array<double, 3> sums{};
  std::int64_t points = 0, checked = 0;
  double error = 0, applying = 0;
  const std::span<const double> x(job.mesh.positions.data(), size_t(job.mesh.positions.size()));
  std::vector<double> made;
  for (int number = 0; number < ranks.largest(std::ssize(shards.owned)); ++number) {
    const Shard shard = made_shard(ranks, job, patterns, request, shards, number, true);
    const Halo halo(ranks, job.mesh.vertices, shard.inputs);
    std::vector<double> inputs(3 * shard.inputs.size());
    halo.fetch(x, 3, inputs);
    ranks.together([&] {
      if (shard.patches.empty()) return;
      const double start = seconds();
      made.resize(size_t(3 * shard.table.table.num_points()));
      PatternEvaluator<double>(shard.table.table).apply(inputs, 3, made);
      applying += seconds() - start;
      for (size_t begin = 0; begin < made.size(); begin += 3000) {  // few at a time: sums of billions would lose digits
        std::array<double, 3> some{};
        for (size_t i = begin; i < std::min(begin + 3000, made.size()); i += 3)
          for (size_t c = 0; c < 3; ++c) some[c] += made[i + c];
        for (size_t c = 0; c < 3; ++c) sums[c] += some[c];
      }
      points += shard.table.table.num_points();
      // Faces of the part: what `patches` count.
      std::vector<std::int64_t> faces;
      for (const PatchPlace& patch : shard.patches) faces.resize(std::max(faces.size(), size_t(patch.face) + 1), -1);
      size_t next = 0;
      std::vector<std::pair<Index, size_t>> order;
      for (const PatchPlace& patch : shard.patches) order.emplace_back(patch.face, 0);
      std::ranges::sort(order);
      for (const auto& [face, unused] : order) faces[size_t(face)] = shards.owned[size_t(number)][next++];
      const int some = int(1 + 110000 / (std::int64_t{ranks.size()} * std::ssize(shards.owned)));
      const Checked found = check_some(shard, faces, made, truth, some, unsigned(ranks.rank() * 1000 + number));
      error = std::max(error, found.error), checked += found.points;
    });
  }
  phases.end("produce");
  std::array<double, 3> control{};
  for (Eigen::Index i = 0; i < job.mesh.positions.rows(); ++i)
    for (int c = 0; c < 3; ++c) control[size_t(c)] += job.mesh.positions(i, c);
  double deviation = 0;
  const std::int64_t all = ranks.sum(points);
  for (size_t c = 0; c < 3; ++c)
    deviation =
        std::max(deviation, std::abs(ranks.sum(sums[c]) - std::ldexp(ranks.sum(control[c]), 2 * options.levels)));
  const std::string line = fmt::format(
      R"({{"ranks": {}, "faces": {}, "levels": {}, "shards": {}, {}"applying": {:.3f}, "points": {}, "sampled": {}, "largest error": {:.3g}, "sums off by, a point": {:.3g}}})",
      ranks.size(), job.mesh.faces.size(), options.levels, shards.parts, phases.text(), ranks.largest(applying), all,
      ranks.sum(checked), ranks.largest(error), deviation / double(all));
  if (ranks.is_first()) fmt::print("{}\n", line);
}

}  // namespace

int main(int argc, char** argv) {
  const Ranks ranks(argc, argv);
  Options options;
  CLI::App app("Ranks, faces, time and memory");
  app.require_subcommand(1);
  CLI::App* const file = app.add_subcommand("file", "Read a mesh, bake, apply");
  file->add_option("MESH", options.file)->required();
  CLI::App* const memory = app.add_subcommand("memory", "The same of a torus that is made");
  CLI::App* const torus = app.add_subcommand("torus", "Produce level k of a torus, shard by shard, and check it");
  for (CLI::App* const sub : {memory, torus}) {
    sub->add_option("ROWS", options.rows)->required();
    sub->add_option("COLUMNS", options.columns)->required();
  }
  for (CLI::App* const sub : {file, memory, torus}) {
    sub->add_option("-l,--levels", options.levels);
    sub->add_option("--shards", options.shards);
    sub->add_option("--frames", options.frames);
    sub->add_flag("--runs", options.runs, "Runs of faces instead of PT-Scotch");
  }
  CLI11_PARSE(app, argc, argv);
  return ranks.run([&] { torus->parsed() ? torus_bench(ranks, options) : file_bench(ranks, options); });
}
