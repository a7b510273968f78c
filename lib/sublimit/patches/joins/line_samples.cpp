// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/line_samples.h"

#include <algorithm>
#include <numeric>

#include "sublimit/patches/joins/line_search.h"

namespace sublimit {
namespace {

constexpr int samples_of_side = 33;

bool boxes_meet(const SideCurve& a, const SideCurve& b, double same) {
  return (a.low.array() <= b.high.array() + same).all() && (b.low.array() <= a.high.array() + same).all();
}

}  // namespace

Place line_place(const PatchColumns& patch, const PatchLine& line, const KnotPlace<double>& along) {
  const KnotPlace<double> across{.face = line.face, .u = line.end == KnotSide::right ? 1.0 : 0.0};
  const KnotPlace<double>&u = line.along_v ? across : along, &v = line.along_v ? along : across;
  return {.face = u.face + patch.surface->u().num_faces() * v.face, .u = u.u, .v = v.u};
}

LimitSamples line_samples(const PatchColumns& patch, Coordinates coordinates, const PatchLine& line,
                          std::span<const double> s, int order) {
  const Knots<double>& along = patch.along(line);
  std::vector<Place> places;
  for (const double x : s) {
    const double t = x == 1 ? along.end() : along.begin() + x * (along.end() - along.begin());
    places.push_back(line_place(patch, line, along.place(std::clamp(t, along.begin(), along.end()))));
  }
  return patch.surface->evaluate(patch.columns, places, order, coordinates);
}

double line_sign(const PatchLine& line, bool is_left, bool reversed) {
  const bool turned_over = (line.end == KnotSide::right) != is_left;
  return (line.along_v ? 1 : -1) * (turned_over ? -1 : 1) * (reversed ? -1 : 1);
}

std::vector<SideCurve> side_curves(std::span<const PatchColumns> patches, Coordinates coordinates, double same) {
  std::vector<double> s;
  for (int i = 0; i < samples_of_side; ++i) s.push_back(i / (samples_of_side - 1.0));
  std::vector<SideCurve> sides;
  for (size_t p = 0; p < patches.size(); ++p)
    for (const PatchSide side : {PatchSide::u_begin, PatchSide::u_end, PatchSide::v_begin, PatchSide::v_end}) {
      const PatchLine line = side_line(patches, p, side);
      if (patches[p].across(line).is_closed()) continue;
      SideCurve curve{.line = line};
      const LimitSamples at = line_samples(patches[p], coordinates, line, s, 0);
      curve.points = at.position;
      for (const LimitStatus status : at.status) curve.is_there = curve.is_there && has_position(status);
      curve.low = curve.points.colwise().minCoeff(), curve.high = curve.points.colwise().maxCoeff();
      curve.is_collapsed = curve.is_there && (curve.high - curve.low).norm() <= same;
      sides.push_back(std::move(curve));
    }
  return sides;
}

std::optional<bool> same_curve(const SideCurve& a, const SideCurve& b, double same) {
  for (const bool reversed : {false, true})
    if (curve_distance(a.points, b.points, reversed) <= same) return reversed;
  return std::nullopt;
}

std::vector<std::pair<size_t, size_t>> near_pairs(const std::vector<SideCurve>& sides, double same) {
  std::vector<size_t> order(sides.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return sides[i].low[0]; });
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = i + 1; j < order.size() && sides[order[j]].low[0] <= sides[order[i]].high[0] + same; ++j)
      if (boxes_meet(sides[order[i]], sides[order[j]], same)) pairs.emplace_back(std::minmax(order[i], order[j]));
  std::ranges::sort(pairs);
  return pairs;
}

std::optional<SideOverlap> side_overlap(std::span<const PatchColumns> patches, Coordinates coordinates,
                                        const SideCurve& a, const SideCurve& b, double same) {
  const auto point = [&](const SideCurve& side) {
    return [&](double s) -> Eigen::RowVector3d {
      return line_samples(patches[side.line.patch], coordinates, side.line, {&s, 1}, 0).position.row(0);
    };
  };
  const auto is_on = [&](const SideCurve& side, const Eigen::RowVector3d& x) {
    if ((x.array() < side.low.array() - same).any() || (x.array() > side.high.array() + same).any()) return false;
    return nearest_on_line(point(side), side.points, x).distance <= same;
  };
  const auto s = [](int i) { return i / (samples_of_side - 1.0); };
  std::vector<char> on(samples_of_side);
  for (int i = 0; i < samples_of_side; ++i) on[size_t(i)] = is_on(b, a.points.row(i));
  // The longest run of samples on the other side, and its ends by halving.
  int begin = 0, end = 0;
  for (int i = 0; i < samples_of_side; ++i) {
    int j = i;
    while (j < samples_of_side && on[size_t(j)]) ++j;
    if (j - i > end - begin) begin = i, end = j;
    i = std::max(i, j - 1);
  }
  if (end - begin < 2) return std::nullopt;
  const auto limit = [&](double inside, double outside) {
    for (int step = 0; step < 40; ++step) {
      const double middle = (inside + outside) / 2;
      (is_on(b, point(a)(middle)) ? inside : outside) = middle;
    }
    return inside;
  };
  SideOverlap overlap{.begin = begin == 0 ? 0 : limit(s(begin), s(begin - 1)),
                      .end = end == samples_of_side ? 1 : limit(s(end - 1), s(end))};
  overlap.all_of_second = true;
  for (int i = 0; i < samples_of_side && overlap.all_of_second; ++i) overlap.all_of_second = is_on(a, b.points.row(i));
  return overlap;
}

}  // namespace sublimit
