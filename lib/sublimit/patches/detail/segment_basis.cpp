// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/segment_basis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_rows.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

Knots<double> bernstein_knots(int degree) {
  if (degree < 0 || degree > max_degree)
    throw InvalidParameter("degree " + format_number(degree) + "; 0 to " + format_number(max_degree) + " are right");
  return bezier_knots<double>(degree);
}

/// f(0, .., 0, 1, .., 1), `ones` times 1, of the blossom f of t^power at this degree: C(ones, power) / C(degree,
/// power).
double blossom_of_power(int degree, int ones, int power) {
  double value = 1;
  for (int k = 0; k < power; ++k) value *= double(ones - k) / double(degree - k);
  return value;
}

/// Whether a piece begins with the last control point of the one before: where the two do not jump.
bool shares_first(const SegmentBasis& basis, Index face) {
  return face > 0 && basis.continuity(face, KnotSide::left) >= 0;
}

}  // namespace

SegmentBasis::SegmentBasis(int degree, Index step, std::span<const double> powers, std::vector<double> breaks)
    : degree_(degree), step_(step), breaks_(std::move(breaks)), bernstein_(bernstein_knots(degree)) {
  const size_t width = size_t(degree) + 1;
  if (powers.size() != width * width)
    throw InvalidParameter("a basis matrix of " + format_number(powers.size()) + " entries; degree " +
                           format_number(degree) + " has " + format_number(width * width));
  if (step < 1) throw InvalidParameter("a step of " + format_number(step) + " control points; 1 or more are right");
  if (breaks_.size() < 2) throw InvalidParameter("segments need two ends at least");
  for (const double entry : powers)
    if (!std::isfinite(entry)) throw InvalidParameter("an entry of a basis matrix is not finite");
  for (size_t i = 0; i < breaks_.size(); ++i)
    if (!std::isfinite(breaks_[i]) || (i > 0 && !(breaks_[i - 1] < breaks_[i])))
      throw InvalidParameter("end " + format_number(i) + " of segments is " + format_number(breaks_[i]) +
                             ": they should rise and be finite");
  to_bezier_ = WeightRows::Zero(Eigen::Index(width), Eigen::Index(width));
  for (int b = 0; b <= degree; ++b)
    for (int i = 0; i <= degree; ++i)
      for (int power = 0; power <= b; ++power)
        to_bezier_(b, i) += powers[size_t(i) * width + size_t(power)] * blossom_of_power(degree, b, power);
}

SegmentBasis SegmentBasis::cardinal(std::vector<double> breaks) {
  const double powers[] = {0, -0.5, 1, -0.5, 1, 0, -2.5, 1.5, 0, 0.5, 2, -1.5, 0, 0, -0.5, 0.5};
  return SegmentBasis(3, 1, powers, std::move(breaks));
}

SegmentBasis SegmentBasis::taylor(int degree, std::vector<double> breaks) {
  const auto width = static_cast<size_t>(std::clamp(degree, 0, max_degree)) + 1;
  std::vector<double> powers(width * width, 0.0);
  for (size_t i = 0; i < width; ++i) powers[i * width + i] = 1;
  return SegmentBasis(degree, degree + 1, powers, std::move(breaks));
}

void SegmentBasis::rows(double t, int order, std::span<double> rows) const {
  const Eigen::Index width = degree_ + 1;
  std::array<double, 3 * (max_degree + 1)> bernstein;
  span_rows(bernstein_, 0, t, order, std::span<double>(bernstein).first(size_t((order + 1) * width)));
  for (Eigen::Index r = 0; r <= order; ++r)
    for (Eigen::Index i = 0; i < width; ++i) {
      double sum = 0;
      for (Eigen::Index b = 0; b < width; ++b) sum += bernstein[size_t(r * width + b)] * to_bezier_(b, i);
      rows[size_t(r * width + i)] = sum;
    }
}

int SegmentBasis::continuity(Index face, KnotSide end) const {
  const Index left = end == KnotSide::left ? face - 1 : face;
  if (left < 0 || left + 1 >= num_faces()) return 3;
  const size_t width = size_t(degree_) + 1, all = width + size_t(step_);
  std::vector<double> before(3 * width), after(3 * width);
  rows(1, 2, before);
  rows(0, 2, after);
  const double ratio = length(left) / length(left + 1);
  double scale = 1;
  for (int r = 0; r <= 2; ++r, scale *= ratio) {
    for (size_t i = 0; i < all; ++i) {
      const double a = i < width ? before[size_t(r) * width + i] : 0;
      const double b = i >= size_t(step_) ? after[size_t(r) * width + i - size_t(step_)] * scale : 0;
      if (std::abs(a - b) > 64 * std::numeric_limits<double>::epsilon() * (1 + std::abs(a) + std::abs(b))) return r - 1;
    }
  }
  return 2;
}

KnotPlace<double> SegmentBasis::place(double t, KnotSide side) const {
  if (!(breaks_.front() <= t && t <= breaks_.back())) refuse_parameter(t, breaks_.front(), breaks_.back());
  const auto beyond =
      side == KnotSide::left ? std::ranges::lower_bound(breaks_, t) : std::ranges::upper_bound(breaks_, t);
  const auto face = static_cast<Index>(std::clamp<std::ptrdiff_t>(beyond - breaks_.begin() - 1, 0, num_faces() - 1));
  return {face, (t - breaks_[size_t(face)]) / length(face)};
}

double SegmentBasis::parameter(const KnotPlace<double>& place) const {
  const double a = breaks_[size_t(place.face)], b = breaks_[size_t(place.face) + 1];
  return place.u == 1 ? b : std::min(b, a + place.u * (b - a));
}

Knots<double> SegmentBasis::knots_of_pieces() const {
  const Index p = degree_;
  std::vector<double> knots;
  Index points = 0;
  for (Index face = 0; face <= num_faces(); ++face) {
    const bool shares = face < num_faces() && shares_first(*this, face);
    knots.insert(knots.end(), size_t(shares ? p : p + 1), breaks_[size_t(face)]);
    if (face < num_faces()) points += shares ? p : p + 1;
  }
  return Knots<double>::open(p, points, std::move(knots));
}

SparseMatrix SegmentBasis::matrix_of_pieces() const {
  SparseRows rows;
  for (Index face = 0; face < num_faces(); ++face)
    for (Index b = shares_first(*this, face) ? 1 : 0; b <= degree_; ++b) {
      for (Index i = 0; i <= degree_; ++i)
        if (const double weight = to_bezier_(b, i); weight != 0) rows.add(first_point(face) + i, weight);
      rows.end_row();
    }
  std::vector<SparseRows::Row> spans;
  for (size_t r = 0; r < rows.size(); ++r) spans.push_back(rows[r]);
  return matrix_of(spans, num_points());
}

bool SegmentBasis::is_affine() const {
  const double noise =
      8 * std::numeric_limits<double>::epsilon() * (1 + to_bezier_.cwiseAbs().rowwise().sum().maxCoeff());
  return ((to_bezier_.rowwise().sum().array() - 1).abs() <= noise).all();
}

void SegmentBasis::append_type(std::string& bytes) const {
  bytes += char(degree_);
  bytes.append(reinterpret_cast<const char*>(to_bezier_.data()), size_t(to_bezier_.size()) * sizeof(double));
}

void SegmentBasis::append_ends(Index face, std::string& bytes) const {
  for (const KnotSide end : {KnotSide::left, KnotSide::right}) bytes += char(std::min(continuity(face, end), 2));
}

}  // namespace sublimit
