// SPDX-License-Identifier: Apache-2.0
#include "truth/regular_limit.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/refine.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

Eigen::VectorXd monomial(const Points& at, int p, int q) { return at.col(0).array().pow(p) * at.col(1).array().pow(q); }

bool takes_triangles(const Scheme<double>& scheme) { return scheme.face_size() == 3; }

/// m x n quads or twice as many triangles, closed up to a torus; vertex (i, j) has number i n + j.
Mesh regular_torus(Index m, Index n, bool triangles) {
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
  // Pieces of a continuous spline agree on their common lines; a hair off them, none of the recursion's pieces is
  // ambiguous.
  return static_cast<double>(inside(Precise(x) + Precise("1e-40"), Precise(y) + Precise("1.7e-40")));
}

Precise BoxSpline::inside(const Precise& x, const Precise& y) const {
  double width = 0, height = 0;  // of the smallest box around the support
  for (size_t i = 0; i < directions_.size(); ++i) {
    width += multiplicities_[i] * std::abs(directions_[i].first);
    height += multiplicities_[i] * std::abs(directions_[i].second);
  }
  if (abs(2 * x) > width || abs(2 * y) > height) return 0;
  using Vector = Eigen::Matrix<Precise, 2, 1>;
  using Counts = std::vector<int>;
  const size_t kinds = directions_.size();
  std::vector<Vector> xi;
  for (const auto& [a, b] : directions_) xi.push_back({Precise(a), Precise(b)});
  Vector start{x, y};
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
  return value(multiplicities_, Counts(kinds, 0));
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
  LimitCache cache(scheme);
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

namespace {

/// The largest degree up to 10 for which polynomials on a flat regular mesh pass: `pass` gets the limits of their
/// values, their own values at the places of these limits, and the places, away from the border.
template <class Pass>
int largest_degree(const Scheme<double>& scheme, const Pass& pass) {
  const Index m = 16;
  const Mesh mesh = takes_triangles(scheme) ? triangle_grid(m, m) : grid(m, m);
  Points x(mesh.positions.rows(), 2);
  for (Index v = 0; v < x.rows(); ++v) x.row(v) << (v % (m + 1) - m / 2) / 4.0, (v / (m + 1) - m / 2) / 4.0;
  const std::vector<Level> levels = refine(scheme, mesh, scheme.period);
  LimitCache cache(scheme);
  const LimitMatrices limit = limit_matrices(levels.back(), cache);
  const auto limits = [&](Points values) {
    for (size_t k = 1; k < levels.size(); ++k) values = apply(levels[k].S, values);
    return apply(limit.position, values);
  };
  const Points place = limits(x);
  std::vector<Index> inside;
  for (Index r = 0; r < place.rows(); ++r)
    if (place.row(r).cwiseAbs().maxCoeff() < 0.8) inside.push_back(r);
  const Points places = place(inside, Eigen::all);
  for (int degree = 0; degree <= 10; ++degree)
    for (int p = 0; p <= degree; ++p) {
      const Points values = limits(monomial(x, p, degree - p));
      if (!pass(Eigen::VectorXd(values(inside, 0)), monomial(places, p, degree - p), places, degree)) return degree - 1;
    }
  return 10;
}

const double exact = rounding(64, 4);

}  // namespace

int reproduced_degree(const Scheme<double>& scheme) {
  return largest_degree(scheme, [](const Eigen::VectorXd& values, const Eigen::VectorXd& own, const Points&, int) {
    return (values - own).cwiseAbs().maxCoeff() <= exact;
  });
}

int generated_degree(const Scheme<double>& scheme) {
  return largest_degree(
      scheme, [](const Eigen::VectorXd& values, const Eigen::VectorXd& own, const Points& places, int degree) {
        // Another polynomial with the same leading term: the difference is one of lower degree.
        Eigen::MatrixXd lower(places.rows(), degree * (degree + 1) / 2);
        for (int d = 0, column = 0; d < degree; ++d)
          for (int p = 0; p <= d; ++p) lower.col(column++) = monomial(places, p, d - p);
        Eigen::VectorXd rest = values - own;
        if (degree > 0) rest -= lower * lower.colPivHouseholderQr().solve(rest).eval();
        return rest.cwiseAbs().maxCoeff() <= exact;
      });
}

}  // namespace sublimit::testing
