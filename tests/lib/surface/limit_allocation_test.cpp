// SPDX-License-Identifier: Apache-2.0
// Samples of a bound surface into memory that is there take none from the system.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "meshes/meshes.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_surface.h"
#include "support/allocations.h"

namespace sublimit::testing {
namespace {

struct Surface {
  std::string scheme;
  Mesh mesh;
};

/// Surfaces of polynomial pieces: regular, with extraordinary vertices, with polygons, with creases of all kinds,
/// triangles, dual.
std::vector<Surface> surfaces() {
  Mesh creased = cube();
  add_crease(creased, {0, 1, 3}, 2.5f);
  add_crease(creased, {4, 5, 7}, 10);
  return {{"catmull-clark", torus(8, 6)}, {"catmull-clark", cube()}, {"catmull-clark", prism(5)},
          {"catmull-clark", creased},     {"loop", icosahedron()},   {"loop", triangle_grid(4, 3)},
          {"doo-sabin", cube()}};
}

std::vector<Place> random_samples(FaceCount faces, size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> inside(0.01, 0.99);
  std::vector<Place> samples;
  while (samples.size() < count) {
    const Place s{static_cast<Index>(random() % unsigned(faces.size)), inside(random), inside(random)};
    if (!faces.triangles || s.u + s.v < 0.99) samples.push_back(s);
  }
  return samples;
}

TEST(LimitMap, SamplesOnceBoundWithoutMemoryFromTheSystem) {
  if (!allocations_are_counted()) GTEST_SKIP() << "SKIPPED: sanitizers have allocators of their own";
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::int64_t first = 0;
  for (const Surface& s : surfaces()) {
    const LimitMap surface(find_scheme(s.scheme).value(), s.mesh);
    const LimitSurface bound(surface, s.mesh.positions);
    const std::vector<Place> samples = random_samples(surface.faces(), 5000);
    for (const int order : {0, 1, 2}) {
      SCOPED_TRACE(s.scheme + " of " + std::to_string(s.mesh.num_faces()) + " faces, order " + std::to_string(order));
      LimitSamples out;
      const auto allocated = [&] {
        const std::int64_t before = allocations();
        bound.evaluate(samples, order, true, out);
        return allocations() - before;
      };
      first += allocated();
      EXPECT_EQ(allocated(), 0);
    }
  }
  EXPECT_GT(first, 0) << "the counter does not count";
}

}  // namespace
}  // namespace sublimit::testing
