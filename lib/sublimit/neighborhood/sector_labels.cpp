// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/sector_labels.h"

#include <array>
#include <set>
#include <vector>

namespace sublimit {
namespace {

/// A half-edge in a plane: where its tail is, and the direction it goes in.
struct Placed {
  HalfEdge h;
  int x2, y2, direction;
};

constexpr std::array<std::array<int, 2>, 4> quad_steps{{{2, 0}, {0, 2}, {-2, 0}, {0, -2}}};
constexpr std::array<std::array<int, 2>, 6> triangle_steps{{{2, 0}, {0, 2}, {-2, 2}, {-2, 0}, {0, -2}, {2, -2}}};

/// Unfolds faces into the plane, from the one left of `seed` on, while `keep` says so of the corners.
template <class Keep, class Found>
void unfold(const Topology& t, Placed seed, const Keep& keep, const Found& found) {
  std::vector<Placed> open{seed};
  std::set<Index> seen;
  while (!open.empty()) {
    Placed at = open.back();
    open.pop_back();
    if (!exists(at.h) || !seen.insert(index(t.face(at.h))).second) continue;
    const bool triangle = t.size(t.face(at.h)) == 3;
    const int turns = triangle ? 6 : 4, turn = triangle ? 2 : 1;
    std::vector<Placed> sides;
    bool inside = true;
    for (Index k = 0; k < t.size(t.face(at.h)); ++k) {
      inside &= keep(at.x2, at.y2);
      sides.push_back(at);
      const auto& step = triangle ? triangle_steps[at.direction] : quad_steps[at.direction];
      at = {t.next(at.h), at.x2 + step[0], at.y2 + step[1], (at.direction + turn) % turns};
    }
    if (!inside) continue;
    for (size_t k = 0; k < sides.size(); ++k) {
      const Placed& side = sides[k];
      const Placed& next = sides[(k + 1) % sides.size()];
      found(index(t.tail(side.h)), side.x2, side.y2);
      open.push_back({t.twin(side.h), next.x2, next.y2, (side.direction + turns / 2) % turns});
    }
  }
}

}  // namespace

std::map<Index, SectorLabel> sector_labels(const Topology& t, const Centre& centre, int reach) {
  std::map<Index, SectorLabel> labels;
  const bool triangle = centre.kind == Centre::Kind::vertex && t.size(t.face(centre.start)) == 3;
  const int far = 2 * reach;
  if (centre.kind == Centre::Kind::border) {
    unfold(
        t, {centre.start, -1, 0, 0}, [&](int x2, int y2) { return std::abs(x2) <= far && y2 >= 0 && y2 <= far; },
        [&](Index v, int x2, int y2) {
          labels.try_emplace(v, SectorLabel{0, x2, y2});
        });
    return labels;
  }
  const auto within = [&](int x2, int y2) {
    return x2 >= 0 && y2 >= 0 && (triangle ? x2 + y2 : std::max(x2, y2)) <= far;
  };
  if (centre.kind == Centre::Kind::face) {
    HalfEdge g = centre.start;
    int sector = 0;
    do {
      labels.try_emplace(index(t.tail(g)), SectorLabel{sector, 1, 1});
      if (exists(t.twin(g)))
        unfold(
            t, {t.twin(t.next(t.twin(g))), 1, 3, 3}, [&](int x2, int y2) { return x2 > 0 && y2 > 0 && within(x2, y2); },
            [&](Index v, int x2, int y2) {
              labels.try_emplace(v, SectorLabel{sector, x2, y2});
            });
      g = t.next(g);
      ++sector;
    } while (g != centre.start);
    return labels;
  }
  labels.try_emplace(index(t.tail(centre.start)), SectorLabel{});
  HalfEdge spoke = centre.start;
  int sector = 0;
  do {
    unfold(t, {spoke, 0, 0, 0}, within, [&](Index v, int x2, int y2) {
      if (x2 > 0) labels.try_emplace(v, SectorLabel{sector, x2, y2});
    });
    const HalfEdge next = t.ccw(spoke);
    if (!exists(next))
      unfold(t, {spoke, 0, 0, 0}, within, [&](Index v, int x2, int y2) {
        if (x2 == 0 && y2 > 0) labels.try_emplace(v, SectorLabel{sector + 1, y2, 0});
      });
    spoke = next;
    ++sector;
  } while (exists(spoke) && spoke != centre.start);
  return labels;
}

}  // namespace sublimit
