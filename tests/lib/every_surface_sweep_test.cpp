// SPDX-License-Identifier: Apache-2.0
// OpenSubdiv's regression shapes, all their odd places included, as limit surfaces of every scheme: corners, edges and
// the inside of faces have a stencil with the right sums, or there is no limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "laws/limits_at_thirds.h"
#include "meshes/shared_meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

class EverySurface : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const Scheme<double>& scheme : all_schemes()) names.push_back(scheme.name);
  return names;
}

/// What is wrong with a stencil; empty if nothing is.
std::string wrong_with(const LimitStencil& s, int order) {
  const Eigen::Index rows = s.weights.rows();
  if (rows != 1 && rows != 3 && rows != 6) return std::to_string(rows) + " rows";
  if (rows > (order == 0 ? 1 : order == 1 ? 3 : 6)) return "more derivatives than asked for";
  if (s.weights.cols() != Eigen::Index(s.vertices.size())) return "columns are not one per vertex";
  if (!s.weights.allFinite() || !s.tangents.allFinite()) return "a weight is not finite";
  for (Eigen::Index k = 0; k < rows; ++k) {
    const double off = std::abs(s.weights.row(k).sum() - (k == 0 ? 1 : 0));
    const double allowed = rounding(double(s.vertices.size()), 1 + s.weights.row(k).cwiseAbs().sum());
    if (!(off <= allowed))
      return "row " + std::to_string(k) + " has a sum off by " + std::to_string(off / eps) + " eps";
  }
  if (s.tangents.rows() == 1 || (s.tangents.rows() >= 2 && s.status == LimitStatus::undefined_normal))
    return "tangents without a plane";
  return {};
}

/// Corners, middles of sides, and random places of some addresses, spread over the mesh.
std::vector<Place> places(const Addresses& addresses, Index most, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Place> result;
  const Index stride = std::max<Index>(1, addresses.size() / most);
  for (Index f = Index(random() % std::uint32_t(stride)); f < addresses.size(); f += stride) {
    const bool triangles = addresses.triangles();
    result.insert(result.end(), {{f, 0, 0}, {f, 1, 0}, {f, 0, 1}, {f, 0.5, 0}, {f, 0, 0.5}});
    result.push_back(triangles ? Place{f, 0.5, 0.5} : Place{f, 1, 1});
    const double u = unit(random), v = unit(random);
    result.push_back(triangles && u + v > 1 ? Place{f, 1 - u, 1 - v} : Place{f, u, v});
    result.push_back({f, 1e-9 * unit(random), 1e-9 * unit(random)});
  }
  return result;
}

TEST_P(EverySurface, HasStencilsOnTheSharedMeshes) {
  if (shared_meshes().empty())
    GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES << ": 122 meshes have no limit surfaces";
  const Scheme<double> scheme = *find_scheme(GetParam());
  const auto types = std::make_shared<LimitCache>(scheme, 4096);
  std::mt19937 random(1);
  std::set<std::string> without_limits;
  std::int64_t stencils = 0;
  for (const SharedMesh& shared : shared_meshes()) {
    Mesh mesh = read_mesh(shared.path);
    if (mesh.num_faces() >= 40 && !full_sweep()) continue;
    SCOPED_TRACE(scheme.name + " on " + shared.name);
    if (scheme.face_size() == 3) mesh = triangulated(mesh);
    std::unique_ptr<LimitMap> surface;
    try {
      surface = std::make_unique<LimitMap>(scheme, mesh, SubdivisionOptions{}, types);
      static_cast<void>(surface->stencil({0, 0.25, 0.25}));  // whether there is one
    } catch (const UnsupportedTopology&) {
      mesh = without_creases(mesh);
      surface = std::make_unique<LimitMap>(scheme, mesh, SubdivisionOptions{}, types);
    } catch (const AnalysisError&) {
    }
    const std::vector<Place> samples = places(surface->addresses(), full_sweep() ? 40 : 3, random);
    for (const Place& s : samples) {
      const int order = int(random() % 3);
      const std::string where = "square " + std::to_string(s.face) + " (" + std::to_string(s.u) + ", " +
                                std::to_string(s.v) + ") order " + std::to_string(order);
      try {
        const LimitStencil stencil = surface->stencil(s, order);
        EXPECT_EQ(wrong_with(stencil, order), "") << where;
        ++stencils;
        const LimitSamples found = surface->evaluate(mesh.positions, std::span(&s, 1), order);
        EXPECT_TRUE(found.position.allFinite() && found.normal.allFinite()) << where;
      } catch (const AnalysisError& error) {
        without_limits.insert(shared.name + ": " + error.what());
      } catch (const std::exception& error) {
        ADD_FAILURE() << where << ": " << error.what();
      }
    }
  }
  EXPECT_GE(stencils, 113 * 8);
  for (const std::string& one : without_limits) ADD_FAILURE() << one;
}

/// Triangles that are glued to themselves, have two sides at the same neighbour, several borders or non-manifold edges.
TEST(RotatingSurfaces, AreWhatRefinementMakesOnTheSharedMeshes) {
  if (shared_meshes().empty()) GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES;
  for (const char* name : {"sqrt3", "interpolatory-sqrt3"}) {
    const Scheme<double> scheme = *find_scheme(name);
    const auto types = std::make_shared<LimitCache>(scheme, 4096);
    for (const SharedMesh& shared : shared_meshes()) {
      const Mesh mesh = without_creases(triangulated(read_mesh(shared.path)));
      if (mesh.num_faces() >= (full_sweep() ? 200 : 30)) continue;
      EXPECT_EQ(wrong_at_thirds(LimitMap(scheme, mesh, {}, types), scheme), "") << name << " on " << shared.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sweep, EverySurface, ::testing::ValuesIn(scheme_names()), [](const auto& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace sublimit::testing
