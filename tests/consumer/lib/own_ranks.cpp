// SPDX-License-Identifier: Apache-2.0
// A program for many processes, of the user's own: a mesh made in runs, a table of it in parts, applied.
#include <cmath>
#include <cstdio>

#include "sublimit/distributed/shard_jobs.h"

int main(int argc, char** argv) {
  const sublimit::Ranks ranks(argc, argv);
  return ranks.run([&] {
    sublimit::ControlMesh torus;
    constexpr int n = 8;
    torus.positions.resize(n * n, 3);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double a = 2 * M_PI * i / n, b = 2 * M_PI * j / n;
        torus.positions.row(i * n + j) << (2 + std::cos(b)) * std::cos(a), (2 + std::cos(b)) * std::sin(a), std::sin(b);
        torus.face_sizes.push_back(4);
        for (const auto& [p, q] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
          torus.face_vertices.push_back((i + p) % n * n + (j + q) % n);
      }
    const auto job = sublimit::spread_job(ranks, {.scheme = "catmull-clark"}, sublimit::spread(ranks, torus), "torus");
    const sublimit::BakeRequest request{.rows = sublimit::TableRows::level, .level = 2};
    sublimit::Patterns patterns(job.scheme);
    const auto parts = sublimit::divide(ranks, job, patterns, request, {});
    auto shard = sublimit::made_shard(ranks, job, patterns, request, parts, 0, true);
    std::vector<sublimit::LoadedShard> own;
    own.push_back({std::move(shard.table), std::move(shard.inputs), std::move(shard.runs), {}});
    const sublimit::SpreadTable table(ranks, std::move(own), job.mesh.vertices);
    std::vector<double> points(size_t(3 * table.num_points()));
    table.apply({job.mesh.positions.data(), size_t(job.mesh.positions.size())}, 3, points);
    double sum = 0;
    for (const double x : points) sum += std::abs(x);
    const double all = ranks.sum(sum);
    if (ranks.is_first()) std::printf("%lld points\n", static_cast<long long>(parts.num_points));
    if (parts.num_points != 16 * n * n || !(all > 0)) throw std::runtime_error("a torus of 64 faces has 1024 points");
  });
}
