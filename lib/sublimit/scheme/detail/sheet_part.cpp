// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/sheet_part.h"

#include <algorithm>
#include <vector>

namespace sublimit {

bool are_sheets_apart(const Topology& t, const Sharpness& sharpness, Vertex v) {
  if (!t.is_nonmanifold(v)) return false;
  const float own = sharpness.vertex[index(v)];
  if (is_semi_sharp(own)) return false;
  if (is_infinite(own) && sharpness.creasing == Creasing::uniform) return true;
  std::vector<Edge> sharp = t.edges(v);
  const auto value = [&](Edge e) { return sharpness.edge[index(e)]; };
  if (std::ranges::any_of(sharp, [&](Edge e) { return is_semi_sharp(value(e)); })) return false;
  if (is_infinite(own)) return true;
  std::erase_if(sharp, [&](Edge e) { return !is_sharp(value(e)); });
  std::ranges::sort(sharp);
  sharp.erase(std::unique(sharp.begin(), sharp.end()), sharp.end());
  return std::ranges::all_of(t.fans(v), [&](HalfEdge fan) {
    std::vector<Edge> met;
    for_each_in_fan(t, fan, [&](HalfEdge h) {
      for (const Edge e : {t.edge(h), t.edge(t.prev(h))})
        if (is_sharp(value(e))) met.push_back(e);
    });
    std::ranges::sort(met);
    met.erase(std::unique(met.begin(), met.end()), met.end());
    return met == sharp;
  });
}

bool may_part_sheets(const Level& level) {
  return level.made_by && level.made_by->period == 1 && level.intervals.empty() && !level.topology().is_manifold() &&
         std::ranges::none_of(level.made_by->steps, [](const Step<double>& s) { return s.masks.wide_borders; });
}

}  // namespace sublimit
