// SPDX-License-Identifier: Apache-2.0
// OpenSubdiv's regression shapes, all their odd places included, through every scheme: whatever a scheme takes becomes
// a mesh with finite points, three levels deep, and has limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes/broken_topology.h"
#include "meshes/shared_meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Largest difference of a row's sum from `sum`, relative to the sum of its weights' sizes and, where a row has more
/// than `terms` of them, to their number; infinite if not finite.
double worst_sum(const SparseMatrix& M, double sum, double terms) {
  double worst = 0;
  for (Index r = 0; r < M.rows(); ++r) {
    double total = 0, size = 1, count = 0;
    for (SparseMatrix::InnerIterator it(M, r); it; ++it) {
      total += it.value();
      size += std::abs(it.value());
      ++count;
    }
    if (!std::isfinite(total)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(total - sum) / (size * std::max(1.0, count / terms)));
  }
  return worst;
}

/// What is wrong with refined levels; empty if nothing is.
std::string wrong_with(const Scheme<double>& scheme, const std::vector<Level>& levels, const Points& control) {
  const Topology& t0 = levels[0].topology();
  Points x = control;
  for (size_t k = 1; k < levels.size(); ++k) {
    const Level& level = levels[k];
    const std::string at = "level " + std::to_string(k) + ": ";
    for (const Refinement& step : level.steps) {
      if (const std::string what = broken(step.topology); !what.empty()) return at + what;
      if (t0.is_manifold() && !step.topology.is_manifold()) return at + "a manifold became none";
      if (t0.is_manifold() && euler_characteristic(step.topology) != euler_characteristic(t0))
        return at + "Euler characteristic " + std::to_string(euler_characteristic(step.topology)) + " instead of " +
               std::to_string(euler_characteristic(t0));
      if (t0.is_manifold() && num_borders(t0) == 0 && num_borders(step.topology) != 0) return at + "it opened";
    }
    if (level.S.rows() != level.topology().num_vertices()) return at + "S has the wrong number of rows";
    if (std::ssize(level.holes) != level.topology().num_faces()) return at + "holes are not one per face";
    const double terms = 16.0 * double(level.steps.size()), sum = worst_sum(level.S, 1, terms),
                 allowed = rounding(terms);
    if (!(sum <= allowed)) return at + "a row sum is off by " + std::to_string(sum / eps) + " eps";
    if (scheme.claims.convex_hull)
      for (Index i = 0; i < level.S.nonZeros(); ++i)
        if (level.S.valuePtr()[i] < 0) return at + "a negative weight";
    x = apply(level.S, x);
    if (!x.allFinite()) return at + "a point is not finite";
  }
  return {};
}

std::string wrong_with(const LimitMatrices& limit, const Level& level) {
  if (limit.position.rows() != level.topology().num_vertices()) return "limits: wrong number of rows";
  for (const auto& [M, sum] : {std::pair{&limit.position, 1.0}, {&limit.tangent1, 0.0}, {&limit.tangent2, 0.0}}) {
    const double error = worst_sum(*M, sum, 2500);
    if (!(error <= eigen(100))) return "limits: a row sum is off by " + std::to_string(error / eps) + " eps";
  }
  for (const Index side : limit.corner_side)
    if (side < 0 || side >= std::ssize(limit.side_vertex)) return "limits: a corner without a side";
  return {};
}

class EveryScheme : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const Scheme<double>& scheme : all_schemes()) names.push_back(scheme.name);
  return names;
}

TEST_P(EveryScheme, TakesTheSharedMeshes) {
  if (shared_meshes().empty())
    GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES << ": 122 meshes are not refined";
  const Scheme<double> scheme = *find_scheme(GetParam());
  LimitCache cache(scheme);
  int meshes = 0;
  for (const SharedMesh& shared : shared_meshes()) {
    Mesh mesh = read_mesh(shared.path);
    if (mesh.num_faces() >= 400 && !full_sweep()) continue;
    SCOPED_TRACE(scheme.name + " on " + shared.name);
    ++meshes;
    if (scheme.face_size() == 3) mesh = triangulated(mesh);
    std::vector<Level> levels;
    try {
      levels = refine(scheme, mesh, 3);
    } catch (const UnsupportedTopology& refused) {
      EXPECT_NE(std::string(refused.what()).find("remove the tag"), std::string::npos) << refused.what();
      mesh = without_creases(mesh);
      ASSERT_NO_THROW(levels = refine(scheme, mesh, 3));
    }
    const std::string wrong = wrong_with(scheme, levels, mesh.positions);
    EXPECT_EQ(wrong, "");
    if (!wrong.empty()) continue;
    try {
      const LimitMatrices limit = limit_matrices(levels[1], cache);
      EXPECT_EQ(wrong_with(limit, levels[1]), "");
      const LimitPoints points = limit_points(limit, levels[1].topology(), apply(levels[1].S, mesh.positions));
      EXPECT_TRUE(points.position.allFinite() && points.normal.allFinite());
    } catch (const AnalysisError& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_EQ(meshes, full_sweep() ? 122 : 113);  // 113 have less than 400 faces
}

INSTANTIATE_TEST_SUITE_P(Sweep, EveryScheme, ::testing::ValuesIn(scheme_names()), [](const auto& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace sublimit::testing
