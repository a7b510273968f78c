// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/detail/level_set_fit.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/fit/detail/for_coordinates.h"
#include "sublimit/fit/detail/sparse_factors.h"
#include "sublimit/fit/detail/tangent_rows.h"
#include "sublimit/fit/fairness.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/source/curvature.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

constexpr int places_a_side = 3;
/// What the part of a distance along the surface counts, falling from round to round.
constexpr double first_tangential = .1, last_tangential = 1e-3;
/// Thin plate energy keeps control points apart while the surface is far, and is next to nothing at the end. Relative
/// to mean squares of distances.
constexpr double first_fairness = .003, fairness_ratio = .25;
/// Of the largest entry of the diagonal.
constexpr double damped = 1e-7;
/// Grids of so many places a side of each face tell rounds apart.
constexpr int checked = 4;
/// Places on sharp edges count as much as so many inside.
constexpr double crease_weight = 4;
/// Once the limit is near, places that are further off than others count more, round after round: squares are brought
/// down to have a small largest distance. Source: Lawson 1961, "Contributions to the theory of linear least maximum
/// approximation".
constexpr int first_emphasized = 3;
constexpr double most_emphasis = 1e3;

/// Places of the fit, and the sides that they are to lie on.
struct FitPlaces {
  std::vector<Place> places;
  std::vector<std::vector<size_t>> sides;
};

FitPlaces fit_places_of(const LimitMap& surface, const Cage& cage) {
  FitPlaces all;
  const Addresses& addresses = surface.addresses();
  const Topology& topology = surface.level().topology();
  const int k = places_a_side;
  const auto add = [&](Index address, double u, double v, std::vector<size_t> sides) {
    all.places.push_back({address, u, v});
    all.sides.push_back(std::move(sides));
  };
  for (Index a = 0; a < addresses.size(); ++a) {
    const Addresses::FaceCorner place = addresses.place(a);
    const size_t side = cage.side[size_t(index(place.face))];
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < k; ++j) {
        if (!addresses.triangles()) {
          add(a, (i + .5) / k, (j + .5) / k, {side});
          continue;
        }
        if (i + j < k) add(a, (i + 1. / 3) / k, (j + 1. / 3) / k, {side});
        if (i + j < k - 1) add(a, (i + 2. / 3) / k, (j + 2. / 3) / k, {side});
      }
  }
  // Limits are furthest off at extraordinary vertices, so vertices are places, too.
  for (Index v = 0; v < topology.num_vertices(); ++v) {
    const HalfEdge first = topology.outgoing(Vertex{v});
    const size_t side = cage.side[size_t(index(topology.face(first)))];
    bool inside = true;
    HalfEdge h = first;
    do {
      inside = inside && cage.side[size_t(index(topology.face(h)))] == side;
      h = topology.ccw(h);
    } while (h != first);
    if (!inside) continue;  // those of seams come with their edges
    const Face face = topology.face(first);
    const Index corner = topology.corner_index(first);
    const Eigen::Vector2d quad[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[] = {{0, 0}, {1, 0}, {0, 1}};
    if (topology.size(face) != (addresses.triangles() ? 3 : 4))
      add(addresses.first(face) + corner, 0, 0, {side});
    else if (addresses.triangles())
      add(addresses.first(face), triangle[corner].x(), triangle[corner].y(), {side});
    else
      add(addresses.first(face), quad[corner].x(), quad[corner].y(), {side});
  }
  if (cage.mesh.creases.empty()) return all;
  for (Index e = 0; e < topology.num_edges(); ++e) {
    if (!is_infinite(surface.level().sharpness.edge[e])) continue;
    const HalfEdge h = topology.half_edge(Edge{e});
    const Face face = topology.face(h);
    const Index corner = topology.corner_index(h), size = topology.size(face);
    const std::vector<size_t> both{cage.side[size_t(index(face))],
                                   cage.side[size_t(index(topology.face(topology.twin(h))))]};
    if (both[0] == both[1]) continue;
    const bool cut = size != (addresses.triangles() ? 3 : 4);  // into a square for each corner
    for (int i = 0; i <= k; ++i) {
      const double t = double(i) / k;
      if (cut) {
        if (t < .5)
          add(addresses.first(face) + corner, 2 * t, 0, both);
        else
          add(addresses.first(face) + (corner + 1) % size, 0, 2 - 2 * t, both);
        continue;
      }
      const Eigen::Vector2d quad[] = {{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}},
                            triangle[] = {{t, 0}, {1 - t, t}, {0, 1 - t}};
      const Eigen::Vector2d uv = size == 3 ? triangle[corner] : quad[corner];
      add(addresses.first(face), uv.x(), uv.y(), both);
    }
  }
  return all;
}

/// Thin plate energy, or nothing where a scheme has no second derivatives.
SparseMatrix fairness_of(const LimitMap& surface) {
  try {
    return for_coordinates(fairness_energy(surface, {.thin_plate = 1}));
  } catch (const InvalidParameter&) {
    return {};
  }
}

/// Places count more that are further off than the mean.
void emphasize(const Eigen::VectorXd& distances, Eigen::VectorXd& emphasis) {
  const double mean = distances.mean();
  if (!(mean > 0)) return;
  for (Eigen::Index i = 0; i < distances.size(); ++i)
    emphasis[i] = std::clamp(emphasis[i] * std::sqrt(.1 + distances[i] / mean), 1 / most_emphasis, most_emphasis);
  emphasis /= emphasis.mean();
}

/// Towards the least of the sum, from x: targets move in the next round, so one solution of a system that is a little
/// damped does. What no place sees stays.
Points step(const FitProblem& problem, const Points& x) {
  const SparseMatrix At = problem.A.transpose();
  SparseMatrix M = At * problem.weights.asDiagonal() * problem.A;
  Points force = At * problem.weights.cwiseProduct((problem.b - problem.A * x).col(0));
  if (problem.H.rows() > 0) {
    M += problem.H;
    force -= problem.H * x;
  }
  double largest = 0;
  for (Index i = 0; i < M.rows(); ++i) largest = std::max(largest, M.coeff(i, i));
  SparseMatrix damping(M.rows(), M.cols());
  damping.setIdentity();
  M += damped * largest * damping;
  const Points move = SparseFactors(M).solve(force);
  return Eigen::Map<const Points>(move.data(), move.rows() / 3, 3);
}

}  // namespace

bool is_nearer(const LevelSetError& a, const LevelSetError& b) {
  return a.is_folded() == b.is_folded() ? a.largest < b.largest : b.is_folded();
}

LevelSetFit fit_level_set(const LimitMap& surface, const Cage& cage, const FieldSides& sides, int rounds,
                          const std::function<void(int)>& progress) {
  surface.prepare();
  const FitPlaces places = fit_places_of(surface, cage);
  const auto count = Index(places.places.size());
  const SparseMatrix A = place_rows(surface, places.places), H = fairness_of(surface);
  const double faces = double(cage.mesh.num_faces());
  LevelSetFit best{.points = cage.mesh.positions,
                   .error = level_set_error(surface, cage.mesh.positions, cage, sides, checked, false),
                   .rounds = {}};
  best.rounds.push_back(best.error.largest);
  Points x = best.points;
  Eigen::VectorXd emphasis = Eigen::VectorXd::Ones(count), distances(count);
  for (int round = 0; round < rounds; ++round) {
    if (progress) progress(round);
    const Points at = A * x;
    Points targets(count, 3), normals = Points::Zero(count, 3);
    Eigen::VectorXd weights = Eigen::VectorXd::Constant(count, 1. / count);
    parallel_for(count, [&](std::int64_t i) {
      const Vector3d here = at.row(i);
      const std::vector<size_t>& own = places.sides[size_t(i)];
      const Projection p = sides.project(own, here, 3 * cage.cell);
      targets.row(i) = p.converged ? p.point : here;
      if (!p.converged) weights[i] = 0;
      distances[i] = (targets.row(i) - at.row(i)).norm();
      if (own.size() == 1 && p.jet.gradient.norm() > 0) normals.row(i) = p.jet.gradient.normalized();
      if (own.size() > 1) weights[i] *= crease_weight;
    });
    if (round >= first_emphasized) emphasize(distances, emphasis);
    weights = weights.cwiseProduct(emphasis);
    FitProblem problem;
    // Along creases distances are from points: they tie places to the curve, and along it.
    add_tangent_rows(problem, A, targets, normals, weights,
                     std::max(last_tangential, first_tangential * std::pow(.25, round)));
    if (H.rows() > 0) problem.H = first_fairness * std::pow(fairness_ratio, round) / faces * H;
    x += step(problem, Eigen::Map<const Points>(x.data(), x.size(), 1));
    if (!x.allFinite()) break;
    const LevelSetError error = level_set_error(surface, x, cage, sides, checked, false);
    best.rounds.push_back(error.largest);
    if (is_nearer(error, best.error)) {
      best.points = x;
      best.error = error;
    }
  }
  best.error = level_set_error(surface, best.points, cage, sides);
  return best;
}

LevelSetError level_set_error(const LimitMap& surface, const Points& points, const Cage& cage, const FieldSides& sides,
                              int N, bool curved) {
  const Field& field = sides.field();
  const std::vector<Place> grid = surface.grid(N);
  const LimitSamples found = surface.evaluate(points, grid, curved ? 2 : 1);
  struct One {
    double distance = 0, angle = -1, gauss = -1, mean = 0;
  };
  std::vector<One> all(grid.size());
  parallel_for(std::int64_t(grid.size()), [&](std::int64_t i) {
    One& one = all[size_t(i)];
    const Vector3d x = found.position.row(i), normal = found.normal.row(i);
    const FieldJet jet = field.jet(x);
    const double length = jet.gradient.norm();
    one.distance = length > 0 ? std::abs(jet.value) / length : std::abs(jet.value);
    const size_t side = cage.side[size_t(index(surface.addresses().place(grid[size_t(i)].face).face))];
    const Vector3d gradient = sides.has_edges() ? sides.jet(side, x).gradient : jet.gradient;
    if (!normal.isZero(0) && gradient.norm() > 0 && (sides.has_edges() || level_normal(jet)))
      one.angle = std::atan2(normal.cross(gradient).norm(), normal.dot(gradient));
    if (!curved) return;
    const std::optional<LevelCurvature> level = level_curvature(jet);
    const std::optional<Curvature> own = curvature(found, Index(i));
    if (!level || !own) return;
    one.gauss = std::abs(own->gauss - level->gauss);
    one.mean = std::abs(own->mean - level->mean);
  });
  LevelSetError error;
  error.samples = Index(grid.size());
  Index angles = 0;
  size_t worst = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    const One& one = all[i];
    if (!(one.distance <= all[worst].distance)) worst = i;
    error.mean += one.distance;
    if (one.angle >= 0) {
      error.largest_angle = std::max(error.largest_angle, one.angle);
      error.mean_angle += one.angle;
      ++angles;
    }
    if (one.gauss >= 0) {
      error.gauss += one.gauss;
      error.mean_curvature += one.mean;
      ++error.curvatures;
    }
  }
  error.largest = all[worst].distance;
  error.worst = found.position.row(Eigen::Index(worst));
  error.mean /= double(std::max<Index>(1, error.samples));
  error.mean_angle /= double(std::max<Index>(1, angles));
  error.gauss /= double(std::max<Index>(1, error.curvatures));
  error.mean_curvature /= double(std::max<Index>(1, error.curvatures));
  return error;
}

}  // namespace sublimit
