// SPDX-License-Identifier: Apache-2.0
#pragma once
// How many control points and how many values of `parm` belong together along one parameter. Segments of a basis take
// `first` control points each and begin `stride` after one another; `parm` has the ends of all segments, of a B-spline
// its knots. (The specification counts with K + 1 points: bezier K/n + 1 values, cardinal K - 1, taylor
// (K + 1)/(n + 1) + 1, bmatrix (K - n)/s + 2, bspline K + n + 2.)
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "sublimit/io/free_form.h"

namespace sublimit {

/// Largest degree that is accepted: binomial coefficients beyond it are no doubles.
inline constexpr int largest_free_form_degree = 1000;

/// Returns the name of a basis in `cstype`.
std::string_view basis_name(FreeFormBasis basis);

class FreeFormCounts {
 public:
  FreeFormCounts(FreeFormBasis basis, int degree, Index step);

  /// True if some number of segments has this many control points.
  bool fits(std::int64_t points) const { return points >= first_ && (points - first_) % stride_ == 0; }
  /// Values of `parm` for a number of control points that fits.
  std::int64_t parameters(std::int64_t points) const;
  /// Control points for a number of values of `parm`; 0 if it is too small.
  std::int64_t points(std::int64_t parameters) const;

  std::int64_t least_parameters() const { return parameters(first_); }
  /// "4 or 7": the numbers of control points that fit and are next to one that does not.
  std::string points_beside(std::int64_t points) const;
  /// "a bspline of degree 3".
  std::string text() const;

 private:
  FreeFormBasis basis_;
  std::int64_t degree_, first_, stride_;
};

/// The values between which all segments are defined, for as many parameters as `direction.count` asks for.
std::pair<double, double> free_form_domain(FreeFormBasis basis, const FreeFormDirection& direction);

/// The first of knots that do not fall which is there more than `degree` times, at the very ends degree + 1 times;
/// knots.size() if none is.
std::size_t first_excess_knot(const std::vector<double>& knots, int degree);

}  // namespace sublimit
