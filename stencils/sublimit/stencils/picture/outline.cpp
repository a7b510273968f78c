// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sublimit::picture {
namespace {

/// Leaves out points that are within a tenth of a pixel of the chord.
void write(svg::Path& path, const std::vector<Spot>& loop) {
  const auto off_chord = [](Spot a, Spot b, Spot p) {
    const double x = b.x - a.x, y = b.y - a.y, length = std::hypot(x, y);
    if (length == 0) return std::hypot(p.x - a.x, p.y - a.y);
    return std::abs(x * (p.y - a.y) - y * (p.x - a.x)) / length;
  };
  if (loop.size() < 3) return;
  path.move(loop[0]);
  std::size_t last = 0;
  for (std::size_t i = 2; i <= loop.size(); ++i) {
    const Spot next = loop[i % loop.size()];
    bool straight = i - last < 24;
    for (std::size_t k = last + 1; straight && k < i; ++k) straight = off_chord(loop[last], next, loop[k]) < 1;
    if (straight) continue;
    path.line(loop[i - 1]);
    last = i - 1;
  }
  path.close();
}

}  // namespace

std::string Outline::data() {
  const std::vector<Step> edges = what_is_left();
  svg::Path path;
  std::vector<bool> used(edges.size(), false);
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (used[first]) continue;
    std::vector<Spot> loop;
    for (std::size_t e = first;
         !used[e];) {  // as many edges leave a point as arrive there, so the walk ends where it began
      used[e] = true;
      loop.push_back(edges[e].from);
      const auto starts_before = [](const Step& edge, Spot at) { return edge.from < at; };
      e = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), edges[e].to, starts_before) -
                                   edges.begin());
      while (used[e] && e + 1 < edges.size() && edges[e + 1].from == edges[e].from) ++e;
    }
    write(path, loop);
  }
  return path.data();
}

std::vector<Outline::Step> Outline::what_is_left() {
  const auto before = [](const Segment& a, const Segment& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  };
  std::sort(segments_.begin(), segments_.end(), before);
  std::vector<Step> left;
  for (std::size_t i = 0; i < segments_.size();) {
    const Segment first = segments_[i];
    int uses = 0;
    for (; i < segments_.size() && segments_[i].low == first.low && segments_[i].high == first.high; ++i)
      uses += segments_[i].uses;
    for (; uses > 0; --uses) left.push_back({first.low, first.high});
    for (; uses < 0; ++uses) left.push_back({first.high, first.low});
  }
  std::sort(left.begin(), left.end());
  return left;
}

}  // namespace sublimit::picture
