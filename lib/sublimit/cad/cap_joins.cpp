// SPDX-License-Identifier: Apache-2.0
// Caps that join their exact neighbours with common tangent planes: the rows of a patch next to its outer sides are
// those of the limit's own cross derivatives, which are polynomials there. What is left is fitted; at the vertex it
// keeps to the tangent plane.
#include <Eigen/Dense>

#include <algorithm>

#include "sublimit/cad/cap_fitter.h"
#include "sublimit/cad/quad_edges.h"
#include "sublimit/core/detail/dense_decompositions.h"

namespace sublimit {
namespace {

/// Values of Bernstein polynomials at the nodes but the ends, by rows.
Eigen::MatrixXd inner_values(int degree) {
  const std::vector<double> nodes = interpolation_nodes(degree);
  Eigen::MatrixXd values(degree - 1, degree + 1);
  for (int k = 1; k < degree; ++k) values.row(k - 1) = bernstein_values(degree, nodes[size_t(k)]);
  return values;
}

/// A net seen from the corner at the vertex.
struct SeenNet {
  LimitQuad& quad;
  int turn;
  auto operator()(Eigen::Index i, Eigen::Index j) const {
    return quad.net.row(turned_row(quad.degree, turn, int(i), int(j)));
  }
};

/// Coefficients 1 .. degree - 2 of a spoke by its points at inner nodes.
/// @param at  the coefficient
template <class Coefficient>
void fit_spoke(const Eigen::MatrixXd& values, const Points& points, const Coefficient& at) {
  const Eigen::Index d = values.cols() - 1;
  Points right = points;
  for (const Eigen::Index i : {Eigen::Index{0}, d - 1, d}) right -= values.col(i) * at(i);
  const Eigen::MatrixXd found = PivotedQr(values.middleCols(1, d - 2)).solve(right);
  for (Eigen::Index i = 1; i <= d - 2; ++i) at(i) = found.row(i - 1);
}

/// Coefficients 1 .. degree - 2 in both directions.
void fit_inside(const Eigen::MatrixXd& values, const Points& points, const SeenNet& net) {
  const Eigen::Index d = values.cols() - 1, n = d - 1, free = d - 2;
  Eigen::MatrixXd A(n * n, free * free);
  Points right = points;
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      for (Eigen::Index i = 0; i <= d; ++i)
        for (Eigen::Index j = 0; j <= d; ++j) {
          const double w = values(a, i) * values(b, j);
          if (i >= 1 && i <= free && j >= 1 && j <= free)
            A(a * n + b, (i - 1) * free + j - 1) = w;
          else
            right.row(a * n + b) -= w * net(i, j);
        }
  const Eigen::MatrixXd found = PivotedQr(A).solve(right);
  for (Eigen::Index i = 1; i <= free; ++i)
    for (Eigen::Index j = 1; j <= free; ++j) net(i, j) = found.row((i - 1) * free + j - 1);
}

}  // namespace

void CapFitter::join(const std::vector<CadCell>& cells, std::span<const size_t> group,
                     std::vector<LimitQuad>& quads) const {
  const std::vector<int> centres = centres_of(cells);
  const std::vector<double> exponent = exponents(cells, centres, group);
  const std::vector<double> nodes = interpolation_nodes(degree_);
  const Eigen::MatrixXd values = inner_values(degree_);
  const Eigen::Index n = degree_ + 1, d = degree_, a_quad = 2 * n + 1 + n * n;
  std::vector<Place> places;
  for (size_t c = 0; c < cells.size(); ++c) {
    const SeenFromCorner seen(cells[c], std::max(centres[c], 0));
    const auto add = [&](double u, double v, double warp) {
      places.push_back(inside(seen.warped(seen.place(cells[c].address, u, v), warp)));
    };
    for (const double t : nodes) add(1, t, 0);
    for (const double t : nodes) add(t, 1, 0);
    add(0, 0, 0);
    for (const double s : nodes)
      for (const double t : nodes) add(s, t, exponent[c]);
  }
  const LimitSamples x = bound_.evaluate(places, 1, true);
  for (size_t c = 0; c < cells.size(); ++c) {
    if (centres[c] < 0) continue;
    const SeenNet net{quads[c], centres[c]};
    const SeenFromCorner seen(cells[c], centres[c]);
    const Eigen::Index row = Eigen::Index(c) * a_quad;
    for (const int side : {0, 1}) {
      const Eigen::Index first = row + side * n;
      const Points across = coefficients_ * (seen.sides(0, side) * x.du.middleRows(first, n) +
                                             seen.sides(1, side) * x.dv.middleRows(first, n));
      for (Eigen::Index k = 0; k <= d; ++k) {
        if (side == 0)
          net(d - 1, k) = net(d, k) - across.row(k) / d;
        else
          net(k, d - 1) = net(k, d) - across.row(k) / d;
      }
    }
    const auto point = [&](Eigen::Index i, Eigen::Index j) { return x.position.row(row + 2 * n + 1 + i * n + j); };
    Points u(d - 1, 3), v(d - 1, 3), middle((d - 1) * (d - 1), 3);
    for (Eigen::Index i = 1; i < d; ++i) {
      u.row(i - 1) = point(i, 0);
      v.row(i - 1) = point(0, i);
      for (Eigen::Index j = 1; j < d; ++j) middle.row((i - 1) * (d - 1) + j - 1) = point(i, j);
    }
    fit_spoke(values, u, [&](Eigen::Index i) { return net(i, 0); });
    fit_spoke(values, v, [&](Eigen::Index i) { return net(0, i); });
    const Eigen::RowVector3d normal = x.normal.row(row + 2 * n), origin = net(0, 0);
    net(1, 0) -= normal * normal.dot(net(1, 0) - origin);
    net(0, 1) -= normal * normal.dot(net(0, 1) - origin);
    fit_inside(values, middle, net);
  }
}

}  // namespace sublimit
