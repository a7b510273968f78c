// SPDX-License-Identifier: Apache-2.0
// A program for many processes, of the user's own: a mesh made in runs, a table of it in parts, applied.
#include <sublimit/distributed/distributed.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

int main(int argc, char** argv) {
  const sublimit::Ranks ranks(argc, argv);
  return ranks.run([&] {
    constexpr int n = 8;  // vertex n i + j of a torus, and the face on its far side
    const int begin = n * ranks.rank() / ranks.size(), end = n * (ranks.rank() + 1) / ranks.size();
    sublimit::MeshRun torus;
    torus.positions.setZero((end - begin) * n, 3);  // weights depend on faces alone
    torus.face_sizes.assign(size_t((end - begin) * n), 4);
    for (int i = begin; i < end; ++i)
      for (int j = 0; j < n; ++j)
        for (const auto& [p, q] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
          torus.face_vertices.push_back((i + p) % n * n + (j + q) % n);
    const sublimit::DistributedTable table = sublimit::bake(ranks, torus, "catmull-clark", {.levels = 2});

    // Weights of a point sum to 1; those of a control point sum to 4 a level, as all of a torus are alike.
    std::vector<double> own(size_t(table.num_control_points()), 1), points(table.num_results(1));
    const auto are_all = [](const std::vector<double>& values, double value) {
      return std::all_of(values.begin(), values.end(), [&](double x) { return std::abs(x - value) < 1e-13; });
    };
    table.apply(own, 1, points);
    const bool stay = are_all(points, 1);
    table.apply_transpose(points, 1, own);
    if (table.all_points() != 16 * n * n || ranks.sum(table.num_points()) != 16 * n * n || !stay || !are_all(own, 16))
      throw std::runtime_error("a torus of 64 faces has 1024 points, and each control point a weight of 16");
    if (ranks.is_first()) std::printf("%lld points\n", static_cast<long long>(table.all_points()));
  });
}
