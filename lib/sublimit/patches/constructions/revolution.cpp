// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/revolution.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr int most_arcs = 1000;

Knots<double> arc_knots(int arcs) {
  std::vector<double> knots{0};
  for (int i = 0; i <= arcs; ++i) knots.insert(knots.end(), 2, double(i));
  knots.push_back(arcs);
  return Knots<double>::open(2, 2 * arcs + 1, std::move(knots));
}

}  // namespace

double cos_degrees(double angle) {
  double a = std::fmod(std::abs(angle), 360);
  if (a > 180) a = 360 - a;
  const double sign = a > 90 ? -1 : 1;
  if (a > 90) a = 180 - a;
  if (a == 60) return sign * 0.5;
  constexpr double radians = std::numbers::pi / 180;
  return sign * (a <= 45 ? std::cos(a * radians) : std::sin((90 - a) * radians));
}

double sin_degrees(double angle) {
  const double a = std::fmod(angle, 360);
  return cos_degrees(a - 90);
}

Eigen::Matrix3d Axis::turn() const {
  if (!direction.allFinite() || !point.allFinite() || direction.isZero(0))
    throw InvalidParameter("axis: its direction is " + in_words(direction) + "; it must have a length");
  const Eigen::Vector3d d = direction.transpose().normalized();
  if (d[0] == 0 && d[1] == 0) return Eigen::Vector3d(1, d[2] > 0 ? 1 : -1, d[2] > 0 ? 1 : -1).asDiagonal();
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), d).toRotationMatrix();
}

SplineNet revolution(const CurveNet& profile, const RevolutionOptions& options) {
  const double start = options.start_degrees, sweep = options.sweep_degrees;
  if (!std::isfinite(start))
    throw InvalidParameter("a start of " + format_number(start) + " degrees: it must be finite");
  if (!(std::abs(sweep) > 0 && std::abs(sweep) <= 360))
    throw InvalidParameter("a sweep of " + format_number(sweep) +
                           " degrees: it must be more than 0 and 360 at most, either way");
  const int least = int(std::abs(sweep) / 180) + 1;
  const int arcs = options.arcs == 0 ? int(std::ceil(std::abs(sweep) / 90)) : options.arcs;
  if (arcs < least || arcs > most_arcs)
    throw InvalidParameter(format_number(arcs) + " arcs of " + format_number(sweep) + " degrees: " +
                           (arcs > most_arcs ? format_number(most_arcs) + " at most are taken"
                                             : "each must be less than 180 degrees, so there must be " +
                                                   format_number(least) + " or more"));
  const bool rational = profile.coordinates == Coordinates::homogeneous;
  const Index n = profile.knots.num_points(), m = 2 * arcs + 1;
  if (profile.columns.rows() != n || profile.columns.cols() != (rational ? 3 : 2) || !profile.columns.allFinite())
    throw InvalidParameter("profile: " + format_number(n) +
                           " finite control points (x, z) or (w x, w z, w) are needed");
  const Eigen::Matrix3d turn = options.axis.turn();
  const double half = sweep / (2.0 * arcs);
  Points columns(Eigen::Index{m} * n, 4);
  for (Index i = 0; i < m; ++i) {
    // The last angle is the end of the sweep itself: whole turns come back to the same column.
    const double angle = i == m - 1 ? start + sweep : start + i * half;
    const double c = cos_degrees(angle), s = sin_degrees(angle), omega = i % 2 == 0 ? 1 : cos_degrees(half);
    for (Index j = 0; j < n; ++j) {
      const double X = profile.columns(j, 0), Z = profile.columns(j, 1), W = rational ? profile.columns(j, 2) : 1;
      columns.row(Eigen::Index{j} * m + i)
          << Eigen::RowVector3d(c * X, s * X, omega * Z) * turn.transpose() + omega * W * options.axis.point,
          omega * W;
    }
  }
  return spline_net(arc_knots(arcs), profile.knots, std::move(columns), Coordinates::homogeneous);
}

}  // namespace sublimit
