// SPDX-License-Identifier: Apache-2.0
#include "sublimit/parts/closed_surface.h"

#include <algorithm>
#include <map>
#include <utility>

#include "sublimit/surface/detail/limit_map_parts.h"

namespace sublimit {

std::string why_not_closed(const LimitMap& surface) {
  const LimitMap::Parts& parts = surface.parts();
  const Level& level = parts.level;
  const Topology& t = level.topology();
  // Sheets that meet at an edge have the same curve there, unless the scheme keeps them apart: their boundaries cancel
  // if it is walked as often either way.
  std::map<std::pair<Index, Index>, int> walked;
  bool any = false;
  for (Index h = 0; h < t.num_half_edges(); ++h) {
    if (level.holes[size_t(index(t.face(HalfEdge{h})))]) continue;
    any = true;
    const HalfEdge twin = t.twin(HalfEdge{h});
    if (exists(twin) && !level.holes[size_t(index(t.face(twin)))]) continue;
    const Index a = index(t.tail(HalfEdge{h})), b = index(t.head(HalfEdge{h}));
    if (parts.scheme.is_dual())
      walked[{a, b}] = 1;
    else if (a != b)
      walked[std::minmax(a, b)] += a < b ? 1 : -1;
  }
  if (!any) return "there are no faces";
  for (const auto& [edge, times] : walked)
    if (times != 0)
      return "the surface is not closed at edge (" + std::to_string(edge.first) + "," + std::to_string(edge.second) +
             ")";
  return {};
}

}  // namespace sublimit
