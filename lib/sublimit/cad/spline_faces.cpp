// SPDX-License-Identifier: Apache-2.0
// Rectangles of quads as B-splines, and their borders.
#include <algorithm>
#include <map>

#include "sublimit/cad/packing.h"
#include "sublimit/patches/detail/blossom.h"

namespace sublimit {
namespace {

/// Control points of a B-spline with simple knots 0, 1 .. `pieces`, ends clamped, by Bezier pieces: each is a blossom
/// of a piece in the middle of its support.
struct PackedPoles {
  struct Row {
    int piece;
    std::vector<double> weights;
  };
  std::vector<double> knots;
  std::vector<Row> rows;

  PackedPoles(int degree, int pieces, double size) {
    std::vector<double> t(size_t(degree), 0.0);
    for (int k = 0; k <= pieces; ++k) t.push_back(k);
    t.insert(t.end(), size_t(degree), double(pieces));
    for (int a = 0; a < pieces + degree; ++a) {
      const int piece = (std::max(0, a - degree) + std::min(pieces - 1, a)) / 2;
      std::vector<double> arguments(t.begin() + a + 1, t.begin() + a + 1 + degree);
      order_for_span(std::span<double>(arguments), double(piece));
      Row row{piece, std::vector<double>(size_t(degree) + 1)};
      row.weights[0] = 1;
      for (int q = 1; q <= degree; ++q)
        blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::point(arguments[size_t(q - 1)] - piece),
                     row.weights.data());
      rows.push_back(std::move(row));
    }
    for (const double k : t) knots.push_back(k * size);
  }
};

SplineFace surface_of(const QuadRectangle& r, const std::vector<LimitQuad>& quads) {
  const LimitQuad& any = quads[size_t(r[0][0].quad)];
  const int d = any.degree;
  const PackedPoles u(d, static_cast<int>(r[0].size()), any.size), v(d, static_cast<int>(r.size()), any.size);
  SplineFace face{d, d, u.knots, v.knots, Points(Eigen::Index(u.rows.size() * v.rows.size()), 3)};
  face.is_exact = any.is_exact;
  Eigen::Index row = 0;
  for (const PackedPoles::Row& a : u.rows)
    for (const PackedPoles::Row& b : v.rows) {
      const TurnedQuad& at = r[size_t(b.piece)][size_t(a.piece)];
      const Points& net = quads[size_t(at.quad)].net;
      const Eigen::RowVector3d origin = net.row(0);
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
      for (int i = 0; i <= d; ++i)
        for (int j = 0; j <= d; ++j)
          sum += a.weights[size_t(i)] * b.weights[size_t(j)] * (net.row(turned_row(d, at.turn, i, j)) - origin);
      face.poles.row(row++) = origin + sum;
    }
  return face;
}

/// The border of a rectangle by edges of quads.
std::vector<EdgeUse> border_of(const QuadRectangle& r, const std::vector<LimitQuad>& quads, const QuadEdges& edges) {
  const double size = quads[size_t(r[0][0].quad)].size;
  std::vector<EdgeUse> border;
  const auto add = [&](size_t row, size_t column, int side) {
    const TurnedQuad& q = r[row][column];
    const int own = (side + q.turn) % 4;
    const Eigen::Vector2d corner{double(column), double(row)};
    for (const Index e : edges.sides[size_t(q.quad)][size_t(own)])
      for (const QuadSide& use : edges.edges[size_t(e)].uses) {
        if (use.quad != q.quad || use.side != own) continue;
        const auto [bu, bv] = on_side(side, use.begin);
        const auto [eu, ev] = on_side(side, use.end);
        border.push_back(
            {e, use.reversed, (corner + Eigen::Vector2d(bu, bv)) * size, (corner + Eigen::Vector2d(eu, ev)) * size});
      }
  };
  const size_t rows = r.size(), columns = r[0].size();
  for (size_t c = 0; c < columns; ++c) add(0, c, 0);
  for (size_t k = 0; k < rows; ++k) add(k, columns - 1, 1);
  for (size_t c = columns; c-- > 0;) add(rows - 1, c, 2);
  for (size_t k = rows; k-- > 0;) add(k, 0, 3);
  return border;
}

/// Chains edges whose common vertex no other edge has, into longer ones, and leaves out what is not used.
class EdgeChains {
 public:
  EdgeChains(const QuadEdges& edges, BoundaryModel& model) : edges_(edges), model_(model) {}

  void make() {
    std::vector<int> uses(edges_.edges.size(), 0), at(size_t(edges_.vertices.rows()), 0);
    for (const SplineFace& face : model_.faces)
      for (const EdgeUse& use : face.border) ++uses[size_t(use.edge)];
    for (size_t e = 0; e < uses.size(); ++e)
      if (uses[e] > 0) ++at[size_t(edges_.edges[e].start)], ++at[size_t(edges_.edges[e].end)];
    valence_ = std::move(at);
    new_edge_.assign(edges_.edges.size(), -1);
    new_vertex_.assign(valence_.size(), -1);
    // Borders are cut between runs that go on through vertices of two edges, straight and smoothly, in every face.
    std::vector<char> ends(valence_.size(), false);
    for (size_t v = 0; v < ends.size(); ++v) ends[v] = valence_[v] != 2;
    for (const SplineFace& face : model_.faces)
      for (size_t k = 0; k < face.border.size(); ++k) {
        const EdgeUse &a = face.border[k], &b = face.border[(k + 1) % face.border.size()];
        if (!goes_on(a, b)) ends[size_t(end_of(a))] = true;
      }
    for (SplineFace& face : model_.faces) shorten(face, ends);
    std::vector<Eigen::RowVector3d> kept(static_cast<size_t>(count_));
    for (size_t v = 0; v < new_vertex_.size(); ++v)
      if (new_vertex_[v] >= 0) kept[size_t(new_vertex_[v])] = edges_.vertices.row(Eigen::Index(v));
    model_.vertices.resize(count_, 3);
    for (Index v = 0; v < count_; ++v) model_.vertices.row(v) = kept[size_t(v)];
  }

 private:
  Index start_of(const EdgeUse& use) const {
    const QuadEdge& edge = edges_.edges[size_t(use.edge)];
    return use.reversed ? edge.end : edge.start;
  }
  Index end_of(const EdgeUse& use) const {
    const QuadEdge& edge = edges_.edges[size_t(use.edge)];
    return use.reversed ? edge.start : edge.end;
  }
  Points net_of(const EdgeUse& use) const {
    const Points& net = edges_.edges[size_t(use.edge)].net;
    return use.reversed ? Points(net.colwise().reverse()) : net;
  }

  bool goes_on(const EdgeUse& a, const EdgeUse& b) const {
    const QuadEdge &x = edges_.edges[size_t(a.edge)], &y = edges_.edges[size_t(b.edge)];
    if (&x == &y || x.length != y.length || x.is_sharp != y.is_sharp || x.net.rows() != y.net.rows()) return false;
    const Eigen::Vector2d p = a.to - a.from, q = b.to - b.from;
    if (p[0] * q[1] - p[1] * q[0] != 0 || p.dot(q) <= 0) return false;
    Points before = net_of(a), after = net_of(b);
    const int d = static_cast<int>(before.rows()) - 1;
    double scale =
        1e-12 * ((before.rowwise() - before.row(0)).cwiseAbs().maxCoeff() +
                 (after.rowwise() - after.row(0)).cwiseAbs().maxCoeff() + before.cwiseAbs().maxCoeff() * 1e-2);
    for (int order = 0; order < d; ++order, scale *= 2) {
      if ((before.row(d - order) - after.row(0)).cwiseAbs().maxCoeff() > scale) return false;
      for (int k = 0; k < d - order; ++k) {
        before.row(k) = (before.row(k + 1) - before.row(k)).eval();
        after.row(k) = (after.row(k + 1) - after.row(k)).eval();
      }
    }
    return true;
  }

  void shorten(SplineFace& face, const std::vector<char>& ends) {
    const size_t n = face.border.size();
    size_t first = 0;
    while (first < n && !ends[size_t(start_of(face.border[first]))]) ++first;
    if (first == n) first = 0;  // cannot be: corners are ends
    std::vector<EdgeUse> border, run;
    for (size_t m = 0; m < n; ++m) {
      run.push_back(face.border[(first + m) % n]);
      if (!ends[size_t(end_of(run.back()))] && m + 1 < n) continue;
      border.push_back(chain(run));
      run.clear();
    }
    face.border = std::move(border);
  }

  Index vertex(Index old) {
    Index& number = new_vertex_[size_t(old)];
    if (number < 0) number = count_++;
    return number;
  }

  /// A run becomes one edge; the other face has the same run, backwards.
  EdgeUse chain(const std::vector<EdgeUse>& run) {
    Index least = run.front().edge;
    for (const EdgeUse& use : run) least = std::min(least, use.edge);
    const bool is_new = new_edge_[size_t(least)] < 0;
    const Index start = vertex(start_of(run.front())), end = vertex(end_of(run.back()));
    if (is_new) {
      new_edge_[size_t(least)] = static_cast<Index>(model_.edges.size());
      const QuadEdge& any = edges_.edges[size_t(least)];
      const int d = static_cast<int>(any.net.rows()) - 1;
      const PackedPoles packed(d, static_cast<int>(run.size()), any.length);
      SplineEdge edge{start, end, d, packed.knots, Points(Eigen::Index(packed.rows.size()), 3)};
      edge.is_sharp = any.is_sharp;
      for (size_t a = 0; a < packed.rows.size(); ++a) {
        const Points net = net_of(run[size_t(packed.rows[a].piece)]);
        const Eigen::RowVector3d origin = net.row(0);
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (int i = 0; i <= d; ++i) sum += packed.rows[a].weights[size_t(i)] * (net.row(i) - origin);
        edge.poles.row(Eigen::Index(a)) = origin + sum;
      }
      for (const EdgeUse& use : run) edge.gap = std::max(edge.gap, edges_.edges[size_t(use.edge)].gap);
      model_.edges.push_back(std::move(edge));
      first_reversed_.push_back(run.front().edge == least ? run.front().reversed : along(run, least).reversed);
    }
    const Index number = new_edge_[size_t(least)];
    const bool reversed = along(run, least).reversed != bool(first_reversed_[size_t(number)]);
    return {number, reversed, run.front().from, run.back().to};
  }
  static const EdgeUse& along(const std::vector<EdgeUse>& run, Index edge) {
    return *std::ranges::find(run, edge, &EdgeUse::edge);
  }

  const QuadEdges& edges_;
  BoundaryModel& model_;
  std::vector<int> valence_;
  std::vector<Index> new_edge_, new_vertex_;
  std::vector<char> first_reversed_;
  Index count_ = 0;
};

}  // namespace

BoundaryModel boundary_model(const std::vector<LimitQuad>& quads, const QuadEdges& edges,
                             const std::vector<QuadRectangle>& rectangles) {
  BoundaryModel model;
  for (const QuadRectangle& r : rectangles) {
    model.faces.push_back(surface_of(r, quads));
    model.faces.back().border = border_of(r, quads, edges);
    for (const std::vector<TurnedQuad>& row : r)
      for (const TurnedQuad& q : row) model.faces.back().volume += quads[size_t(q.quad)].volume;
  }
  EdgeChains(edges, model).make();
  return model;
}

}  // namespace sublimit
