// SPDX-License-Identifier: Apache-2.0
// Vertices of many faces: the blocks of one sector give what dense matrices give, and their size does not grow.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "laws/local_types.h"
#include "meshes/meshes.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/core/detail/submatrix.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/limit/detail/sparse_spectrum.h"
#include "sublimit/limit/detail/tangents.h"
#include "sublimit/neighborhood/closed_set.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/allocations.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

/// Weights and tangents of some thousand places by two routes, or after one more step; condition numbers of
/// eigenvectors are below a hundred.
constexpr double by_two_routes = 1e-12;
/// Eigenvectors of sectors of many faces: their eigenvalues lie as near as 1e-5 to each other.
constexpr double near_neighbours = 1e-9;

/// A closed centre of every scheme, with its matrix.
SparsePatch<double> closed_patch(const Scheme<double>& scheme, int n, int more_rings = 0) {
  const LocalType type = smooth_type(scheme, n);
  const int rings = (type.kind == Centre::Kind::face ? 0 : 1) + more_rings;
  return sparse_patches(scheme, type, {.rings = {rings}, .labels = false}).value().front();
}

/// How far the rows are from a space that the matrix takes into itself, relative to their size: rows * A = B * rows.
double defect(const SparseMatrix& A, const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd columns = rows.transpose(), images = A.transpose() * columns;
  const Eigen::MatrixXd rest = images - columns * PivotedQr(columns).solve(images);
  return rest.colwise().norm().maxCoeff() / columns.colwise().norm().minCoeff();
}

Eigen::MatrixXd tangents(const LimitMasks& masks) {
  Eigen::MatrixXd rows(2, masks.position.size());
  rows << masks.sides[0].tangent1.transpose(), masks.sides[0].tangent2.transpose();
  return rows;
}

TEST(Poles, MasksBySectorsAreThoseOfDenseMatrices) {
  for (const Scheme<double>& scheme : all_schemes())
    for (int n = 3; n <= 40; n += n < 12 ? 1 : 7) {
      const SparsePatch<double> patch = closed_patch(scheme, n);
      const auto limit = isolated_limit(scheme, smooth_type(scheme, n));
      ASSERT_TRUE(limit.has_value()) << scheme.name << n;
      Slots centre(static_cast<size_t>(patch.places.ring_end[0]));
      for (size_t i = 0; i < centre.size(); ++i) centre[i] = static_cast<Index>(i);
      const Slots used = closed_set(patch.A, centre);
      const Eigen::MatrixXd dense = submatrix(patch.A, used, used);
      const Eigen::VectorXd position = embedded(limit_weights(dense), used, static_cast<Index>(patch.A.rows()));
      EXPECT_LE((position - limit->masks.position).cwiseAbs().maxCoeff(), by_two_routes) << scheme.name << n;
      EXPECT_LE(defect(patch.A, tangents(limit->masks)), by_two_routes) << scheme.name << n;
    }
}

TEST(Poles, HighValencesAreEigenvectorsToo) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const int n : {150, 300}) {
      const SparsePatch<double> patch = closed_patch(scheme, n);
      const auto limit = isolated_limit(scheme, smooth_type(scheme, n));
      ASSERT_TRUE(limit.has_value()) << scheme.name << n;
      const Eigen::VectorXd& l = limit->masks.position;
      EXPECT_NEAR(l.sum(), 1, by_two_routes) << scheme.name << n;
      EXPECT_LE((patch.A.transpose() * l - l).norm(), by_two_routes) << scheme.name << n;
      EXPECT_LE(defect(patch.A, tangents(limit->masks)), by_two_routes) << scheme.name << n;
    }
}

TEST(Poles, WorkPerFaceDoesNotGrowWithTheValence) {
  for (const Scheme<double>& scheme : all_schemes()) {
    const SparsePatch<double> small = closed_patch(scheme, 30, 1), large = closed_patch(scheme, 120, 1);
    const auto few = sector_rows(small.A, small.orbits), many = sector_rows(large.A, large.orbits);
    ASSERT_TRUE(few && many) << scheme.name;
    EXPECT_EQ(few->orbits.size(), many->orbits.size()) << scheme.name << ": the largest dense matrix";
    // Around polygons every corner sees all others, and around some points one edge sees all others.
    const auto longest = [](const SectorRows& sector) {
      size_t most = 0;
      for (int i = sector.fixed; i < static_cast<int>(sector.rows.size()); ++i)
        most = std::max(most, sector.rows[static_cast<size_t>(i)].size());
      return most;
    };
    if (longest(*many) > longest(*few)) continue;
    EXPECT_LE(large.A.nonZeros(), 4 * small.A.nonZeros()) << scheme.name;
  }
}

TEST(Poles, RingsThatAreCutAwayWouldChangeNoRow) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const int n : {3, 7}) {
      const SparsePatch<double> near = closed_patch(scheme, n), far = closed_patch(scheme, n, 2);
      for (size_t i = 0; i < near.slots.size(); ++i) {
        const auto at = std::lower_bound(far.slots.begin(), far.slots.end(), near.slots[i]) - far.slots.begin();
        for (size_t j = 0; j < near.slots.size(); ++j) {
          const auto to = std::lower_bound(far.slots.begin(), far.slots.end(), near.slots[j]) - far.slots.begin();
          ASSERT_NEAR(near.A.coeff(static_cast<Index>(i), static_cast<Index>(j)),
                      far.A.coeff(static_cast<Index>(at), static_cast<Index>(to)), rounding(16))
              << scheme.name << n;
        }
      }
    }
}

/// The mid-edge schemes average polygons, whose differences shrink by as little as cos(pi/n) in a step.
TEST(Poles, AreSampledWhereTheirLimitsAre) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const int n : {27, 60, 100}) {
      if (n > 60 && scheme.name == "kobbelt") continue;  // a second for each type
      Mesh mesh = fan(n, scheme.face_size() == 3 ? 3 : 4, 2);
      mesh.positions(0, 2) = 1;
      const LimitMap surface(scheme, mesh);
      const Topology& t = surface.level().topology();
      const auto corners = t.vertices(Face{0});
      const auto corner = std::find(corners.begin(), corners.end(), 0) - corners.begin();
      const Place pole = scheme.face_size() == 3 ? Place{0, double(corner == 1), double(corner == 2)}
                                                 : Place{0, double(corner == 1 || corner == 2), double(corner > 1)};
      const LimitSamples found = surface.evaluate(mesh.positions, std::vector<Place>{pole}, 0);
      EXPECT_LE(found.position.row(0).head(2).norm(), by_two_routes) << scheme.name << n << ": off the axis";
      if (scheme.is_dual()) continue;  // a vertex is a face one level on
      LimitCache types(scheme);
      const Level level = control_level(scheme, mesh);
      const LimitPoints limits = limit_points(limit_matrices(level, types), level.topology(), mesh.positions);
      EXPECT_LE((found.position.row(0) - limits.position.row(0)).norm(), by_two_routes) << scheme.name << n;
    }
}

/// Bytes of glibc's heap in use.
double bytes_in_use() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  const struct mallinfo2 heap = mallinfo2();
  return double(heap.uordblks) + double(heap.hblkhd);
#else
  return 0;
#endif
}

TEST(Poles, TakeNoMoreMemoryThanTheyAreAllowed) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the heap is not glibc's";
  constexpr double allowed = 50e6;
  struct Unlimited {
    ~Unlimited() { limit_memory(std::numeric_limits<double>::infinity()); }
  } at_the_end;
  const Scheme<double> scheme =
      find_scheme("interpolatory-sqrt3").value();  // rows have as many weights as the pole edges
  const Mesh mesh = fan(300, 3, 3);
  const auto types = std::make_shared<LimitCache>(scheme);
  const LimitMap surface(scheme, mesh, {}, types);
  const double before = bytes_in_use();
  ASSERT_GT(before, 0) << "nothing would be measured";
  limit_memory(allowed);
  std::vector<Place> places;
  for (int i = 0; i < 40; ++i) places.push_back({i, 0.013 * i, 0.3});
  EXPECT_THROW(surface.evaluate(mesh.positions, places, 1), ResourceError);
  const double taken = bytes_in_use() - before;
  EXPECT_LE(taken, 1.5 * allowed);
  EXPECT_GE(taken, 0.1 * allowed) << "refused far too early";
}

TEST(Poles, OneMoreStepChangesNoLimit) {
  for (const Scheme<double>& scheme : all_schemes()) {
    if (scheme.is_dual()) continue;  // a vertex is a face one level on
    const Mesh mesh = jittered(fan(60, scheme.face_size() == 3 ? 3 : 4, 2));
    LimitCache cache(scheme);
    const std::vector<Level> levels = refine(scheme, mesh, 1);
    Vertex pole{0};
    for (const Refinement& step : levels[1].steps) pole = step.child(pole);
    const LimitMatrices here = limit_matrices(levels[0], cache), there = limit_matrices(levels[1], cache);
    const Points from_here = apply(here.position, mesh.positions);
    const Points from_there = apply(there.position, apply(levels[1].S, mesh.positions));
    EXPECT_LE((from_here.row(0) - from_there.row(index(pole))).norm(), reference * diagonal(mesh.positions))
        << scheme.name;
  }
}

/// One side of a border vertex of many faces.
TEST(Poles, SectorsOfManyFacesHaveTheirLimit) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const int n : {20, 60})
      for (const bool corner : {false, true}) {
        const LocalType type{.faces = n, .open = true, .corner = corner};
        const auto patches = sparse_patches(scheme, type, {.rings = {1}, .labels = false});
        if (!patches) continue;
        const SparseMatrix& A = patches->front().A;
        const IsolatedLimit limit = isolated_limit(scheme, type).value();
        const Eigen::VectorXd& l = limit.masks.position;
        EXPECT_NEAR(l.sum(), 1, by_two_routes) << scheme.name << n;
        EXPECT_LE((A.transpose() * l - l).norm(), by_two_routes) << scheme.name << n;
        const LimitMasks::Side& side = limit.masks.sides[0];
        if (side.plane == LimitMasks::Plane::no || corner) continue;
        EXPECT_LE(defect(A, side.tangent1.transpose()), near_neighbours) << scheme.name << n;
        EXPECT_LE(defect(A, tangents(limit.masks)), near_neighbours) << scheme.name << n;
      }
}

/// The matrix of a chain of points with both ends held: eigenvalues 1/2 + 1/4 cos(k pi/(n + 1)).
SparseMatrix chain(Index n) {
  SparseMatrix A(n, n);
  for (Index i = 0; i < n; ++i) {
    A.startVec(i);
    if (i > 0) A.insertBack(i, i - 1) = 0.125;
    A.insertBack(i, i) = 0.5;
    if (i + 1 < n) A.insertBack(i, i + 1) = 0.125;
  }
  A.finalize();
  return A;
}

TEST(SparseSpectrum, CloseEigenvaluesAreToldApart) {
  for (const Index n : {100, 300, 1500}) {
    const EigenStructure structure = leading_clusters(chain(n), 3);
    ASSERT_EQ(structure.clusters.size(), 3u);
    for (int k = 1; k <= 3; ++k) {
      const EigenCluster& cluster = structure.clusters[size_t(k) - 1];
      EXPECT_EQ(cluster.multiplicity, 1) << n;
      EXPECT_NEAR(cluster.value.real(), 0.5 + 0.25 * std::cos(k * pi / (n + 1)), eigen(10)) << n;
      Eigen::VectorXd sine(n);
      for (Index i = 0; i < n; ++i) sine[i] = std::sin(k * pi * (i + 1) / (n + 1));
      Eigen::VectorXd left = made_real(cluster.left.col(0)).normalized();
      if (left.dot(sine) < 0) left *= -1;
      EXPECT_LE((left - sine.normalized()).norm(), near_neighbours) << n;
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
