// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/bezier_pieces.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {
namespace {

using Column = Eigen::Array4d;
Eigen::Array3d space(const Column& column) { return column.head<3>(); }

/// The rows of Bezier control points over the functions of a span, in one direction.
std::vector<BandRows<double>> bezier_rows_of(const Knots<double>& knots) {
  std::vector<BandRows<double>> all;
  for (Index face = 0; face < knots.num_faces(); ++face) all.push_back(bezier_rows(knots, face));
  return all;
}

/// Weights of a Bezier piece and its derivatives: the steps of its points are made once for all of them.
template <int Degree, int Order>
struct Weights {
  static constexpr int size = (Degree < 0 ? max_degree : Degree) + 1;
  std::array<std::array<double, size>, Order + 1> of;

  Weights(int degree, double u) {
    const int p = Degree < 0 ? degree : Degree;
    const UnitArgument<double> point = UnitArgument<double>::point(u), direction = UnitArgument<double>::direction();
    constexpr UnitSpan<double> span;
    std::array<double, size> lower;
    lower[0] = 1;
    for (int q = 1; q <= p - Order; ++q) blossom_step(span, q, point, lower.data());
    double factor = 1;
    for (int r = 0; r <= Order; ++r) {
      std::array<double, size>& row = of[size_t(r)];
      if (r > p) {
        std::fill_n(row.begin(), p + 1, 0.0);
        continue;
      }
      const int common = std::max(p - Order, 0);
      std::copy_n(lower.begin(), common + 1, row.begin());
      for (int q = common + 1; q <= p - r; ++q) blossom_step(span, q, point, row.data());
      for (int q = p - r + 1; q <= p; ++q) blossom_step(span, q, direction, row.data());
      if (r > 0) {
        factor *= p - r + 1;
        for (int i = 0; i <= p; ++i) row[size_t(i)] *= factor;
      }
    }
  }
};

/// Room for so many samples; what is there may be anything.
void set_size(Eigen::Index count, int order, bool normals, LimitSamples& out) {
  Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
  for (int k = 0; k < 6; ++k) targets[k]->resize(k == 0 || order >= (k < 3 ? 1 : 2) ? count : 0, 3);
  if (order >= 1 && normals)
    out.normal.resize(count, 3);
  else
    out.normal.setZero(order >= 1 ? count : 0, 3);
  out.status.resize(static_cast<size_t>(count));
  out.order.resize(static_cast<size_t>(count));
}

/// A row that has nothing, so far.
void set_outside(Eigen::Index row, LimitSamples& out) {
  for (Points* const m : {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal})
    if (m->rows() > 0) m->row(row).setZero();
  out.status[size_t(row)] = LimitStatus::outside;
  out.order[size_t(row)] = 0;
}

}  // namespace

double BezierPieces::num_numbers(const PatchSet& patches) {
  double sum = 0;
  for (const PatchSet::Member& member : patches.members()) {
    const auto* const spline = dynamic_cast<const SplineSurface*>(member.patch.get());
    if (!spline) return 0;
    sum += 4.0 * spline->num_faces() * (spline->u().degree() + 1) * (spline->v().degree() + 1);
  }
  return sum;
}

BezierPieces::BezierPieces(const PatchSet& patches, const Points& columns) : patches_(patches), columns_(columns) {
  check_columns(columns, patches.num_points(), patches.coordinates());
  check_measurable_control(columns);
  const bool rational = patches.coordinates() == Coordinates::homogeneous;
  pieces_.resize(size_t(patches.faces().size));
  numbers_.resize(size_t(num_numbers(patches)));
  size_t first = 0;
  for (size_t m = 0; m < patches.members().size(); ++m) {
    const auto& spline = static_cast<const SplineSurface&>(*patches.members()[m].patch);
    own_.push_back(patches.columns_of(m, columns));
    const Points& own = own_.back();
    const std::vector<BandRows<double>> in_u = bezier_rows_of(spline.u()), in_v = bezier_rows_of(spline.v());
    const Index p = spline.u().degree(), q = spline.v().degree();
    const size_t size = 4 * size_t(p + 1) * size_t(q + 1), begin = first;
    first += size * size_t(spline.num_faces());
    parallel_for(spline.num_faces(), [&](std::int64_t face) {
      const Index fu = static_cast<Index>(face) % spline.u().num_faces(),
                  fv = static_cast<Index>(face) / spline.u().num_faces();
      Piece& piece = pieces_[size_t(patches.first_face(m) + face)];
      piece.first = begin + size * size_t(face);
      piece.p = static_cast<std::int8_t>(p), piece.q = static_cast<std::int8_t>(q);
      const auto smooth = [](const Knots<double>& knots, Index at, KnotSide side) {
        return static_cast<std::int8_t>(std::min(3, knots.continuity(at, side).value_or(3)));
      };
      piece.smooth = {smooth(spline.u(), fu, KnotSide::left), smooth(spline.u(), fu, KnotSide::right),
                      smooth(spline.v(), fv, KnotSide::left), smooth(spline.v(), fv, KnotSide::right)};
      const std::vector<Index> slots = spline.slots(static_cast<Index>(face));
      // Seen from one of the control points, so that derivatives do not lose digits to where the surface lies.
      const auto origin_row = own.row(slots[slots.size() / 2]);
      const double w = rational ? origin_row[3] : 1;
      for (size_t c = 0; c < 3; ++c) piece.origin[c] = w > 0 ? origin_row[Eigen::Index(c)] / w : 0;
      std::vector<Column> net(slots.size());
      for (size_t i = 0; i < slots.size(); ++i) {
        Column& column = net[i];
        column[3] = rational ? own(slots[i], 3) : 1;
        for (Eigen::Index c = 0; c < 3; ++c) column[c] = own(slots[i], c) - column[3] * piece.origin[size_t(c)];
        if (!(column[3] > 0)) piece.is_positive = false;
      }
      double largest = 0, least_weight = INFINITY;
      for (const Column& column : net) {
        largest = std::max(largest, space(column).abs().maxCoeff());
        least_weight = std::min(least_weight, column[3]);
      }
      piece.small = 1e-9 * largest / std::max(least_weight, 1e-300);
      double* to = numbers_.data() + piece.first;
      for (Index b = 0; b <= q; ++b)
        for (Index a = 0; a <= p; ++a, to += 4) {
          Column sum = Column::Zero();
          for (Index j = 0; j <= q; ++j) {
            Column row = Column::Zero();
            for (Index i = 0; i <= p; ++i) row += in_u[size_t(fu)][a][size_t(i)] * net[size_t(i + (p + 1) * j)];
            sum += in_v[size_t(fv)][b][size_t(j)] * row;
          }
          std::copy_n(sum.data(), 4, to);
        }
    });
  }
}

template <int Degree, int Order>
bool BezierPieces::evaluate(const Piece& piece, const Place& s, bool normals, LimitSamples& out,
                            Eigen::Index row) const {
  if (!piece.is_positive) return false;
  const int p = Degree < 0 ? piece.p : Degree, q = Degree < 0 ? piece.q : Degree;
  const Weights<Degree, Order> in_u(p, s.u), in_v(q, s.v);
  constexpr int Quantities = Order == 0 ? 1 : Order == 1 ? 3 : 6;
  constexpr int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  Column H[Quantities];
  for (Column& h : H) h = Column::Zero();
  const double* from = numbers_.data() + piece.first;
  for (int j = 0; j <= q; ++j) {
    Column along[Order + 1];
    for (Column& a : along) a = Column::Zero();
    for (int i = 0; i <= p; ++i, from += 4) {
      const Column column = Eigen::Map<const Column>(from);
      for (int r = 0; r <= Order; ++r) along[r] += in_u.of[size_t(r)][size_t(i)] * column;
    }
    for (int k = 0; k < Quantities; ++k) H[k] += in_v.of[size_t(orders[k][1])][size_t(j)] * along[orders[k][0]];
  }
  const double over_w = 1 / H[0][3];
  const Eigen::Array3d x = space(H[0]) * over_w;
  out.position.row(row) << piece.origin[0] + x[0], piece.origin[1] + x[1], piece.origin[2] + x[2];
  int least = 3;
  if (s.u == 0) least = std::min<int>(least, piece.smooth[0]);
  if (s.u == 1) least = std::min<int>(least, piece.smooth[1]);
  if (s.v == 0) least = std::min<int>(least, piece.smooth[2]);
  if (s.v == 1) least = std::min<int>(least, piece.smooth[3]);
  out.status[size_t(row)] = least < Order ? LimitStatus::crease : LimitStatus::regular;
  out.order[size_t(row)] = Order;
  if constexpr (Order >= 1) {
    const Eigen::Array3d du = (space(H[1]) - H[1][3] * x) * over_w, dv = (space(H[2]) - H[2][3] * x) * over_w;
    out.du.row(row) = du.matrix();
    out.dv.row(row) = dv.matrix();
    if constexpr (Order == 2) {
      out.duu.row(row) = ((space(H[3]) - 2 * H[1][3] * du - H[3][3] * x) * over_w).matrix();
      out.duv.row(row) = ((space(H[4]) - H[1][3] * dv - H[2][3] * du - H[4][3] * x) * over_w).matrix();
      out.dvv.row(row) = ((space(H[5]) - 2 * H[2][3] * dv - H[5][3] * x) * over_w).matrix();
    }
    if (!normals) return true;
    const Eigen::Vector3d n = du.matrix().cross(dv.matrix());
    const double along_u = du.matrix().norm(), along_v = dv.matrix().norm(), size = n.norm();
    // Where they nearly vanish or are nearly parallel, the patch knows what of them is rounding.
    if (!(std::min(along_u, along_v) > piece.small && size > 1e-6 * along_u * along_v)) return false;
    out.normal.row(row) = n / size;
  }
  return true;
}

template <int Order>
bool BezierPieces::evaluate(const Place& s, bool normals, LimitSamples& out, Eigen::Index row) const {
  const Piece& piece = pieces_[size_t(s.face)];
  if (piece.p == 3 && piece.q == 3) return evaluate<3, Order>(piece, s, normals, out, row);
  if (piece.p == 2 && piece.q == 2) return evaluate<2, Order>(piece, s, normals, out, row);
  return evaluate<-1, Order>(piece, s, normals, out, row);
}

void BezierPieces::evaluate(std::span<const Place> samples, int order, bool normals, LimitSamples& out) const {
  check_order(order);
  set_size(std::ssize(samples), order, normals, out);
  const Index num_faces = patches_.faces().size;
  parallel_for_blocks(
      std::ssize(samples),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Place& s = samples[size_t(i)];
          if (!(s.face >= 0 && s.face < num_faces && s.u >= 0 && s.u <= 1 && s.v >= 0 && s.v <= 1)) {
            set_outside(i, out);
            continue;
          }
          const bool done = order == 0   ? evaluate<0>(s, normals, out, i)
                            : order == 1 ? evaluate<1>(s, normals, out, i)
                                         : evaluate<2>(s, normals, out, i);
          if (done) continue;
          set_outside(i, out);
          const size_t p = patches_.patch_of(s.face);
          patches_.members()[p].patch->evaluate(own_[p], patches_.coordinates(),
                                                {s.face - patches_.first_face(p), s.u, s.v}, order, out, i);
        }
      },
      1024);
}

}  // namespace sublimit
