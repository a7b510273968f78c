// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/detail/limit_patches.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "meshes/places.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::testing {
namespace {

TEST(LimitPatches, RowsOfAlikePlacesAreMadeOnce) {
  const Mesh mesh = jittered(fan(12, 4, 2));
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const Topology& t = surface.level().topology();
  std::vector<Place> samples;
  for (const double distance : {0x1p-30, 0x1p-31}) {
    HalfEdge h = t.outgoing(Vertex{0});
    do {
      samples.push_back(from_corner(t, surface.addresses(), h, distance, distance));
      h = t.ccw(h);
    } while (h != t.outgoing(Vertex{0}));
  }
  const LimitSamples expected = surface.evaluate(mesh.positions, samples, 2);
  LimitSamples found = expected;
  found.position.setZero();
  found.duu.setZero();
  const LimitPatches patches(surface.parts(), mesh.positions);
  EXPECT_EQ(patches.evaluate(samples, 0, std::ssize(samples), 2, true, found), 2);
  EXPECT_EQ(found.position, expected.position);
  EXPECT_EQ(found.duu, expected.duu);
}

}  // namespace
}  // namespace sublimit::testing
