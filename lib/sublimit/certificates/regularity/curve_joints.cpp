// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/curve_joints.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// Taylor coefficients of a piece at its start or end, by row: derivative/k!.
Eigen::MatrixXd taylor(Eigen::MatrixXd points, bool at_end) {
  const Eigen::Index degree = points.rows() - 1;
  Eigen::MatrixXd result(degree + 1, points.cols());
  double factor = 1;  // degree!/(degree - k)!/k!
  for (Eigen::Index k = 0; k <= degree; ++k) {
    result.row(k) = factor * points.row(at_end ? points.rows() - 1 : 0);
    if (k == degree) break;
    points = (points.bottomRows(points.rows() - 1) - points.topRows(points.rows() - 1)).eval();
    factor *= static_cast<double>(degree - k) / static_cast<double>(k + 1);
  }
  return result;
}

/// Coefficients of a power series' powers: (sum b_j t^j)^m up to order n, b_0 = 0.
std::vector<double> power_series(const std::vector<double>& b, int m, size_t n) {
  std::vector<double> result(n + 1, 0.0);
  result[0] = 1;
  for (int i = 0; i < m; ++i) {
    std::vector<double> next(n + 1, 0.0);
    for (size_t j = 0; j <= n; ++j)
      for (size_t k = 1; k < b.size() && j + k <= n; ++k) next[j + k] += result[j] * b[k];
    result = std::move(next);
  }
  return result;
}

std::string order_word(char letter, int order) { return std::string(1, letter) + "^" + std::to_string(order); }

CurveJoint joint(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after, double size, double tolerance) {
  CurveJoint j;
  const Eigen::Index orders = std::max(before.rows(), after.rows());
  const auto row = [&](const Eigen::MatrixXd& m, Eigen::Index k) {
    return k < m.rows() ? Eigen::RowVectorXd(m.row(k)) : Eigen::RowVectorXd(Eigen::RowVectorXd::Zero(m.cols()));
  };
  Eigen::MatrixXd l(orders, before.cols()), r(orders, before.cols());
  for (Eigen::Index k = 0; k < orders; ++k) l.row(k) = row(before, k), r.row(k) = row(after, k);
  const auto agree = [&](const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b, double scale) {
    j.residual = (a - b).norm() / scale;
    return j.residual <= tolerance;
  };
  const auto scale_of = [&](Eigen::Index k) { return std::max({size, l.row(k).norm(), r.row(k).norm()}); };
  j.gap = (l.row(0) - r.row(0)).norm();
  if (!agree(l.row(0), r.row(0), size)) {
    j.because = "the ends are " + format_number(j.gap) + " apart";
    return j;
  }
  j.c = 0;
  while (j.c + 1 < orders && agree(l.row(j.c + 1), r.row(j.c + 1), scale_of(j.c + 1))) ++j.c;
  j.same_polynomial = j.c + 1 == orders;
  j.g = 0;
  const double tiny = std::max(tolerance, 1e-15) * size;
  j.has_tangents = orders > 1 && l.row(1).norm() > tiny && r.row(1).norm() > tiny;
  if (!j.has_tangents) {
    j.because = "a derivative vanishes, so that the tangent is not seen there";
    if (j.same_polynomial) j.g = j.c, j.because += "; both sides are the same polynomial";
    return j;
  }
  std::vector<double> b{0};
  for (Eigen::Index n = 1; n < orders; ++n) {
    // r_n = b_n l_1 + terms of smaller b.
    Eigen::RowVectorXd known = Eigen::RowVectorXd::Zero(l.cols());
    for (Eigen::Index m = 1; m <= n; ++m)
      known += power_series(b, static_cast<int>(m), static_cast<size_t>(n))[static_cast<size_t>(n)] * l.row(m);
    const Eigen::RowVectorXd rest = r.row(n) - known;
    const double next = rest.dot(l.row(1)) / l.row(1).squaredNorm();
    const double scale = n == 1 ? r.row(1).norm() : std::max({size, r.row(n).norm(), known.norm()});
    if (!agree(rest, next * l.row(1), scale)) break;
    b.push_back(next);
    double factorial = 1;
    for (Eigen::Index k = 2; k <= n; ++k) factorial *= static_cast<double>(k);
    j.ratios.push_back(next * factorial);
    if (n == 1 && next <= 0) {
      j.because = "the tangents are opposite (ratio " + format_number(next) + "): the curve turns back in a cusp";
      return j;
    }
    j.g = static_cast<int>(n);
  }
  j.g_is_least = j.g + 1 == orders;
  if (j.g == 0) {
    const double sine =
        std::sqrt(std::max(0.0, 1 - std::pow(l.row(1).dot(r.row(1)) / (l.row(1).norm() * r.row(1).norm()), 2)));
    j.because = "the tangents have different directions (sine of the angle " + format_number(sine) + ")";
  } else {
    j.because = "with the tangents' ratio " + format_number(j.ratios[0]) + " > 0 " + order_word('G', j.g) +
                (j.g_is_least ? " holds, and no order up to the degree fails" : " holds");
    if (j.ratios.size() > 1) j.because += "; the second ratio, " + format_number(j.ratios[1]) + ", may have any sign";
    if (j.same_polynomial) j.because = "both sides are the same polynomial";
  }
  return j;
}

}  // namespace

std::vector<CurveJoint> curve_joints(const BezierCurve& curve, double tolerance) {
  if (curve.pieces.empty()) throw InvalidMesh("the curve has no pieces");
  const Eigen::Index dimension = curve.pieces[0].cols();
  Eigen::RowVectorXd low = curve.pieces[0].row(0), high = low;
  for (size_t i = 0; i < curve.pieces.size(); ++i) {
    const Eigen::MatrixXd& piece = curve.pieces[i];
    if (piece.rows() < 2)
      throw InvalidMesh("piece " + std::to_string(i) + " has one control point; at least 2 are needed");
    if (piece.cols() != dimension)
      throw InvalidMesh("piece " + std::to_string(i) + " has another dimension than piece 0");
    low = low.cwiseMin(piece.colwise().minCoeff());
    high = high.cwiseMax(piece.colwise().maxCoeff());
  }
  const double size = std::max((high - low).norm(), 1e-300);
  std::vector<CurveJoint> joints;
  const size_t count = curve.pieces.size() - (curve.closed ? 0 : 1);
  for (size_t i = 0; i < count; ++i) {
    joints.push_back(joint(taylor(curve.pieces[i], true), taylor(curve.pieces[(i + 1) % curve.pieces.size()], false),
                           size, tolerance));
    joints.back().piece = static_cast<int>(i);
  }
  return joints;
}

BezierCurve read_bezier_curve(const std::string& text) {
  BezierCurve curve;
  size_t number = 0, columns = 0;
  const auto refuse = [&](const std::string& what) {
    throw FormatError("line " + std::to_string(number) + ": " + what);
  };
  std::vector<std::vector<std::vector<double>>> pieces;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find('\n', start), text.size());
    std::string line = text.substr(start, end - start);
    start = end + 1;
    ++number;
    line = line.substr(0, line.find('#'));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    if (columns == 0) {
      if (line != "piece,x,y" && line != "piece,x,y,z")
        refuse("the header piece,x,y or piece,x,y,z is needed, not '" + line + "'");
      columns = line == "piece,x,y" ? 3 : 4;
      continue;
    }
    if (line == "closed") {
      curve.closed = true;
      continue;
    }
    std::vector<double> fields;
    for (size_t at = 0; at <= line.size();) {
      const size_t comma = std::min(line.find(',', at), line.size());
      const Parsed<double> value = parse_number<double>(std::string_view(line).substr(at, comma - at));
      if (!value || !std::isfinite(value.value)) refuse("'" + line.substr(at, comma - at) + "' is not a number");
      fields.push_back(value.value);
      at = comma + 1;
    }
    if (fields.size() != columns)
      refuse(std::to_string(fields.size()) + " fields instead of " + std::to_string(columns));
    const bool is_next = fields[0] == static_cast<double>(pieces.size());
    if (!is_next && fields[0] + 1 != static_cast<double>(pieces.size()))
      refuse("piece " + format_number(fields[0]) + " does not follow piece " +
             std::to_string(static_cast<int>(pieces.size()) - 1));
    if (is_next) pieces.emplace_back();
    pieces.back().emplace_back(fields.begin() + 1, fields.end());
    if (pieces.back().size() > 21) refuse("piece " + format_number(fields[0]) + " has more than 21 control points");
  }
  if (columns == 0) throw FormatError("the header piece,x,y or piece,x,y,z is missing");
  for (const auto& points : pieces) {
    Eigen::MatrixXd piece(points.size(), columns - 1);
    for (size_t i = 0; i < points.size(); ++i)
      for (size_t k = 0; k + 1 < columns; ++k)
        piece(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = points[i][k];
    curve.pieces.push_back(std::move(piece));
  }
  return curve;
}

}  // namespace sublimit
