// SPDX-License-Identifier: Apache-2.0
#include "support/regular_limit.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "sublimit/analysis/limit_points.h"
#include "sublimit/refine.h"
#include "sublimit/sparse_product.h"
#include "support/meshes.h"
#include "support/precise.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

bool takes_triangles(const Scheme<double>& scheme) { return scheme.face_size() == 3; }

/// m x n quads or twice as many triangles, closed up to a torus; vertex (i, j) has number i n + j.
ControlMesh regular_torus(Index m, Index n, bool triangles) {
  std::vector<std::vector<Index>> faces;
  const auto at = [&](Index i, Index j) { return (i % m) * n + j % n; };
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) {
      if (triangles) {
        faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      } else {
        faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  return make_mesh(std::vector<Eigen::Vector3d>(size_t(m * n), Eigen::Vector3d::Zero()), faces);
}

}  // namespace

double cardinal_bspline(int degree, double x) {
  const double u = x + (degree + 1) / 2.0;  // knots 0, 1, ..., degree + 1
  std::vector<double> N(size_t(degree) + 1);
  for (int i = 0; i <= degree; ++i) N[i] = u >= i && u < i + 1;
  for (int d = 1; d <= degree; ++d)
    for (int i = 0; i + d <= degree; ++i) N[i] = ((u - i) * N[i] + (i + d + 1 - u) * N[i + 1]) / d;
  return N[0];
}

BoxSpline::BoxSpline(Directions directions, std::vector<int> multiplicities)
    : directions_(std::move(directions)), multiplicities_(std::move(multiplicities)) {}

double BoxSpline::operator()(double x, double y) const {
  double width = 0, height = 0;  // of the smallest box around the support
  for (size_t i = 0; i < directions_.size(); ++i) {
    width += multiplicities_[i] * std::abs(directions_[i].first);
    height += multiplicities_[i] * std::abs(directions_[i].second);
  }
  if (2 * std::abs(x) > width || 2 * std::abs(y) > height) return 0;
  using Vector = Eigen::Matrix<Precise, 2, 1>;
  using Counts = std::vector<int>;
  const size_t kinds = directions_.size();
  std::vector<Vector> xi;
  for (const auto& [a, b] : directions_) xi.push_back({Precise(a), Precise(b)});
  // Pieces of a continuous spline agree on their common lines; a hair off them, none of the recursion's pieces is
  // ambiguous.
  Vector start{Precise(x) + Precise("1e-40"), Precise(y) + Precise("1.7e-40")};
  for (size_t i = 0; i < kinds; ++i) start += multiplicities_[i] * xi[i] / Precise(2);

  std::map<std::pair<Counts, Counts>, Precise> known;
  const std::function<Precise(const Counts&, const Counts&)> value = [&](const Counts& counts, const Counts& shifts) {
    const auto found = known.find({counts, shifts});
    if (found != known.end()) return found->second;
    Vector at = start;
    int total = 0, spanning = 0;
    Eigen::Matrix<Precise, 2, 2> gram = Eigen::Matrix<Precise, 2, 2>::Zero();
    for (size_t i = 0; i < kinds; ++i) {
      at -= Precise(shifts[i]) * xi[i];
      total += counts[i];
      spanning += counts[i] > 0;
      gram += Precise(counts[i]) * xi[i] * xi[i].transpose();
    }
    Precise result = 0;
    if (spanning >= 2) {
      const Vector dual = gram.inverse() * at;
      for (size_t i = 0; i < kinds && total > 2; ++i) {
        if (counts[i] == 0) continue;
        Counts fewer = counts, shifted = shifts;
        --fewer[i];
        ++shifted[i];
        const Precise t = xi[i].dot(dual);
        result += counts[i] * (t * value(fewer, shifts) + (1 - t) * value(fewer, shifted)) / Precise(total - 2);
      }
      if (total == 2) {
        bool inside = true;
        for (size_t i = 0; i < kinds; ++i)
          if (counts[i] == 1) inside &= xi[i].dot(dual) >= 0 && xi[i].dot(dual) < 1;
        if (inside) result = 1 / sqrt(abs(gram.determinant()));
      }
    }
    return known[{counts, shifts}] = result;
  };
  return static_cast<double>(value(multiplicities_, Counts(kinds, 0)));
}

double regular_limit_error(const Scheme<double>& scheme, const Generator& phi) {
  const Index m = 11, n = 12;
  const std::vector<Level> levels = refine(scheme, regular_torus(m, n, takes_triangles(scheme)), 2);
  const auto wrapped = [](double x, double period) { return x - period * std::round(x / period); };
  // Masks are symmetric, so the place of a vertex is the mean of the places that it is made of.
  Points place(m * n, 2);
  for (Index v = 0; v < m * n; ++v) place.row(v) << v / n, v % n;
  SparseMatrix P(m * n, m * n);
  P.setIdentity();
  LimitMaskCache cache(scheme);
  std::map<std::pair<double, double>, double> known;
  double worst = 0;
  for (const Level& level : levels) {
    if (level.number > 0) {
      Points next = Points::Zero(level.S.rows(), 2);
      for (Index r = 0; r < level.S.rows(); ++r) {
        const Index first = level.S.innerIndexPtr()[level.S.outerIndexPtr()[r]];
        for (const int c : {0, 1}) {
          next(r, c) = place(first, c);
          for (SparseMatrix::InnerIterator it(level.S, r); it; ++it)
            next(r, c) += it.value() * wrapped(place(it.col(), c) - place(first, c), c == 0 ? m : n);
        }
      }
      place = next;
      P = product(level.S, P);
    }
    const SparseMatrix L = limit_matrices(level, cache).position;
    const Eigen::MatrixXd rows = Eigen::MatrixXd(product(L, P));
    for (Index r = 0; r < rows.rows(); ++r)
      for (Index c = 0; c < rows.cols(); ++c) {
        double expected = 0;
        // Twelfths are what places are made of; a rounded key finds the value that was computed before.
        const auto key = [](double x) { return std::round(x * 768) / 768; };
        const double dx = key(wrapped(place(r, 0) - c / n, m)), dy = key(wrapped(place(r, 1) - c % n, n));
        const auto [at, is_new] = known.try_emplace({dx, dy}, 0);
        if (is_new)
          for (const int a : {-1, 0, 1})  // a wide generator reaches around
            for (const int b : {-1, 0, 1}) at->second += phi(dx + a * m, dy + b * n);
        expected = at->second;
        worst = std::max(worst, std::abs(rows(r, c) - expected));
      }
  }
  return worst;
}

int reproduced_degree(const Scheme<double>& scheme) {
  const Index m = 16;
  const ControlMesh mesh = takes_triangles(scheme) ? triangle_grid(m, m) : grid(m, m);
  Points x(mesh.positions.rows(), 2);
  for (Index v = 0; v < x.rows(); ++v) x.row(v) << (v % (m + 1) - m / 2) / 4.0, (v / (m + 1) - m / 2) / 4.0;
  const Level level = refine(scheme, mesh, 1)[1];
  const Points place = apply(level.S, x);
  for (int degree = 0; degree <= 8; ++degree)
    for (int p = 0; p <= degree; ++p) {
      const auto monomial = [&](const Points& at) {
        Points values(at.rows(), 1);
        for (Index r = 0; r < at.rows(); ++r) values(r, 0) = std::pow(at(r, 0), p) * std::pow(at(r, 1), degree - p);
        return values;
      };
      const Points values = apply(level.S, monomial(x)), expected = monomial(place);
      for (Index r = 0; r < values.rows(); ++r)
        if (place.row(r).cwiseAbs().maxCoeff() < 0.8 && std::abs(values(r, 0) - expected(r, 0)) > rounding(64, 4))
          return degree - 1;
    }
  return 8;
}

}  // namespace sublimit::testing
