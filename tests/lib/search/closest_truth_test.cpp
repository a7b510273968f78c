// SPDX-License-Identifier: Apache-2.0
// Closest points against the truth: a grid over every face, and Newton's method in 256-bit floats from wherever it may
// lead to the nearest point. Positions and derivatives are those of limit_truth.h, which refines in 256 bits down to a
// polynomial piece; the search's own boxes, bounds and evaluations have no part in it.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "laws/tested_schemes.h"
#include "sublimit/search/closest_point.h"
#include "support/tolerance.h"
#include "truth/limit_truth.h"

namespace sublimit::testing {
namespace {

using Vector = Eigen::Matrix<Precise, 3, 1>;

class TrueSurface {
 public:
  TrueSurface(const char* scheme, const Mesh& mesh)
      : scheme_(*find_scheme<Precise>(scheme)),
        level_(control_level(*find_scheme<double>(scheme), mesh)),
        points_(mesh.positions),
        addresses_(level_.topology(), scheme_.face_size() == 3),
        grids_(size_t(addresses_.size())) {
    for (Index f = 0; f < addresses_.size(); ++f)
      for (int i = 0; i <= a_side; ++i)
        for (int j = 0; j <= last(i); ++j)
          grids_[size_t(f)][size_t(i)][size_t(j)] = at({f, place(i), place(j)}).position.cast<double>();
  }

  TruePoint at(const Place& place) const { return true_limit(scheme_, level_, points_, place); }
  Precise distance(const Place& place, const Eigen::Vector3d& query) const {
    return Vector(at(place).position - query.cast<Precise>()).norm();
  }

  /// Of the whole surface, by descents around every place of the grids that is nearer than those beside it, but for
  /// those that are farther than the best one by more than the grid's own steps.
  Precise nearest(const Eigen::Vector3d& query) const {
    struct Start {
      double distance, step;
      Place place;
    };
    std::vector<Start> starts;
    for (Index f = 0; f < addresses_.size(); ++f)
      for (int i = 0; i <= a_side; ++i)
        for (int j = 0; j <= last(i); ++j) {
          const Eigen::Vector3d& x = grid(f, i, j);
          Start start{(x - query).norm(), 0, {f, place(i), place(j)}};
          bool is_lowest = true;
          for (int k = std::max(0, i - 1); k <= std::min(i + 1, a_side); ++k)
            for (int l = std::max(0, j - 1); l <= std::min(j + 1, last(k)); ++l) {
              is_lowest &= (grid(f, k, l) - query).norm() >= start.distance;
              start.step = std::max(start.step, (grid(f, k, l) - x).norm());
            }
          if (is_lowest) starts.push_back(start);
        }
    double best = starts.front().distance;
    for (const Start& start : starts) best = std::min(best, start.distance);
    Precise least = best;
    for (const Start& start : starts)
      if (start.distance <= best + start.step)
        for (const Place& place : around(start.place)) least = std::min(least, descended(place, query));
    return least;
  }

  /// Some of the grids' points.
  Eigen::Vector3d some(std::mt19937& random) const {
    const int i = int(random() % (a_side + 1));
    return grid(Index(random() % size_t(addresses_.size())), i, int(random() % size_t(last(i) + 1)));
  }

 private:
  static constexpr int a_side = 8;
  int last(int i) const { return addresses_.triangles() ? a_side - i : a_side; }
  static double place(int i) { return double(i) / a_side; }
  const Eigen::Vector3d& grid(Index f, int i, int j) const { return grids_[size_t(f)][size_t(i)][size_t(j)]; }

  /// A place and, as there may be no derivatives at vertices, those half a step from it.
  std::vector<Place> around(const Place& s) const {
    std::vector<Place> places{s};
    for (const double u : {-0.5, 0.5})
      for (const double v : {-0.5, 0.5}) {
        const Place beside = on_face({s.face, s.u + u / a_side, s.v + v / a_side});
        if (beside.u != s.u || beside.v != s.v) places.push_back(beside);
      }
    return places;
  }

  /// Back to the face along u and v, of triangles on u + v = 1 by halves.
  Place on_face(Place s) const {
    s.u = std::clamp(s.u, 0.0, 1.0);
    s.v = std::clamp(s.v, 0.0, 1.0);
    if (const double over = s.u + s.v - 1; addresses_.triangles() && over > 0) {
      s.u = std::clamp(s.u - over / 2, 0.0, 1.0);
      s.v = 1 - s.u;
    }
    return s;
  }

  /// Step that leads to the least distance, along the sides that hold it there.
  Eigen::Vector2d step(const TruePoint& x, const Vector& r, const Place& s) const {
    Eigen::Matrix<double, 2, 1> g(double(Precise(r.dot(x.du))), double(Precise(r.dot(x.dv))));
    Eigen::Matrix2d G, H;
    G << double(Precise(x.du.dot(x.du))), double(Precise(x.du.dot(x.dv))), 0, double(Precise(x.dv.dot(x.dv)));
    G(1, 0) = G(0, 1);
    H = G;
    if (x.has_second) {
      const double mixed = double(Precise(r.dot(x.duv)));
      H(0, 0) += double(Precise(r.dot(x.duu)));
      H(1, 1) += double(Precise(r.dot(x.dvv)));
      H(0, 1) += mixed;
      H(1, 0) += mixed;
      if (H.determinant() <= 0 || H(0, 0) <= 0) H = G;
    }
    if (addresses_.triangles() && s.u + s.v == 1 && g[0] + g[1] < 0) {  // along the third side
      const Eigen::Vector2d along(1, -1);
      return -along.dot(g) / along.dot(H * along) * along;
    }
    const bool no_u = (s.u == 0 && g[0] > 0) || (s.u == 1 && g[0] < 0),
               no_v = (s.v == 0 && g[1] > 0) || (s.v == 1 && g[1] < 0);
    if (no_u && no_v) return Eigen::Vector2d::Zero();
    if (no_u) return {0, -g[1] / H(1, 1)};
    if (no_v) return {-g[0] / H(0, 0), 0};
    return -H.inverse() * g;
  }

  /// Places are doubles: the distance, which does not change there, is right to the square of their rounding.
  Precise descended(Place s, const Eigen::Vector3d& query) const {
    TruePoint x = at(s);
    Precise least = Vector(x.position - query.cast<Precise>()).norm();
    for (int k = 0; k < 40; ++k) {
      if (!x.has_first) return least;  // an extraordinary vertex
      const Eigen::Vector2d d = step(x, x.position - query.cast<Precise>(), s);
      bool is_nearer = false;
      for (double part = 1; part > 1e-9 && !is_nearer; part /= 4) {
        const Place next = on_face({s.face, s.u + part * d[0], s.v + part * d[1]});
        if (next.u == s.u && next.v == s.v) break;
        const TruePoint there = at(next);
        const Precise distance = Vector(there.position - query.cast<Precise>()).norm();
        is_nearer = distance < least;
        if (!is_nearer) continue;
        least = distance;
        x = there;
        s = next;
      }
      if (!is_nearer || d.norm() < 1e-15) return least;
    }
    return least;
  }

  Scheme<Precise> scheme_;
  Level level_;
  Points points_;
  Addresses addresses_;
  std::vector<std::array<std::array<Eigen::Vector3d, a_side + 1>, a_side + 1>> grids_;
};

void expect_truth(const char* scheme, const Mesh& mesh, std::vector<Eigen::Vector3d> queries) {
  const TrueSurface truth(scheme, mesh);
  const double size = diagonal(mesh.positions);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const double amount : {0.0, 0.01, 0.1, 0.3, 1.0, 100.0})
    queries.push_back(truth.some(random) +
                      size * amount * Eigen::Vector3d(normal(random), normal(random), normal(random)));
  Points q(Index(queries.size()), 3);
  for (size_t i = 0; i < queries.size(); ++i) q.row(Index(i)) = queries[i];
  const LimitMap surface(*find_scheme<double>(scheme), mesh);
  const ClosestPoints found = closest(surface, mesh.positions, q);
  for (Index i = 0; i < q.rows(); ++i) {
    SCOPED_TRACE(std::string(scheme) + ", query " + std::to_string(i));
    const Eigen::Vector3d query = q.row(i);
    const Precise nearest = truth.nearest(query), there = truth.distance(found.places[size_t(i)], query);
    const double rounding_of_query = rounding(1, query.norm());
    EXPECT_LE(std::abs(double(Precise(found.distances[i] - nearest))), found_distance * size + rounding_of_query);
    EXPECT_LE(std::abs(double(Precise(there - nearest))), found_distance * size + rounding_of_query);
    EXPECT_LE(double(Precise(found.lower[i] - nearest)), 0);
  }
}

/// Of surfaces with these planes of symmetry: on them, on their lines, and in the middle.
std::vector<Eigen::Vector3d> on_medial_axis() {
  return {{0, 0, 0}, {0, 0.1, 0.25}, {0.2, 0.2, 0.05}, {0.3, 0.3, 0.3}, {0, 0, 3}, {0, 4, 4}};
}

TEST(ClosestPoints, AreThoseOfTheTruthAtCreases) {
  Mesh mesh = cube();
  add_crease(mesh, {0, 1, 3, 2, 0}, 10);
  add_crease(mesh, {4, 5, 7}, 1.5);
  mesh.corners.push_back({0, 10});
  expect_truth("catmull-clark", mesh, on_medial_axis());
}

TEST(ClosestPoints, AreThoseOfTheTruthAroundExtraordinaryVertices) {
  expect_truth("catmull-clark", cube(), on_medial_axis());
  expect_truth("catmull-clark", jittered(prism(5), 0.1), {{0, 0, 0}, {0, 0, 0.2}});
  expect_truth("loop", octahedron(), on_medial_axis());
}

TEST(ClosestPoints, AreThoseOfTheTruthAtBorders) {
  expect_truth("catmull-clark", jittered(grid(3, 2), 0.1), {{1.5, 1, 0}, {-1, -1, 0}, {1, 5, 0}});
  expect_truth("loop", jittered(fan(5, 3, 2), 0.1), {{0, 0, 1}, {3, 0, 0}});
}

TEST(ClosestPoints, AreThoseOfTheTruthAtNonManifoldEdges) {
  Mesh other = cube();
  other.positions.col(0).array() += 2;
  other.positions.col(1).array() += 2;
  expect_truth("catmull-clark", glued(cube(), other, {3, 7}, {0, 4}), {{1, 1, 0}, {0, 0, 0}, {1, 1, 3}, {2, 0, 0}});
}

}  // namespace
}  // namespace sublimit::testing
