// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/limit_curve.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/curves/detail/curve_pieces.h"
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {
namespace {

/// A place on a curve by pieces, s in [0, 1].
struct PieceOfCurve {
  Index curve = 0;
  std::int64_t piece = 0;
  double s = 0;
};

}  // namespace

struct LimitCurve::Parts {
  std::vector<CurveOutline> curves;
  std::vector<Index> first_segment;  // by curve, and the end
  std::vector<Index> first_point;    // by curve, into `points`
  std::vector<Index> points;         // of the curves, in order: what stencils call them
  Index num_points = 0;
  CurvePieces pieces;

  Parts(const CurveScheme<double>& scheme, const CurveLevel& level)
      : curves(level.curves), pieces(scheme, level.number, level.curves) {
    first_segment.push_back(0);
    Index start = 0;
    for (const CurveOutline& curve : curves) {
      first_segment.push_back(first_segment.back() + curve.size - (curve.closed ? 0 : 1));
      first_point.push_back(start);
      start += curve.size;
    }
    num_points = start;
    for (Index i = 0; i < num_points; ++i) points.push_back(i);
  }

  Index unknowns() const { return pieces.layout().unknowns(); }

  Index curve_of(Index segment) const {
    return static_cast<Index>(std::upper_bound(first_segment.begin(), first_segment.end(), segment) -
                              first_segment.begin() - 1);
  }

  /// Position of the first point of a segment, and its length in half edges.
  std::pair<std::int64_t, int> ends(const CurveOutline& curve, Index segment) const {
    const std::int64_t from = pieces.layout().position(curve, segment);
    if (curve.closed) return {from, 2};
    return {from, static_cast<int>(pieces.layout().position(curve, segment + 1) - from)};
  }

  PieceOfCurve place(const CurvePlace& place) const {
    PieceOfCurve p;
    p.curve = curve_of(place.segment);
    const CurveOutline& curve = curves[p.curve];
    const auto [from, length] = ends(curve, place.segment - first_segment[p.curve]);
    // Position from + length t; its distance from the even number before, in edges.
    p.piece = from >= 0 ? from / 2 : -((1 - from) / 2);
    const double t = length == 2 ? place.t : place.t / 2;
    if (from % 2 == 0) {
      p.s = t;
    } else if (t < 0.5) {
      p.s = 0.5 + t;
    } else {
      ++p.piece;
      p.s = t - 0.5;
    }
    if (curve.closed) p.piece %= pieces.num_pieces(curve);
    return p;
  }

  /// Rows at a place, as far as wanted and existing; the place they are of in the end, and the status.
  LimitStatus rows(PieceOfCurve& place, int order, CurvePieceRows& result) const {
    const CurveOutline& curve = curves[place.curve];
    const Index count = pieces.num_pieces(curve);
    const auto ask = [&](bool one_sided, int derivatives) {
      pieces.rows(curve, static_cast<Index>(place.piece), place.s, derivatives, one_sided, result);
    };
    const auto one_sided = [&](const PieceOfCurve& at) {
      place = at;
      ask(true, order);
      return result.exists > 0 ? LimitStatus::crease : LimitStatus::undefined_normal;
    };
    const PieceOfCurve given = place;
    if (place.s == 1) place = {place.curve, place.piece + 1, 0};
    if (curve.closed) {
      place.piece %= count;
    } else if (place.piece < 0 || place.piece >= count || (place.piece == 0 && place.s == 0)) {
      const bool is_end = place.s == 0 && (place.piece == 0 || place.piece == count);
      const PieceOfCurve end =
          place.piece <= 0 ? PieceOfCurve{place.curve, 0, 0} : PieceOfCurve{place.curve, count - 1, 1};
      if (is_end) return one_sided(end);
      place = end;
      ask(true, 0);
      result.exists = 0;
      return LimitStatus::outside;
    }
    ask(false, order);
    if (place.s == 0 && result.exists == 0) return one_sided(given);  // a corner, seen from the side that was given
    if (result.kink) return LimitStatus::crease;
    return result.exists == 2   ? LimitStatus::regular
           : result.exists == 1 ? LimitStatus::unbounded_second
                                : LimitStatus::undefined_normal;
  }

  /// What stencils call the unknowns of a place's window.
  template <class Body>
  void for_each_unknown(const PieceOfCurve& place, const Body& body) const {
    const CurveOutline& curve = curves[place.curve];
    const PieceWindow window = pieces.window(curve, static_cast<Index>(place.piece));
    const Index* names = points.data() + first_point[place.curve];
    Index a = window.first, column = 0;
    if (curve.closed) a = (a % curve.size + curve.size) % curve.size;
    for (Index i = 0; i < window.size; ++i) {
      for (Index k = 0; k < unknowns(); ++k) body(column++, names[a] * unknowns() + k);
      if (++a == curve.size && curve.closed) a = 0;
    }
  }
};

namespace {

/// The level, which this scheme has made.
/// @throws InvalidParameter  another one has
const CurveLevel& made_by(const CurveLevel& level, const CurveScheme<double>& scheme) {
  check_made_by(level, scheme, "the limit curve");
  return level;
}

}  // namespace

LimitCurve::LimitCurve(const CurveScheme<double>& scheme, const CurveLevel& level)
    : parts_(std::make_unique<Parts>(scheme, made_by(level, scheme))) {}

LimitCurve::LimitCurve(const CurveScheme<double>& scheme, const ControlPolygon& polygon)
    : parts_(std::make_unique<Parts>(scheme, control_level(scheme, polygon))) {
  parts_->points.clear();
  for (const ControlPolygon::Curve& curve : polygon.curves)
    parts_->points.insert(parts_->points.end(), curve.points.begin(), curve.points.end());
  parts_->num_points = polygon.num_points();
}

LimitCurve::~LimitCurve() = default;
LimitCurve::LimitCurve(LimitCurve&&) noexcept = default;
LimitCurve& LimitCurve::operator=(LimitCurve&&) noexcept = default;

Index LimitCurve::num_segments() const { return parts_->first_segment.back(); }
Index LimitCurve::num_curves() const { return static_cast<Index>(parts_->curves.size()); }
Index LimitCurve::num_points() const { return parts_->num_points; }
Index LimitCurve::unknowns_per_point() const { return parts_->unknowns(); }

Index LimitCurve::first_segment(Index curve) const {
  if (curve < 0 || curve >= num_curves())
    throw InvalidParameter("curve " + std::to_string(curve) + " does not exist; there are curves 0 to " +
                           std::to_string(num_curves() - 1));
  return parts_->first_segment[curve];
}

double LimitCurve::parameter(const CurvePlace& place) const {
  check_place(place, num_segments());
  const Index curve = parts_->curve_of(place.segment);
  const CurveOutline& outline = parts_->curves[curve];
  const auto [from, length] = parts_->ends(outline, place.segment - parts_->first_segment[curve]);
  return static_cast<double>(from - parts_->pieces.layout().position(outline, 0)) / 2 + length * place.t / 2;
}

CurveStencil LimitCurve::stencil(const CurvePlace& place, int order) const {
  check_place(place, num_segments());
  check_order(order);
  PieceOfCurve piece = parts_->place(place);
  CurvePieceRows rows;
  CurveStencil result;
  result.status = parts_->rows(piece, order, rows);
  const int derivatives = std::min(order, rows.exists);
  std::vector<std::pair<Index, Index>> columns;  // by name
  parts_->for_each_unknown(piece, [&](Index column, Index name) { columns.push_back({name, column}); });
  std::sort(columns.begin(), columns.end());
  for (const auto& [name, column] : columns)
    if (result.unknowns.empty() || result.unknowns.back() != name) result.unknowns.push_back(name);
  result.weights.setZero(derivatives + 1, static_cast<Eigen::Index>(result.unknowns.size()));
  Index at = -1;
  for (size_t i = 0; i < columns.size(); ++i) {
    if (i == 0 || columns[i].first != columns[i - 1].first) ++at;  // small closed curves meet their points twice
    for (int k = 0; k <= derivatives; ++k) result.weights(k, at) += rows.row(k)[columns[i].second];
  }
  return result;
}

void LimitCurve::fill_samples(std::span<const CurvePlace> places, const Points& columns, Coordinates coordinates,
                              Index first, CurveSamples& out) const {
  if (coordinates == Coordinates::homogeneous)
    return CurveSource::fill_samples(places, columns, coordinates, first, out);
  const Eigen::Index dimension = columns.cols();
  CurvePieceRows rows;
  for (Index row = first; const CurvePlace& place : places) {
    PieceOfCurve piece = parts_->place(place);
    out.status[row] = parts_->rows(piece, out.derivatives(), rows);
    const int derivatives = std::min(out.derivatives(), rows.exists);
    out.order[row] = static_cast<std::int8_t>(derivatives);
    double noise = 0;
    parts_->for_each_unknown(piece, [&](Index column, Index name) {
      const double* x = columns.data() + name * dimension;
      for (int k = 0; k <= derivatives; ++k) {
        const double weight = rows.row(k)[column];
        double* sum = out.part(k).data() + row * dimension;
        for (Eigen::Index c = 0; c < dimension; ++c) sum[c] += weight * x[c];
        if (k != 1) continue;
        for (Eigen::Index c = 0; c < dimension; ++c) noise += std::abs(weight * x[c]);
      }
    });
    out.set_normal(row, 16 * std::numeric_limits<double>::epsilon() * noise);
    ++row;
  }
}

std::vector<CurvePlace> LimitCurve::point_places() const {
  const CurveLayout& layout = parts_->pieces.layout();
  std::vector<CurvePlace> places;
  for (size_t c = 0; c < parts_->curves.size(); ++c) {
    const CurveOutline& curve = parts_->curves[c];
    const Index first = parts_->first_segment[c];
    for (Index a = 0; a < curve.size; ++a) {
      Index segment = a;
      double t = 0;
      if (!curve.closed) {
        const std::int64_t at = std::clamp<std::int64_t>(layout.position(curve, a), 0, layout.end(curve));
        segment = std::min(a, curve.size - 2);
        while (layout.position(curve, segment) > at) --segment;
        while (segment < curve.size - 2 && layout.position(curve, segment + 1) <= at) ++segment;
        const auto [from, length] = parts_->ends(curve, segment);
        t = static_cast<double>(at - from) / length;
      }
      places.push_back({first + segment, t});
    }
  }
  return places;
}

CurveSamples evaluate(const GeometricCurveScheme& scheme, const ControlPolygon& polygon,
                      std::span<const CurvePlace> samples, int order) {
  check_order(order);
  const ControlPolygon data = scheme.checked(polygon);
  const std::vector<std::vector<SegmentCurve>> curves = scheme.segments(data);
  struct Neighbors {
    const SegmentCurve *curve, *before, *behind;  // and its neighbours, if there are any
  };
  std::vector<Neighbors> all_segments;
  for (size_t c = 0; c < curves.size(); ++c) {
    const std::vector<SegmentCurve>& all = curves[c];
    const size_t count = all.size();
    const bool closed = data.curves[c].closed;
    for (size_t i = 0; i < count; ++i)
      all_segments.push_back({&all[i], i > 0 || closed ? &all[(i + count - 1) % count] : nullptr,
                              i + 1 < count || closed ? &all[(i + 1) % count] : nullptr});
  }
  const auto count = static_cast<std::int64_t>(samples.size());
  for (std::int64_t i = 0; i < count; ++i) check_place(samples[i], static_cast<Index>(all_segments.size()), i);
  const double size = (data.points.colwise().maxCoeff() - data.points.colwise().minCoeff()).norm();
  CurveSamples result(count, data.dimension(), order);
  parallel_for_blocks(
      count,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const auto& [segment, t] = samples[i];
          const Neighbors& known = all_segments[segment];
          // What lies before and behind, which is the same but where arcs meet.
          const bool open_end = (t == 0 && !known.before) || (t == 1 && !known.behind);
          const SegmentPlace place = t == 1 && known.behind ? (*known.behind)(0, false) : (*known.curve)(t, false);
          const SegmentPlace other = t == 0 && known.before ? (*known.before)(1, true) : (*known.curve)(t, true);
          const bool bends_alike = (place.curvature - other.curvature).norm() <=
                                   1e-9 * (place.curvature.norm() + other.curvature.norm() + 1 / size);
          result.position.row(i) = place.position.head(data.dimension());
          result.status[i] = open_end      ? LimitStatus::crease
                             : bends_alike ? LimitStatus::regular
                                           : LimitStatus::unbounded_second;
          result.order[i] = static_cast<std::int8_t>(std::min(order, bends_alike ? 2 : 1));
          if (result.order[i] >= 1) result.first.row(i) = place.tangent.head(data.dimension());
          if (result.order[i] >= 2) result.second.row(i) = place.curvature.head(data.dimension());
          result.set_normal(static_cast<Index>(i), 0);
        }
      },
      256);
  return result;
}

}  // namespace sublimit
