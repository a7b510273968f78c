// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/cap_fitter.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace sublimit {
namespace {

/// Rows of a square's net by values at pairs of nodes, the second fastest.
Points fitted_net(const Eigen::MatrixXd& coefficients, const Points& values) {
  const Eigen::Index n = coefficients.rows();
  const Eigen::RowVector3d origin = values.row(0);
  Points along(n * n, 3), net(n * n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    along.middleRows(i * n, n) = coefficients * (values.middleRows(i * n, n).rowwise() - origin);
  for (Eigen::Index j = 0; j < n; ++j) {
    Points column(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) column.row(i) = along.row(i * n + j);
    const Points own = coefficients * column;
    for (Eigen::Index i = 0; i < n; ++i) net.row(i * n + j) = own.row(i) + origin;
  }
  return net;
}

Eigen::RowVector3d point_of(const LimitQuad& quad, double s, double t) {
  const int d = quad.degree;
  const Eigen::VectorXd a = bernstein_values(d, s), b = bernstein_values(d, t);
  Eigen::RowVector3d x = Eigen::RowVector3d::Zero();
  for (int i = 0; i <= d; ++i)
    for (int j = 0; j <= d; ++j) x += a[i] * b[j] * quad.net.row(i * (d + 1) + j);
  return x;
}

/// The corner that the only child without a polynomial is at; -1 if there is none.
int centre_of(const CadCell& cell) {
  int centre = -1, without = 0;
  for (const PieceLink& link : cell.type->children()) {
    if (link.type->polynomial()) continue;
    ++without;
    const std::optional<CellCorners> child = child_of(cell.corners, link.map, cell.triangle);
    for (int k = 0; child && k < (cell.triangle ? 3 : 4); ++k)
      if (std::ranges::find(*child, cell.corners[size_t(k)]) != child->end()) centre = k;
  }
  return without == 1 ? centre : -1;
}

}  // namespace

SeenFromCorner::SeenFromCorner(const CadCell& cell, int corner) : triangle(cell.triangle) {
  const std::vector<std::array<double, 2>> at = corners_in_address(cell);
  const size_t n = at.size(), k = size_t(corner), next = (k + 1) % n, before = (k + n - 1) % n;
  origin << at[k][0], at[k][1];
  sides << at[next][0] - origin[0], at[before][0] - origin[0], at[next][1] - origin[1], at[before][1] - origin[1];
}

Place SeenFromCorner::place(Index address, double u, double v) const {
  const Eigen::Vector2d at = origin + sides * Eigen::Vector2d(u, v);
  return {address, at[0], at[1]};
}

Place SeenFromCorner::warped(const Place& s, double exponent) const {
  const Eigen::Vector2d own = sides.inverse() * (Eigen::Vector2d(s.u, s.v) - origin);
  const double r = triangle ? own[0] + own[1] : own[0] + own[1] - own[0] * own[1];
  if (!(r > 0) || std::abs(r - 1) < 1e-12) return s;
  const Eigen::Vector2d at = origin + sides * (own * std::pow(r, exponent));
  return {s.face, at[0], at[1]};
}

std::vector<int> centres_of(const std::vector<CadCell>& cells) {
  std::vector<int> centres;
  for (const CadCell& cell : cells) centres.push_back(centre_of(cell));
  return centres;
}

CapFitter::CapFitter(const LimitMap& surface, const Points& points, int degree)
    : bound_(surface, points),
      triangles_(surface.addresses().triangles()),
      degree_(degree),
      coefficients_(interpolation(degree)) {}

Place CapFitter::inside(Place s) const {
  s.u = std::clamp(s.u, 0.0, 1.0);
  s.v = std::clamp(s.v, 0.0, triangles_ ? 1 - s.u : 1.0);
  return s;
}

std::vector<double> CapFitter::exponents(const std::vector<CadCell>& cells, std::span<const int> centres,
                                         std::span<const size_t> group) const {
  constexpr double far = 0x1p-6;  // the next eigenvalues matter little there
  std::vector<Place> places;
  for (size_t c = 0; c < cells.size(); ++c) {
    const SeenFromCorner seen(cells[c], std::max(centres[c], 0));
    for (int side = 0; side < 2; ++side)
      for (const double length : {0.0, far, far / 2})
        places.push_back(inside(seen.place(cells[c].address, side == 0 ? length : 0, side == 0 ? 0 : length)));
  }
  const Points x = bound_.evaluate(places, 0, false).position;
  std::vector<double> sum(cells.size(), 0), count(cells.size(), 0);
  for (size_t c = 0; c < cells.size(); ++c)
    for (Eigen::Index side = 0; side < 2; ++side) {
      const Eigen::Index row = Eigen::Index(c) * 6 + side * 3;
      const double whole = (x.row(row + 1) - x.row(row)).norm(), half = (x.row(row + 2) - x.row(row)).norm();
      const double alpha = -std::log2(half / whole);
      ++count[group[c]];
      if (centres[c] < 0 || !(alpha > 0.1) || !(alpha < 10)) count[group[c]] = HUGE_VAL;  // not all of them: none
      sum[group[c]] += std::isfinite(alpha) ? alpha : 0;
    }
  std::vector<double> result(cells.size(), 0);
  for (size_t c = 0; c < cells.size(); ++c)
    if (std::isfinite(count[group[c]])) result[c] = count[group[c]] / sum[group[c]] - 1;
  return result;
}

std::vector<LimitQuad> CapFitter::caps(const std::vector<CadCell>& cells, std::span<const size_t> group) const {
  const std::vector<int> centres = centres_of(cells);
  const std::vector<double> exponent = exponents(cells, centres, group);
  const std::vector<double> nodes = interpolation_nodes(degree_);
  std::vector<LimitQuad> quads;
  std::vector<Place> places;
  for (size_t c = 0; c < cells.size(); ++c) {
    const CadCell& cell = cells[c];
    LimitQuad quad{cell.address, cell.corners};
    quad.is_exact = false;
    quad.degree = degree_;
    quad.size = std::ldexp(1.0, -cell.depth) / (cell.triangle ? 2 : 1);
    const std::vector<std::array<double, 2>> at = corners_in_address(cell);
    const SeenFromCorner seen(cell, std::max(centres[c], 0));
    for (size_t k = 0; k < (cell.triangle ? 3u : 1u); ++k) {
      quad.third = cell.triangle ? int(k) : -1;
      if (cell.triangle)
        quad.corners = third_of_triangle(at, k);
      else
        std::ranges::copy(at, quad.corners.begin());
      for (const double s : nodes)
        for (const double t : nodes) places.push_back(inside(seen.warped(quad.place(s, t), exponent[c])));
      quads.push_back(quad);
    }
  }
  const LimitSamples samples = bound_.evaluate(places, 0, false);
  const Eigen::Index size = Eigen::Index(nodes.size() * nodes.size());
  for (size_t q = 0; q < quads.size(); ++q)
    quads[q].net = fitted_net(coefficients_, samples.position.middleRows(Eigen::Index(q) * size, size));
  return quads;
}

std::vector<double> CapFitter::deviations(const std::vector<LimitQuad>& quads) const {
  constexpr int grid = 6, rounds = 3;
  std::vector<Place> places;
  std::vector<Eigen::RowVector3d> own;
  for (const LimitQuad& quad : quads)
    for (int i = 0; i < grid; ++i)
      for (int j = 0; j < grid; ++j) {
        const double s = (i + 0.5) / grid, t = (j + 0.5) / grid;
        places.push_back(inside(quad.place(s, t)));
        own.push_back(point_of(quad, s, t));
      }
  std::vector<double> distance(own.size(), HUGE_VAL);
  for (int round = 0; round < rounds; ++round) {
    const LimitSamples x = bound_.evaluate(places, 1, false);
    for (size_t i = 0; i < own.size(); ++i) {
      const auto row = Eigen::Index(i);
      const Eigen::Vector3d off = (own[i] - x.position.row(row)).transpose();
      distance[i] = std::min(distance[i], off.norm());
      if (x.order[i] < 1) continue;
      Eigen::Matrix<double, 3, 2> J;
      J << x.du.row(row).transpose(), x.dv.row(row).transpose();
      const Eigen::Vector2d step = J.colPivHouseholderQr().solve(off);
      if (!step.allFinite()) continue;
      places[i].u += step[0], places[i].v += step[1];
      places[i] = inside(places[i]);
    }
  }
  std::vector<double> largest(quads.size(), 0);
  for (size_t i = 0; i < own.size(); ++i)
    largest[i / (grid * grid)] = std::max(largest[i / (grid * grid)], distance[i]);
  return largest;
}

}  // namespace sublimit
