// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/coons.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_rows.h"
#include "sublimit/patches/constructions/boolean_sum.h"
#include "sublimit/patches/constructions/common_space.h"
#include "sublimit/patches/constructions/interpolation.h"
#include "sublimit/patches/constructions/power_coefficients.h"
#include "sublimit/patches/detail/finer_knots.h"

namespace sublimit {
namespace {

using DataRow = Eigen::SparseVector<double>;

/// Rows of a matrix that is over a part of the data.
std::vector<DataRow> data_rows(const SparseMatrix& M, Index first, Index total) {
  std::vector<DataRow> rows;
  for (Index r = 0; r < M.rows(); ++r) {
    DataRow row(total);
    for (SparseMatrix::InnerIterator it(M, r); it; ++it)
      row.insertBack(first + static_cast<Index>(it.col())) = it.value();
    rows.push_back(std::move(row));
  }
  return rows;
}

void check_unit_domain(const Knots<double>& knots, const char* name) {
  if (!(knots.begin() == 0 && knots.end() == 1))
    throw InvalidParameter(std::string(name) + ": its domain is " + format_number(knots.begin()) + " to " +
                           format_number(knots.end()) + "; curves of Coons patches have the domain 0 to 1");
}

/// Blending functions as control points over knots: columns for value at 0, value at 1, and derivatives.
Eigen::MatrixXd blending_points(const Knots<double>& knots, int functionals, int degree) {
  if (degree == 1) return polynomial_points(knots, (Eigen::Matrix2d() << 1, -1, 0, 1).finished());
  return polynomial_points(knots, hermite_coefficients().topRows(functionals));
}

/// @param knots  c0, c1, d0, d1, and 4 more with twists or none
NetBuilder boolean_net(std::span<const Knots<double>> knots, int degree) {
  const size_t functionals = knots.size() / 2;
  for (size_t i = 0; i < knots.size(); ++i) {
    check_unit_domain(knots[i], coons_names[i]);
    const std::span<const double> t = knots[i].all();
    if (knots[i].is_closed() || t.front() != 0 || t.back() != 1)
      throw InvalidParameter(std::string(coons_names[i]) + ": its ends must be interpolated (clamped knots)");
  }
  // c0, c1, xv0, xv1 are along u, the others along v.
  std::vector<Knots<double>> along_u{knots[0], knots[1]}, along_v{knots[2], knots[3]};
  if (functionals == 4) {
    along_u.insert(along_u.end(), {knots[4], knots[5]});
    along_v.insert(along_v.end(), {knots[6], knots[7]});
  }
  const Knots<double> u = common_knots(along_u, degree, true), v = common_knots(along_v, degree, true);
  Index total = functionals == 4 ? 4 : 0;
  std::vector<Index> first;
  for (const Knots<double>& k : knots) first.push_back(total - (functionals == 4 ? 4 : 0)), total += k.num_points();

  BooleanSum<DataRow> sum;
  sum.phi = blending_points(u, int(functionals), degree), sum.psi = blending_points(v, int(functionals), degree);
  constexpr size_t numbers[2][4] = {{0, 1, 4, 5}, {2, 3, 6, 7}};
  const SplineCondition conditions[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  sum.Q.resize(functionals);
  for (size_t l = 0; l < functionals; ++l) {
    const size_t c = numbers[0][l], d = numbers[1][l];
    sum.C.push_back(data_rows(embedding(knots[c], u), first[c], total));
    sum.D.push_back(data_rows(embedding(knots[d], v), first[d], total));
    std::vector<DataRow> of_curve =
        data_rows(condition_rows(knots[c], std::span(conditions).first(functionals)), first[c], total);
    for (size_t k = 0; k < functionals; ++k) sum.Q[k].push_back(std::move(of_curve[k]));
  }
  for (size_t k = 2; k < functionals; ++k)
    for (size_t l = 2; l < functionals; ++l) {
      DataRow twist(total);
      twist.insertBack(total - 4 + Index((k - 2) + 2 * (l - 2))) = 1;
      sum.Q[k][l] = std::move(twist);
    }
  const Index m = u.num_points(), n = v.num_points();
  auto surface = std::make_shared<const SplineSurface>(u, v);
  SparseRows rows;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) {
      // On the boundary the curves themselves: the sum has them up to rounding, and up to gaps at corners.
      const DataRow row = j == 0       ? sum.C[0][size_t(i)]
                          : j == n - 1 ? sum.C[1][size_t(i)]
                          : i == 0     ? sum.D[0][size_t(j)]
                          : i == m - 1 ? sum.D[1][size_t(j)]
                                       : sum.at(i, j);
      for (DataRow::InnerIterator it(row); it; ++it)
        if (it.value() != 0) rows.add(static_cast<Index>(it.index()), it.value());
      rows.end_row();
    }
  std::vector<SparseRows::Row> spans;
  for (size_t r = 0; r < rows.size(); ++r) spans.push_back(rows[r]);
  return {std::move(surface), matrix_of(spans, total)};
}

/// Which curve's end is at a corner: of c0, c1, d0, d1 by their numbers, the side 0 or 1.
struct CornerEnds {
  size_t c, d;  ///< the curves
  int u, v;     ///< where
};
constexpr CornerEnds corner_ends[] = {{0, 2, 0, 0}, {0, 3, 1, 0}, {1, 2, 0, 1}, {1, 3, 1, 1}};

CurveNet clamped(const CurveNet& curve) { return in_space(curve, clamped_knots(curve.knots)); }

/// Curves with ends interpolated that are the same at corners.
void join_corners(std::span<CurveNet> curves, double tolerance) {
  const CornerGap gap = boundary_gap({curves[0], curves[1], curves[2], curves[3]});
  if (!(gap.distance <= tolerance))
    throw InvalidMesh("corner " + gap.corner + ": the ends of " + gap.curves + " are " + format_number(gap.distance) +
                      " apart, more than the tolerance " + format_number(tolerance) + "; they must be one point");
  for (const auto& [c, d, u, v] : corner_ends) {
    auto one = curves[c].columns.row(u == 0 ? 0 : curves[c].columns.rows() - 1);
    auto other = curves[d].columns.row(v == 0 ? 0 : curves[d].columns.rows() - 1);
    if (one == other) continue;
    one = (one + other) / 2;
    other = one;
  }
}

Points stacked_columns(std::span<const CurveNet> curves, const Points& more = {}) {
  Eigen::Index rows = more.rows();
  for (const CurveNet& curve : curves) rows += curve.columns.rows();
  Points data(rows, curves[0].columns.cols());
  Eigen::Index at = 0;
  for (const CurveNet& curve : curves)
    data.middleRows(at, curve.columns.rows()) = curve.columns, at += curve.columns.rows();
  if (more.rows() > 0) data.bottomRows(more.rows()) = more;
  return data;
}

}  // namespace

NetBuilder coons_builder(const std::array<Knots<double>, 4>& knots, CoonsBlending blending) {
  return boolean_net(knots, blending == CoonsBlending::bilinear ? 1 : 3);
}

NetBuilder general_coons_builder(const std::array<Knots<double>, 8>& knots) { return boolean_net(knots, 3); }

CornerGap boundary_gap(const CoonsBoundary& curves) {
  CornerGap worst;
  CoonsBoundary alike = curves;
  CurveNet* const all[] = {&alike[0], &alike[1], &alike[2], &alike[3]};
  make_alike(all);
  for (size_t i = 0; i < 4; ++i) {
    const auto& [c, d, u, v] = corner_ends[i];
    const double distance = (column_at(alike[c], u) - column_at(alike[d], v)).norm();
    if (!(distance <= worst.distance))
      worst = {distance, coons_corners[i], std::string(coons_names[c]) + " and " + coons_names[d]};
  }
  return worst;
}

double default_gap(const CoonsBoundary& curves) {
  const Points* const parts[] = {&curves[0].columns, &curves[1].columns, &curves[2].columns, &curves[3].columns};
  double size = 0;
  for (const Points* part : parts) size = std::max(size, extent(std::span(&part, 1)));
  return 1e-9 * size;
}

SplineNet coons(const CoonsBoundary& curves, CoonsBlending blending, double tolerance) {
  CoonsBoundary ends = curves;
  for (size_t i = 0; i < 4; ++i) {
    check_space_curve(curves[i], coons_names[i]);
    check_unit_domain(curves[i].knots, coons_names[i]);
    ends[i] = clamped(curves[i]);
  }
  CurveNet* const all[] = {&ends[0], &ends[1], &ends[2], &ends[3]};
  const Coordinates coordinates = make_alike(all);
  join_corners(ends, tolerance < 0 ? default_gap(curves) : tolerance);
  const NetBuilder builder = coons_builder({ends[0].knots, ends[1].knots, ends[2].knots, ends[3].knots}, blending);
  return built(builder, stacked_columns(ends), coordinates);
}

Points CheckedCoons::data(const Points& twists) const { return stacked_columns(curves, twists); }

std::array<Knots<double>, 8> CheckedCoons::knots() const {
  return {curves[0].knots, curves[1].knots, curves[2].knots, curves[3].knots,
          curves[4].knots, curves[5].knots, curves[6].knots, curves[7].knots};
}

CheckedCoons checked_coons(const CoonsBoundary& curves, const CoonsFields& fields, double tolerance) {
  const auto given = [&](size_t i) -> const CurveNet& { return i < 4 ? curves[i] : fields[i - 4]; };
  for (size_t i = 0; i < 8; ++i) {
    check_space_curve(given(i), coons_names[i]);
    check_unit_domain(given(i).knots, coons_names[i]);
    if (given(i).coordinates == Coordinates::homogeneous)
      throw InvalidParameter(std::string(coons_names[i]) +
                             " is rational: general Coons patches are of curves and fields that are not");
  }
  CheckedCoons checked{{clamped(given(0)), clamped(given(1)), clamped(given(2)), clamped(given(3)), clamped(given(4)),
                        clamped(given(5)), clamped(given(6)), clamped(given(7))},
                       Points(4, 3),
                       Points(4, 3),
                       tolerance < 0 ? default_gap(curves) : tolerance};
  join_corners(std::span(checked.curves).first(4), checked.tolerance);
  for (size_t i = 0; i < 4; ++i) {
    const auto& [c, d, u, v] = corner_ends[i];
    const auto check_end = [&](size_t field, double at, size_t curve, double end) {
      const double gap = (column_at(checked.curves[field], at) - column_at(checked.curves[curve], end, 1)).norm();
      if (!(gap <= checked.tolerance))
        throw InvalidMesh(std::string("corner ") + coons_corners[i] + ": " + coons_names[field] +
                          " and the derivative of " + coons_names[curve] + " differ by " + format_number(gap) +
                          ", more than the tolerance " + format_number(checked.tolerance) +
                          "; they must be the same vector");
    };
    const size_t xv = 4 + size_t(v), xu = 6 + size_t(u);
    check_end(xv, u, d, v);
    check_end(xu, v, c, u);
    checked.twists_of_xv.row(Eigen::Index(i)) = column_at(checked.curves[xv], u, 1);
    checked.twists_of_xu.row(Eigen::Index(i)) = column_at(checked.curves[xu], v, 1);
  }
  return checked;
}

SplineNet general_coons(const CoonsBoundary& curves, const CoonsFields& fields, const Points& twists,
                        double tolerance) {
  const CheckedCoons checked = checked_coons(curves, fields, tolerance);
  if (twists.rows() != 4 || twists.cols() != 3 || !twists.allFinite())
    throw InvalidParameter("twists: 4 finite vectors are needed, at (0,0), (1,0), (0,1), (1,1)");
  for (Eigen::Index i = 0; i < 4; ++i) {
    const auto check_twist = [&](const Points& of_field, const std::string& derivative) {
      const double gap = (of_field.row(i) - twists.row(i)).norm();
      if (!(gap <= checked.tolerance))
        throw InvalidMesh(std::string("corner ") + coons_corners[i] + ": " + derivative + " and the twist differ by " +
                          format_number(gap) + ", more than the tolerance " + format_number(checked.tolerance) +
                          "; they must be the same vector (the kind gregory blends twists that disagree)");
    };
    const CornerEnds& ends = corner_ends[i];
    check_twist(checked.twists_of_xv, std::string("the derivative of ") + coons_names[4 + ends.v]);
    check_twist(checked.twists_of_xu, std::string("the derivative of ") + coons_names[6 + ends.u]);
  }
  return built(general_coons_builder(checked.knots()), checked.data(twists), Coordinates::plain);
}

}  // namespace sublimit
