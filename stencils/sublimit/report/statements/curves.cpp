// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sublimit/certificates/regularity/curve_regularity.h"
#include "sublimit/certificates/regularity/rational_schemes.h"

namespace sublimit::report {
namespace {

Symbol times_one_plus_z(const Symbol& a, const Rational& factor) {
  Symbol r = a;
  r.coefficients.push_back(0);
  for (size_t i = r.coefficients.size() - 1; i > 0; --i) r.coefficients[i] += r.coefficients[i - 1];
  for (Rational& c : r.coefficients) c *= factor;
  return r;
}

Rational tension_weight(const Ratio& g) { return Rational(g) / Rational(16); }

/// The four-point scheme's symbol for any tension, beyond those that the scheme takes too.
Symbol four_point_symbol(const Ratio& g) {
  const Rational w = tension_weight(g), inner = Rational(Ratio{1, 2}) + w;
  return {.first = -3, .coefficients = {-w, 0, inner, 1, inner, 0, -w}, .shift = 0};
}

/// Of each curve's legs, the largest angle between the leg and the tangents at its ends, in degrees.
double largest_angle(const ControlPolygon& p) {
  double most = 0;
  for (const ControlPolygon::Curve& curve : p.curves)
    for (size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const Index a = curve.points[i], b = curve.points[i + 1];
      const Eigen::RowVectorXd chord = (p.points.row(b) - p.points.row(a)).normalized();
      for (const Index end : {a, b}) {
        const double cosine = std::clamp(chord.dot(p.tangents.row(end)), -1.0, 1.0);
        most = std::max(most, std::acos(cosine) * 180 / std::numbers::pi);
      }
    }
  return most;
}

/// The difference of the two angles of a leg, at most: 0 where every leg's triangle is isosceles, as on a circle.
double largest_difference(const ControlPolygon& p) {
  double most = 0;
  for (const ControlPolygon::Curve& curve : p.curves)
    for (size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const Index a = curve.points[i], b = curve.points[i + 1];
      const Eigen::RowVectorXd chord = (p.points.row(b) - p.points.row(a)).normalized();
      most = std::max(most, std::abs(chord.dot(p.tangents.row(a)) - chord.dot(p.tangents.row(b))));
    }
  return most;
}

}  // namespace

Finding four_point_is_c1(const std::vector<Ratio>& tensions) {
  std::vector<bool> is_so;
  Finding f;
  int undecided = 0;
  for (const Ratio& g : tensions) {
    const CurveRegularity found = curve_regularity(four_point_symbol(g));
    is_so.push_back(found.smoothness.continuity >= 1);
    undecided += found.smoothness.continuity < 1 && found.smoothness.possible >= 1;
    std::string text = is_so.back() ? "C^1" : found.smoothness.possible >= 1 ? "not decided" : "not C^1";
    for (const DifferenceNorm& norm : found.smoothness.norms)
      if (norm.order == 2 && norm.norm.high < 1) text += ", norm of " + std::to_string(norm.steps) + " steps below 1";
    f.numbers["tension " + to_string(g)] = text;
  }
  f.fate = undecided > 0 ? Fate::depends : fate(is_so);
  f.computed = "enclosures of norms, and of the joint spectral radius, of the scheme of second differences";
  return f;
}

Finding averagings_give_degree(int more) {
  std::vector<bool> is_so;
  std::vector<int> continuity;
  constexpr int most = 5;
  Symbol a{.first = -1, .coefficients = {Ratio{1, 2}, 1, Ratio{1, 2}}};
  for (int n = 1; n <= most; ++n) {
    a = times_one_plus_z(a, Ratio{1, 2});
    const auto spline = find_curve_scheme<Rational>("lane-riesenfeld", {{"degree", std::to_string(n + more)}}).value();
    is_so.push_back(symbol(spline).coefficients == a.coefficients);
    Symbol placed = a;
    placed.shift = Rational(Ratio{n % 2, 2});
    continuity.push_back(curve_regularity(placed).smoothness.continuity);
  }
  Finding f{fate(is_so), "symbols (1+z)^(n+2)/2^(n+1), n = 1 ... 5, beside those of B-splines, and their smoothness"};
  f.numbers["continuity proved, n = 1 ... 5"] = continuity;
  return f;
}

Finding is_g1(const GeometricCurveScheme& scheme) {
  Points points(4, 2), tangents(4, 2);
  points << 0, 0, 2, 1, 4, 0, 5, -2;
  tangents << 0, 1, 1, .25, .5, -1, 0, -1;
  ControlPolygon polygon = polygon_through(points);
  tangents.rowwise().normalize();
  polygon.tangents = tangents;
  std::vector<double> angles;
  double after_one = 0;
  ControlPolygon data = scheme.checked(polygon);
  constexpr int steps = 8;
  for (int k = 0; k <= steps; ++k) {
    angles.push_back(largest_angle(data));
    if (k == 1) after_one = largest_difference(data);
    data = scheme.refine(data);
  }
  bool halved = true;
  for (size_t k = 1; k < angles.size(); ++k) halved = halved && angles[k] <= angles[k - 1] * (0.5 + 1e-9);
  Finding f{fate(halved), "angles between legs and tangents over 8 steps of one polygon: they halve in each"};
  f.numbers["largest angle in degrees"] = Json::array();
  for (const double a : angles) f.numbers["largest angle in degrees"].push_back(drawn(a));
  constexpr double rounding = 1e-14;
  f.numbers["both angles of each leg equal after one step"] = after_one < rounding;
  return f;
}

Finding face_point_uses_rows(int stride) {
  // Row r of the net that the other direction has made lies at height r; face point j belongs at 2 j + 1.
  std::vector<bool> is_so;
  Finding f;
  for (const int j : {1, 2, 3}) {
    const auto row = [&](int k) { return Rational(stride * (j + k)); };
    const Rational at = (Rational(9) * (row(0) + row(1)) - row(-1) - row(2)) / Rational(16);
    is_so.push_back(at == Rational(2 * j + 1));
    f.numbers["height of face point " + std::to_string(2 * j + 1)] = to_string(at);
  }
  f.fate = fate(is_so);
  f.computed = "the four-point rule applied to rows of a net whose heights are their numbers";
  return f;
}

}  // namespace sublimit::report
