// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_set>

#include "sublimit/scheme/detail/sheet_part.h"

namespace sublimit {

Index PieceWalker::slot(HalfEdge h, bool& is_new) {
  const Index v = index(t_->tail(h));
  is_new = stamp_[v] != now_;
  if (is_new) {
    stamp_[v] = now_;
    slot_[v] = static_cast<std::uint32_t>(walk_.vertices.size());
    walk_.vertices.push_back(v);
  }
  return static_cast<Index>(slot_[v]);
}

const PieceWalk& PieceWalker::walk(const Topology& t, const Sharpness& sharpness, const Piece& piece, int rings,
                                   int phase, bool apart) {
  if (t_ != &t || stamp_.size() != size_t(t.num_vertices()) || now_ == ~0u) {
    t_ = &t;
    stamp_.assign(t.num_vertices(), 0);
    slot_.resize(t.num_vertices());
    now_ = 0;
  }
  ++now_;
  walk_.vertices.clear();
  found_at_.clear();
  std::vector<std::uint32_t>& words = walk_.signature;
  words.clear();
  const auto put = [&](auto value) { words.push_back(static_cast<std::uint32_t>(value)); };
  walk_.decays = false;
  const auto put_sharpness = [&](float value) {
    words.push_back(std::bit_cast<std::uint32_t>(value));
    walk_.decays |= is_sharp(value) && !is_infinite(value);
  };
  walk_.rings = rings;
  walk_.apart = apart;
  const bool manifold = t.is_manifold();
  std::map<Edge, HalfEdge> first_at;  // non-manifold edges, by which face they were met
  std::unordered_set<Index> met;      // half-edges of sheets that are apart
  const auto meet = [&](HalfEdge h) {
    bool is_new = false;
    const Index own = slot(h, is_new);
    if (apart && are_sheets_apart(t, sharpness, t.tail(h))) {
      is_new = !met.contains(index(h));
      if (is_new) for_each_in_fan(t, h, [&](HalfEdge g) { met.insert(index(g)); });
    }
    if (is_new) found_at_.push_back(h);
    return own;
  };
  put(4 * phase + int(piece.kind) + (sharpness.creasing == Creasing::chaikin ? 1 << 16 : 0));

  HalfEdge h = piece.start;
  if (piece.kind == Piece::Kind::corner) {
    meet(h);
  } else {
    do {
      meet(h);
      h = t.next(h);
    } while (h != piece.start);
  }
  // The size of its own face, since the walk below counts corners from there.
  put(t.size(t.face(piece.start)));

  size_t next = 0;     // places before it have been walked around
  Index in_order = 0;  // slots before it, on one sheet at least
  for (int ring = 0; ring < rings; ++ring) {
    const size_t end = found_at_.size();
    for (; next < end; ++next) {
      const Vertex v = t.tail(found_at_[next]);
      if (slot_[index(v)] == std::uint32_t(in_order))
        ++in_order;
      else
        put(0xc0000000u + slot_[index(v)]);  // another sheet of a point: no sharpness begins like that
      const float own = sharpness.vertex[index(v)];
      // Inside a mesh there is one fan, and it is closed.
      const bool inside = !t.is_nonmanifold(v) && exists(t.twin(t.outgoing(v)));
      const auto fan = [&](HalfEdge from) {
        // Clockwise to the first half-edge of the fan, if it is open.
        HalfEdge first = from;
        std::uint32_t back = 0;
        while (!inside && exists(t.twin(first))) {
          first = t.next(t.twin(first));
          if (first == from) break;
          ++back;
        }
        const bool open = !exists(t.twin(first));
        if (!open) first = from, back = 0;
        const size_t head = words.size();
        put(0);
        std::uint32_t faces = 0;
        bool sharp = false;
        HalfEdge g = first;
        for (;;) {
          ++faces;
          sharp |= sharpness.edge[index(t.edge(g))] > 0;
          put(t.size(t.face(g)));
          HalfEdge k = t.next(g);
          do {
            put(meet(k));
            // Two faces that share both ends of an edge share the edge, unless it has others that are not walked to.
            if (!manifold && t.is_nonmanifold(t.edge(k)) && first_at.try_emplace(t.edge(k), k).first->second != k)
              put(0xe0000000u);
            k = t.next(k);
          } while (k != g);
          const HalfEdge into = t.prev(g);
          if (!exists(t.twin(into))) {
            sharp |= sharpness.edge[index(t.edge(into))] > 0;
            break;
          }
          g = t.twin(into);
          if (g == first) break;
        }
        words[head] = (faces << 10) + (back << 2) + (open ? 2 : 0) + (sharp ? 1 : 0);
        if (!sharp) return;
        g = first;
        for (std::uint32_t i = 0; i < faces; ++i) {
          put_sharpness(sharpness.edge[index(t.edge(g))]);
          if (!exists(t.twin(t.prev(g))))
            put_sharpness(sharpness.edge[index(t.edge(t.prev(g)))]);
          else
            g = t.twin(t.prev(g));
        }
      };
      if (!t.is_nonmanifold(v) || (apart && are_sheets_apart(t, sharpness, v))) {
        put_sharpness(own);
        fan(found_at_[next]);
        continue;
      }
      // The fan that led here, then the others; edges that have no single other side by their own numbers.
      put_sharpness(own);
      const std::vector<HalfEdge> fans = t.fans(v);
      put(0x80000000u + static_cast<std::uint32_t>(fans.size()));
      HalfEdge own_first = found_at_[next];
      while (exists(t.twin(own_first))) {
        own_first = t.next(t.twin(own_first));
        if (own_first == found_at_[next]) break;
      }
      fan(found_at_[next]);
      for (const HalfEdge start : fans) {
        bool same = start == own_first;
        for (HalfEdge g = start; !same;) {
          same = g == found_at_[next];
          g = t.ccw(g);
          if (!exists(g) || g == start) break;
        }
        if (!same) fan(start);
      }
      for (const Edge e : t.edges(v)) {
        put_sharpness(sharpness.edge[index(e)]);
        put(t.half_edges(e).size());
      }
    }
  }
  walk_.inner = next;
  return walk_;
}

bool PieceWalker::add_intervals(const KnotIntervals& intervals, const Piece& piece, size_t points) {
  const Topology& t = *t_;
  std::vector<std::uint32_t>& words = walk_.signature;
  const double own = intervals.length[knot_entry(intervals.owner, t, piece.start)];
  int exponent = 0;
  std::frexp(own, &exponent);
  const auto put = [&](double length) {
    const auto bits = std::bit_cast<std::uint64_t>(std::ldexp(length, -exponent));
    words.push_back(static_cast<std::uint32_t>(bits));
    words.push_back(static_cast<std::uint32_t>(bits >> 32));
  };
  bool differ = false;
  unsigned all_ends = 0;
  const auto put_entry = [&](size_t entry, bool turned) {
    const unsigned ends = intervals.ends.empty() ? 0 : intervals.ends[entry];
    put(intervals.length[entry]);
    words.push_back(turned ? (ends & 5) << 1 | (ends & 10) >> 1 : ends);
    differ |= intervals.length[entry] != own;
    all_ends |= ends;
  };
  const bool of_points = intervals.owner == KnotOwner::point;
  const auto put_edge = [&](HalfEdge h) {
    const size_t entry = knot_entry(intervals.owner, t, h);
    put_entry(entry, !of_points && !t.forward(h));
    if (of_points) put_entry(other_end(entry), false);
  };
  // Of every face around these points, as the walk came to it.
  for (size_t i = 0; i < points; ++i)
    for (const HalfEdge start : t.fans(Vertex{walk_.vertices[i]})) {
      HalfEdge from = start;
      for (HalfEdge h = start; exists(h);) {
        if (h == found_at_[i]) from = h;
        h = t.ccw(h);
        if (h == start) break;
      }
      if (!exists(t.twin(start))) from = start;  // an open fan has a first half-edge
      HalfEdge h = from;
      do {
        HalfEdge k = h;
        do {
          put_edge(k);
          k = t.next(k);
        } while (k != h);
        h = t.ccw(h);
      } while (exists(h) && h != from);
    }
  if (!differ && (all_ends == 0 || own == intervals.least)) return false;
  put(all_ends == 0 ? 0 : intervals.least);
  words.push_back(intervals.plain);
  return true;
}

const PieceWalk& PieceWalker::walk(const Topology& t, const Sharpness& sharpness, const Piece& piece, int rings,
                                   int phase) {
  return walk(t, sharpness, piece, rings, phase, false);
}

const PieceWalk& PieceWalker::walk(const Level& level, const Piece& piece, int rings, int period) {
  const int phase = level.number % period;
  if (!level.intervals.empty()) {
    constexpr int needed = 2;  // knots of two spans beyond a piece
    walk(level.topology(), level.sharpness, piece, std::max(rings, needed), phase);
    if (add_intervals(level.intervals, piece, walk_.inner)) return walk_;
  }
  return walk(level.topology(), level.sharpness, piece, rings, phase, may_part_sheets(level));
}

}  // namespace sublimit
