// SPDX-License-Identifier: Apache-2.0
#include "meshes/places.h"

#include <random>

namespace sublimit::testing {

std::vector<Place> random_places(const Addresses& addresses, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Place> result;
  const auto binary = [&] { return double(1 + random() % 1023) / 1024; };
  while (int(result.size()) < count) {
    const double u = binary(), v = binary();
    if (!addresses.triangles() || u + v < 1)
      result.push_back({Index(random() % std::uint32_t(addresses.size())), u, v});
  }
  return result;
}

Place from_corner(const Topology& t, const Addresses& addresses, HalfEdge corner, double a, double b) {
  const Face f = t.face(corner);
  const Index k = t.corner_index(corner), first = addresses.first(f);
  if (addresses.triangles())
    return k == 0 ? Place{first, a, b} : k == 1 ? Place{first, 1 - a - b, a} : Place{first, b, 1 - a - b};
  if (t.size(f) != 4) return {first + k, a, b};
  return k == 0   ? Place{first, a, b}
         : k == 1 ? Place{first, 1 - b, a}
         : k == 2 ? Place{first, 1 - a, 1 - b}
                  : Place{first, b, 1 - a};
}

Place on_edge(const Topology& t, const Addresses& addresses, HalfEdge edge, double s) {
  if (addresses.triangles() || t.size(t.face(edge)) == 4) return from_corner(t, addresses, edge, s, 0);
  // The squares of both ends have half of it.
  return s <= 0.5 ? from_corner(t, addresses, edge, 2 * s, 0) : from_corner(t, addresses, t.next(edge), 0, 2 - 2 * s);
}

}  // namespace sublimit::testing
