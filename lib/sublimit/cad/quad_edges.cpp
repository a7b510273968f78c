// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/quad_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/nets/place_numbers.h"
#include "sublimit/patches/detail/blossom.h"
#include "sublimit/surface/detail/limit_patches.h"

namespace sublimit {
namespace {

/// Nets meet up to rounding, relative to their size.
constexpr double net_rounding = 1e-13;

struct SidePoint {
  Index place;
  double along;
};

CellCorner middle_of(const CellCorner& a, const CellCorner& b) { return {(a.i + b.i) / 2, (a.j + b.j) / 2}; }

/// Places between the ends of a side, as `tessellate` finds them: halves, and halves of these.
void add_places_between(const PlaceNumbers& places, Index address, const CellCorner& a, const CellCorner& b,
                        double begin, double end, std::vector<SidePoint>& out) {
  if ((a.i + b.i) % 2 != 0 || (a.j + b.j) % 2 != 0) return;
  const CellCorner middle = middle_of(a, b);
  const Index place = places.find(address, middle);
  if (place < 0) return;
  const double at = (begin + end) / 2;
  add_places_between(places, address, a, middle, begin, at, out);
  out.push_back({place, at});
  add_places_between(places, address, middle, b, at, end, out);
}

/// The corners of a quad that are corners or middles of its cell's sides.
std::array<CellCorner, 4> outer_corners(const LimitQuad& q) {
  if (q.third < 0) return q.cell;
  const auto k = size_t(q.third);
  return {q.cell[k], middle_of(q.cell[k], q.cell[(k + 1) % 3]), {}, middle_of(q.cell[(k + 2) % 3], q.cell[k])};
}
bool is_inner_side(const LimitQuad& q, int side) { return q.third >= 0 && (side == 1 || side == 2); }

/// Coefficients of the part of a curve from `begin` to `end`.
Points part_of(const Points& net, double begin, double end) {
  if (begin == 0 && end == 1) return net;
  const int d = static_cast<int>(net.rows()) - 1;
  Points part(d + 1, 3);
  std::vector<double> w(size_t(d) + 1);
  for (int k = 0; k <= d; ++k) {
    w[0] = 1;
    for (int q = 1; q <= d; ++q)
      blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::point(q <= k ? end : begin), w.data());
    part.row(k).setZero();
    for (int i = 0; i <= d; ++i) part.row(k) += w[size_t(i)] * net.row(i);
  }
  return part;
}

Points side_net(const LimitQuad& q, int side) {
  Points net(q.degree + 1, 3);
  for (int i = 0; i <= q.degree; ++i) net.row(i) = q.net.row(turned_row(q.degree, side, i, 0));
  return net;
}

class EdgeFinder {
 public:
  EdgeFinder(const LimitMap& surface, const std::vector<LimitQuad>& quads)
      : parts_(surface.parts()),
        quads_(quads),
        corners_(parts_),
        middles_(parts_),
        all_cut_(parts_.types->pieces().regular_smoothness() == 0) {}

  QuadEdges find() {
    std::vector<std::array<Index, 4>> at(quads_.size());
    for (size_t q = 0; q < quads_.size(); ++q) {
      const std::array<CellCorner, 4> outer = outer_corners(quads_[q]);
      for (size_t k = 0; k < 4; ++k)
        at[q][k] = quads_[q].third >= 0 && k == 2 ? corners_.add_inside(quads_[q].cell_number, 3)
                                                  : corners_.add(quads_[q].address, outer[k]);
    }
    made_.sides.resize(quads_.size());
    for (size_t q = 0; q < quads_.size(); ++q)
      for (int side = 0; side < 4; ++side) add_side(Index(q), side, at[q][size_t(side)], at[q][size_t(side + 1) % 4]);
    made_.vertices.setZero(corners_.size(), 3);
    for (QuadEdge& edge : made_.edges) finish(edge);
    return std::move(made_);
  }

 private:
  void add_side(Index q, int side, Index start, Index end) {
    const LimitQuad& quad = quads_[size_t(q)];
    const std::array<CellCorner, 4> outer = outer_corners(quad);
    const CellCorner &a = outer[size_t(side)], &b = outer[size_t(side + 1) % 4];
    std::vector<SidePoint> points{{start, 0}};
    if (!is_inner_side(quad, side)) add_places_between(corners_, quad.address, a, b, 0, 1, points);
    points.push_back({end, 1});
    for (size_t m = 0; m + 1 < points.size(); ++m) {
      const double begin = points[m].along, finish = points[m + 1].along;
      Index number = 0;
      bool sharp = all_cut_;
      if (is_inner_side(quad, side)) {
        // The side from the middle of (k, k + 1) inwards is that of the next third, outwards.
        const int k = side == 1 ? quad.third : (quad.third + 2) % 3;
        number = middles_.add_inside(quad.cell_number, k);
        sharp = false;
      } else {
        const double t = (begin + finish) / 2;
        const CellCorner middle{static_cast<std::int32_t>(std::lround(a.i + t * (b.i - a.i))),
                                static_cast<std::int32_t>(std::lround(a.j + t * (b.j - a.j)))};
        number = middles_.add(quad.address, middle);
        sharp = sharp || is_sharp(quad.address, a, b);
      }
      if (number == static_cast<Index>(made_.edges.size())) {
        made_.edges.push_back({points[m].place, points[m + 1].place});
        made_.edges.back().length = (finish - begin) * quad.size;
      }
      QuadEdge& edge = made_.edges[size_t(number)];
      edge.is_sharp = edge.is_sharp || sharp;
      edge.uses.push_back({q, side, begin, finish, edge.start != points[m].place});
      made_.sides[size_t(q)][size_t(side)].push_back(number);
    }
  }

  /// Whether a side lies on a sharp edge of the mesh.
  bool is_sharp(Index address, const CellCorner& a, const CellCorner& b) const {
    const Topology& t = parts_.level.topology();
    const Addresses::FaceCorner at = parts_.addresses.place(address);
    const bool low_u = a.i == 0 && b.i == 0, low_v = a.j == 0 && b.j == 0;
    const auto cut = [&](HalfEdge h) { return is_cut(t, parts_.level.sharpness, h); };
    if (at.corner >= 0) {
      const HalfEdge h = t.corner(at.face, at.corner);
      return (low_v && cut(h)) || (low_u && cut(t.prev(h)));
    }
    const HalfEdge h = t.first(at.face);
    if (low_v) return cut(h);
    if (low_u) return cut(t.prev(h));
    if (parts_.addresses.triangles()) return a.i + a.j == cell_steps && b.i + b.j == cell_steps && cut(t.next(h));
    if (a.i == cell_steps && b.i == cell_steps) return cut(t.next(h));
    return a.j == cell_steps && b.j == cell_steps && cut(t.next(t.next(h)));
  }

  void finish(QuadEdge& edge) {
    const auto rank = [&](const QuadSide& use) {
      return (quads_[size_t(use.quad)].is_exact ? 0 : 2) + (use.begin == 0 && use.end == 1 ? 0 : 1);
    };
    const QuadSide& best = *std::ranges::min_element(edge.uses, {}, rank);
    edge.net = part_of(side_net(quads_[size_t(best.quad)], best.side), best.begin, best.end);
    if (best.reversed) edge.net = Points(edge.net.colwise().reverse());
    made_.vertices.row(edge.start) = edge.net.row(0);
    made_.vertices.row(edge.end) = edge.net.row(edge.net.rows() - 1);
    if (edge.uses.size() < 2) edge.is_sharp = true;
    edge.is_smooth = edge.uses.size() == 2 && edge.uses[0].reversed != edge.uses[1].reversed && !edge.is_sharp &&
                     join(edge.uses[0], edge.uses[1]);
  }

  /// Whether differences across the side agree up to order degree - 1.
  bool join(const QuadSide& a, const QuadSide& b) const {
    const LimitQuad &p = quads_[size_t(a.quad)], &q = quads_[size_t(b.quad)];
    if (&p == &q || !p.is_exact || !q.is_exact || p.degree != q.degree || p.size != q.size || p.third >= 0 ||
        q.third >= 0 || a.begin != 0 || a.end != 1 || b.begin != 0 || b.end != 1)
      return false;
    const int d = p.degree;
    const double size = (p.net.rowwise() - p.net.row(0)).cwiseAbs().maxCoeff() +
                        (q.net.rowwise() - p.net.row(0)).cwiseAbs().maxCoeff() + p.net.cwiseAbs().maxCoeff() * 1e-2;
    for (int along = 0; along <= d; ++along) {
      Points before(d + 1, 3), after(d + 1, 3);  // towards the side, and away from it
      for (int k = 0; k <= d; ++k) {
        before.row(d - k) = p.net.row(turned_row(d, a.side, along, k));
        after.row(k) = q.net.row(turned_row(d, b.side, d - along, k));
      }
      double scale = size;
      for (int order = 0; order < d; ++order, scale *= 2) {
        if ((before.row(d - order) - after.row(0)).cwiseAbs().maxCoeff() > 16 * net_rounding * scale) return false;
        for (int k = 0; k < d - order; ++k) {
          before.row(k) = (before.row(k + 1) - before.row(k)).eval();
          after.row(k) = (after.row(k + 1) - after.row(k)).eval();
        }
      }
    }
    return true;
  }

  const LimitMap::Parts& parts_;
  const std::vector<LimitQuad>& quads_;
  PlaceNumbers corners_, middles_;
  bool all_cut_;
  QuadEdges made_;
};

}  // namespace

QuadEdges quad_edges(const LimitMap& surface, const std::vector<LimitQuad>& quads) {
  return EdgeFinder(surface, quads).find();
}

}  // namespace sublimit
