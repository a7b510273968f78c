// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/knots.h"

#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

void check_degree(int degree) {
  if (degree < 0 || degree > max_degree)
    throw InvalidParameter("degree " + format_number(degree) + ": splines have degrees 0 to " +
                           format_number(max_degree));
}

void check_same_degree(int wanted, int degree) {
  if (wanted != degree)
    throw InvalidParameter("finer knots of degree " + format_number(degree) + ": degree " + format_number(wanted) +
                           " is needed");
}

bool check_knot_count(int degree, Index points, std::size_t knots) {
  const std::string of = format_number(points) + " control points of degree " + format_number(degree);
  if (points < degree + 1) throw InvalidParameter(of + ": at least " + format_number(degree + 1) + " are needed");
  const auto full = static_cast<std::size_t>(points) + static_cast<std::size_t>(degree) + 1;
  if (knots == full) return false;
  if (degree > 0 && knots + 2 == full) return true;
  throw InvalidParameter(format_number(knots) + " knots for " + of + ": " + format_number(full) + " are needed" +
                         (degree > 0 ? ", or " + format_number(full - 2) + " without the first and the last" : ""));
}

void check_break_count(std::size_t breaks) {
  if (breaks < 2)
    throw InvalidParameter(format_number(breaks) +
                           " break points of a closed spline: N + 1 are needed for N control points, at least 2");
}

namespace {
std::string knot_is(Index knot, double value) { return "knot " + format_number(knot) + " is " + format_number(value); }
}  // namespace

void refuse_knot(KnotFault fault, Index knot, double value, double other) {
  const std::string name = knot_is(knot, value);
  switch (fault) {
    case KnotFault::not_finite:
      throw InvalidParameter(name + ": knots must be finite numbers");
    case KnotFault::falling:
      throw InvalidParameter(name + ", less than the one before, " + format_number(other) + ": knots must not fall");
    case KnotFault::too_near:
      throw InvalidParameter(name + " and the one before " + format_number(other) +
                             ": there is no number between them to halve the span at");
    case KnotFault::missing:
      throw InvalidParameter(name + " and occurs less often in the finer knots: these must have all coarser ones");
    default:
      throw InvalidParameter(name + " where the domain of the coarser knots has its end at " + format_number(other) +
                             ": both must have the same domain");
  }
}

void refuse_multiplicity(int degree, Index knot, double value, Index times, Index point) {
  throw InvalidParameter(knot_is(knot, value) + ", which occurs " + format_number(times) + " times: at degree " +
                         format_number(degree) + " at most " + format_number(degree + 1) + ", else control point " +
                         format_number(point) + " has no influence");
}

void refuse_domain(Index first, Index last, double value) {
  throw InvalidParameter("knots " + format_number(first) + " and " + format_number(last) + " are both " +
                         format_number(value) + ": the domain between them must have a length");
}

void refuse_parameter(double t, double begin, double end) {
  throw InvalidParameter("parameter " + format_number(t) + " is outside the domain, " + format_number(begin) + " to " +
                         format_number(end));
}

}  // namespace sublimit
