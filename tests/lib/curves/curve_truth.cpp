// SPDX-License-Identifier: Apache-2.0
#include "lib/curves/curve_truth.h"

namespace sublimit::testing {
namespace {

constexpr Index reach = 24;        // points that are kept on either side
constexpr int first_depth = 240;   // limits whose derivatives are hardly continuous converge slowly
constexpr int second_depth = 150;  // each level costs second differences a bit
constexpr int closed_levels = 7;   // until a closed curve is long enough to be cut

Precise number(std::int64_t n) { return Precise(static_cast<long long>(n)); }

}  // namespace

CurveBruteForce::CurveBruteForce(CurveScheme<Precise> scheme, Eigen::VectorXd values, bool closed, bool stationary)
    : scheme_(std::move(scheme)),
      layout_(scheme_),
      values_(values.cast<Precise>()),
      closed_(closed),
      stationary_(stationary) {}

const CurveMatrix<Precise>& CurveBruteForce::matrix(const CurveOutline& curve, int level) {
  const auto at = matrices_.find({curve.size, stationary_ ? 0 : level});
  if (at != matrices_.end()) return at->second;
  return matrices_[{curve.size, stationary_ ? 0 : level}] = curve_matrix(scheme_, {curve}, level);
}

/// The last inner point before a place, for points that lie `shift` further than the layout says.
Index CurveBruteForce::last_before(const CurveOutline& curve, const Precise& shift, const Precise& place) const {
  const Precise steps = floor((place - shift - number(layout_.position(curve, 1))) / 2);
  if (steps < 0) return 0;
  if (steps > curve.size) return curve.size - 2;
  return std::min<Index>(1 + static_cast<Index>(steps), curve.size - 2);
}

CurveTruth CurveBruteForce::at(double position, double more) {
  Precise place = Precise(position) + Precise(more);
  CurveTruth truth;
  Precise scale = 1, common = 0;  // a point is common + scale value
  Values x = values_;
  CurveOutline curve = layout_.control(static_cast<Index>(x.size()), closed_);
  int level = 0;
  for (; closed_ && level < closed_levels; ++level) {
    x = (curve_matrix(scheme_, {curve}, level) * x).eval();
    curve = layout_.child(curve);
    place *= 2;
  }
  // From here on an open curve, possibly cut out of a longer one: its points' positions are `shift` more than the
  // layout says.
  Precise shift = 0, end = -1;
  if (closed_) {
    const Index size = curve.size;
    const std::int64_t first = curve.first;
    const auto nearest = static_cast<std::int64_t>(floor((place - number(first)) / 2)) - reach + 1;
    Values cut(2 * reach);
    for (Index i = 0; i < cut.size(); ++i) cut[i] = x[((nearest + i) % size + size) % size];
    x = cut;
    curve = layout_.control(static_cast<Index>(x.size()), false);
    shift = number(first + 2 * (nearest + 1) - layout_.position(curve, 1));
  } else {
    end = number(layout_.end(curve));
  }
  const bool open = !closed_;
  for (;; ++level) {
    // Points around the place.
    const Index size = curve.size;
    const Index near = last_before(curve, shift, place);
    const bool has_start = open && shift == 0, has_end = open && shift + number(layout_.end(curve)) == end;
    if (level == second_depth || level == first_depth) {
      // Equidistant points at the place or behind it; before it at the end.
      Index a = std::max<Index>(near, 1);
      const bool from_before = a + 3 >= size;
      if (from_before) a = size - 4;
      if (level == second_depth) {
        truth.second = (x[a + 2] - 2 * x[a + 1] + x[a]) * scale * pow(Precise(4), level);
      } else {
        truth.position = common + scale * x[a];
        truth.first = (x[a + 1] - x[a]) * scale * pow(Precise(2), level);
        return truth;
      }
    }
    const Precise middle = x[near];
    common += scale * middle;
    for (Precise& value : x) value = 2 * (value - middle);
    scale /= 2;
    x = (matrix(curve, level) * x).eval();
    const CurveOutline child = layout_.child(curve);
    place *= 2;
    shift *= 2;
    end *= 2;
    // Cut.
    const Index centre = last_before(child, shift, place);
    Index from = std::max<Index>(0, centre - reach), to = std::min<Index>(child.size, centre + reach + 1);
    if (has_start && from < reach / 2) from = 0;
    if (has_end && to > child.size - reach / 2) to = child.size;
    x = Values(x.segment(from, to - from));
    curve = layout_.control(to - from, false);
    const bool keeps_start = has_start && from == 0, keeps_end = has_end && to == child.size;
    if (keeps_start)
      shift = 0;
    else if (keeps_end)
      shift = end - number(layout_.end(curve));
    else
      shift += number(layout_.position(child, from + 1)) - number(layout_.position(curve, 1));
  }
}

}  // namespace sublimit::testing
