// SPDX-License-Identifier: Apache-2.0
#pragma once
// Matching numbers of control points and of values of `parm` along one parameter. Segments of a basis depend on
// `first` control points each, and start `stride` points after each other; `parm` has the ends of all segments,
// or the knots of a B-spline. (The specification counts with K + 1 points: bezier K/n + 1 values, cardinal K -
// 1, taylor (K + 1)/(n + 1) + 1, bmatrix (K - n)/s + 2, bspline K + n + 2.)
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "sublimit/io/free_form.h"

namespace sublimit {

/// Largest accepted degree: larger binomial coefficients are not exact doubles.
inline constexpr int largest_free_form_degree = 1000;

/// Returns the name of a basis in `cstype`.
std::string_view basis_name(FreeFormBasis basis);

class FreeFormCounts {
 public:
  FreeFormCounts(FreeFormBasis basis, int degree, Index step);

  /// True if some number of segments has this many control points.
  bool fits(std::int64_t points) const { return points >= first_ && (points - first_) % stride_ == 0; }
  /// Returns the number of values of `parm` for a valid number of control points.
  std::int64_t parameters(std::int64_t points) const;
  /// Returns the number of control points for a number of values of `parm`; 0 if it is too small.
  std::int64_t points(std::int64_t parameters) const;

  std::int64_t least_parameters() const { return parameters(first_); }
  /// Returns the valid numbers of control points next to an invalid one, as text: "4 or 7".
  std::string points_beside(std::int64_t points) const;
  /// Returns a description: "a bspline of degree 3".
  std::string text() const;

 private:
  FreeFormBasis basis_;
  std::int64_t degree_, first_, stride_;
};

/// Returns the domain on which all segments are defined, for the number of parameters that `direction.count`
/// requires.
std::pair<double, double> free_form_domain(FreeFormBasis basis, const FreeFormDirection& direction);

/// Returns the index of the first of ascending knots with a multiplicity above `degree` (at the very ends:
/// above degree + 1); knots.size() if there is none.
std::size_t first_excess_knot(const std::vector<double>& knots, int degree);

}  // namespace sublimit
