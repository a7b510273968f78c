// SPDX-License-Identifier: Apache-2.0
// Limits next to vertices of many faces, each type of which takes long to find and runs loops of its own meanwhile: by
// many threads from one dictionary, as many as there are types. SUBLIMIT_FULL: sixty of 300 to 1400 faces beside 40,000
// regular faces, twenty times.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "laws/full_sweep.h"
#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::testing {
namespace {

constexpr int num_threads = 8;

struct Size {
  Index poles, least, most;  ///< of so many faces, all different
  Index cells;               ///< a side of the regular grid
  int rounds;
};
Size size() { return full_sweep() ? Size{60, 300, 1400, 200, 20} : Size{4, 20, 60, 10, 3}; }

Mesh poles_beside_a_grid(Index face_size) {
  const Size s = size();
  Mesh mesh = face_size == 3 ? triangle_grid(s.cells, s.cells / 2) : grid(s.cells, s.cells);
  for (Index k = 0; k < s.poles; ++k)
    mesh = disjoint_union(mesh, fan(s.least + k * (s.most - s.least) / (s.poles - 1), face_size));
  return mesh;
}

/// Inside of a face of some poles, and of some of the grid. Not of schemes whose pieces are large, a minute of work
/// each.
std::vector<Place> places(const Level& level, const Scheme<double>& scheme) {
  std::vector<Place> all;
  if (scheme.name == "kobbelt" || scheme.name == "interpolatory-sqrt3") return all;
  const Topology& t = level.topology();
  for (Index f = 0; f < t.num_faces(); f += 1 + t.num_faces() / 20) all.push_back({f, 0.25, 0.25});
  int left = 3;
  for (Index v = 0; v < t.num_vertices() && left > 0; ++v)
    if (t.num_faces(Vertex{v}) >= size().least) {
      all.push_back({index(t.face(t.outgoing(Vertex{v}))), 0.25, 0.25});
      --left;
    }
  return all;
}

/// What a thread asks for: limits of all vertices, and some places of the surface.
struct Found {
  SparseMatrix position, tangent1, tangent2;
  LimitSamples samples;
};

bool same_bits(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()) &&
         std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr());
}
bool same_bits(const Points& a, const Points& b) {
  return a.rows() == b.rows() && std::equal(a.data(), a.data() + a.size(), b.data());
}
bool same_bits(const Found& a, const Found& b) {
  return same_bits(a.position, b.position) && same_bits(a.tangent1, b.tangent1) && same_bits(a.tangent2, b.tangent2) &&
         same_bits(a.samples.position, b.samples.position) && same_bits(a.samples.normal, b.samples.normal) &&
         a.samples.status == b.samples.status;
}

class PolesByThreads : public ::testing::TestWithParam<std::string> {};

TEST_P(PolesByThreads, HaveTheSameBitsFromOneDictionary) {
  const Scheme<double> scheme = find_scheme(GetParam()).value();
  const Mesh mesh = poles_beside_a_grid(scheme.face_size() == 3 ? 3 : 4);
  const Level level = control_level(scheme, mesh);
  const std::vector<Place> all = places(level, scheme);
  const auto find = [&](const std::shared_ptr<LimitCache>& types, size_t first) {
    Found found;
    const auto sample = [&] {  // each thread begins with others
      if (all.empty()) return;
      std::vector<Place> turned(all);
      std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(first * all.size() / num_threads), turned.end());
      const LimitMap surface(scheme, level, types);
      surface.evaluate(mesh.positions, turned, 1);
      found.samples = surface.evaluate(mesh.positions, all, 1);
    };
    if (first % 2) sample();
    LimitMatrices limit = limit_matrices(level, *types);
    found.position = std::move(limit.position);
    found.tangent1 = std::move(limit.tangent1), found.tangent2 = std::move(limit.tangent2);
    if (first % 2 == 0) sample();
    return found;
  };
  using Limit = tbb::global_control;
  Found expected;
  {
    const Limit one(Limit::max_allowed_parallelism, 1);
    expected = find(std::make_shared<LimitCache>(scheme), 0);
  }
  for (int round = 0; round < size().rounds; ++round) {
    constexpr size_t allowed[] = {2, 8, 1};
    const Limit limit(Limit::max_allowed_parallelism, allowed[round % 3]);
    const auto types = std::make_shared<LimitCache>(scheme);
    std::vector<Found> found(num_threads);
    std::vector<std::exception_ptr> failed(num_threads);
    std::vector<std::thread> threads;
    for (size_t k = 0; k < num_threads; ++k)
      threads.emplace_back([&, k] {
        try {
          found[k] = find(types, k);
        } catch (...) {
          failed[k] = std::current_exception();
        }
      });
    for (std::thread& thread : threads) thread.join();
    for (size_t k = 0; k < num_threads; ++k) {
      if (failed[k]) std::rethrow_exception(failed[k]);
      EXPECT_TRUE(same_bits(found[k], expected)) << "thread " << k << ", round " << round;
    }
  }
}

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const Scheme<double>& scheme : all_schemes()) names.push_back(scheme.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Schemes, PolesByThreads, ::testing::ValuesIn(scheme_names()), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace sublimit::testing
