// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/packing.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace sublimit {
namespace {

class Packer {
 public:
  Packer(const std::vector<LimitQuad>& quads, const QuadEdges& edges, const std::vector<Index>& names)
      : edges_(edges), names_(names), taken_(quads.size(), false) {}

  QuadRectangle grow(Index seed, bool pack) {
    QuadRectangle r{{{seed, 0}}};
    taken_[size_t(seed)] = true;
    if (!pack) return r;
    vertices_.clear();
    for (int k = 0; k < 4; ++k) vertices_.insert(corner(r[0][0], k));
    for (int stopped = 0, side = 0; stopped < 4; side = (side + 1) % 4) stopped = extend(r, side) ? 0 : stopped + 1;
    return r;
  }
  bool is_taken(Index quad) const { return taken_[size_t(quad)]; }

 private:
  /// The quad beyond a side, turned alike, if both are parts of one B-spline.
  std::optional<TurnedQuad> beyond(const TurnedQuad& q, int side) const {
    const int own = (side + q.turn) % 4;
    const std::vector<Index>& on_side = edges_.sides[size_t(q.quad)][size_t(own)];
    if (on_side.size() != 1) return std::nullopt;
    const QuadEdge& edge = edges_.edges[size_t(on_side[0])];
    if (!edge.is_smooth) return std::nullopt;
    const QuadSide& other = edge.uses[edge.uses[0].quad == q.quad ? 1 : 0];
    if (!names_.empty() && names_[size_t(q.quad)] != names_[size_t(other.quad)]) return std::nullopt;
    return TurnedQuad{other.quad, (other.side - (side + 2) % 4 + 8) % 4};
  }
  /// Vertex at a corner.
  Index corner(const TurnedQuad& q, int k) const {
    const int own = (k + q.turn) % 4;
    const Index first = edges_.sides[size_t(q.quad)][size_t(own)].front();
    const QuadEdge& edge = edges_.edges[size_t(first)];
    for (const QuadSide& use : edge.uses)
      if (use.quad == q.quad && use.side == own) return use.reversed ? edge.end : edge.start;
    return -1;
  }

  bool extend(QuadRectangle& r, int side) {
    const bool column = side % 2 == 1;
    const size_t count = column ? r.size() : r[0].size();
    std::vector<TurnedQuad> strip;
    std::vector<Index> vertices;
    // Corners of the new quads on the far side, in the order of the strip.
    const int near_corner = side == 0   ? 0
                            : side == 1 ? 1
                            : side == 2 ? 3
                                        : 0,
              far_corner = side == 3   ? 3
                           : side == 0 ? 1
                                       : 2;
    for (size_t m = 0; m < count; ++m) {
      const TurnedQuad& from =
          column ? (side == 1 ? r[m].back() : r[m].front()) : (side == 2 ? r.back()[m] : r.front()[m]);
      const std::optional<TurnedQuad> next = beyond(from, side);
      if (!next || taken_[size_t(next->quad)]) return false;
      if (m > 0 && beyond(strip.back(), column ? 2 : 1) != next) return false;
      if (m == 0) vertices.push_back(corner(*next, near_corner));
      vertices.push_back(corner(*next, far_corner));
      strip.push_back(*next);
    }
    std::set<Index> fresh(vertices.begin(), vertices.end());
    if (fresh.size() < vertices.size()) return false;
    for (const Index v : fresh)
      if (vertices_.contains(v)) return false;
    vertices_.merge(fresh);
    for (const TurnedQuad& q : strip) taken_[size_t(q.quad)] = true;
    if (side == 0) r.insert(r.begin(), strip);
    if (side == 2) r.push_back(strip);
    for (size_t m = 0; column && m < count; ++m) r[m].insert(side == 1 ? r[m].end() : r[m].begin(), strip[m]);
    return true;
  }

  const QuadEdges& edges_;
  const std::vector<Index>& names_;
  std::vector<char> taken_;
  std::set<Index> vertices_;
};

}  // namespace

std::vector<QuadRectangle> quad_rectangles(const std::vector<LimitQuad>& quads, const QuadEdges& edges, bool pack,
                                           const std::vector<Index>& names) {
  Packer packer(quads, edges, names);
  std::vector<QuadRectangle> rectangles;
  for (Index q = 0; q < static_cast<Index>(quads.size()); ++q)
    if (!packer.is_taken(q)) rectangles.push_back(packer.grow(q, pack));
  return rectangles;
}

}  // namespace sublimit
