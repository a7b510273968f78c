// SPDX-License-Identifier: Apache-2.0
#pragma once
// Laws of rays through points of the limit (corners, middles of sides and of faces), along the normal and
// against it, also displaced by the errors of numbers from other programs. They hit the surface there, and
// closed surfaces an even number of times.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "laws/full_sweep.h"
#include "sublimit/base/error.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/parts/closed_surface.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/intersect.h"
#include "support/tolerance.h"

namespace sublimit::testing {

/// Displacements relative to the size of the surface, from rounding to the errors of programs in float.
inline constexpr double ray_offsets[]{0, 1e-16, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3};
/// Largest displacement, relative to the size, for which a hit at the t of the point is expected.
inline constexpr double as_good_as_through = 1e-14;

/// Rays through points, all at the same t.
struct LaidRays {
  std::vector<Ray> rays;
  std::vector<Eigen::Vector3d> through;
  std::vector<double> beside;  ///< displacement of each ray, relative to the size of the surface
  double t = 0;
};

/// Returns corners, middles of sides and of faces, each point once.
inline std::vector<Place> marked_places(const LimitMap& surface, const Points& points) {
  std::vector<Place> all;
  for (Index f = 0; f < surface.faces().size; ++f)
    for (const auto& [u, v] : std::vector<std::pair<double, double>>{
             {0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}, {1, 1}, {1. / 3, 1. / 3}})
      if (!surface.faces().triangles || u + v <= 1) all.push_back({f, u, v});
  const LimitSamples found = surface.evaluate(points, all, 0, false);
  std::set<std::array<std::int64_t, 3>> seen;
  std::vector<Place> once;
  for (size_t i = 0; i < all.size(); ++i) {
    if (found.status[i] == LimitStatus::hole) continue;
    const Eigen::Vector3d p = 1e9 * found.position.row(Eigen::Index(i)) / diagonal(points);
    if (seen.insert({std::llround(p.x()), std::llround(p.y()), std::llround(p.z())}).second) once.push_back(all[i]);
  }
  return once;
}

/// Returns the rays through the marked places of a surface.
/// @param stride  every how manieth of `ray_offsets` is used
inline LaidRays laid_rays(const LimitMap& surface, const Points& points, size_t stride) {
  const std::vector<Place> places = marked_places(surface, points);
  const LimitSamples on = surface.evaluate(points, places, 1);
  const double size = diagonal(points);
  LaidRays laid;
  laid.t = 3 * size;
  for (Eigen::Index i = 0; i < on.position.rows(); ++i) {
    const Eigen::Vector3d at = on.position.row(i);
    Eigen::Vector3d normal = on.normal.row(i);
    if (normal.isZero(0)) normal = Eigen::Vector3d(0.36, 0.48, 0.8);
    Eigen::Index least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Eigen::Vector3d aside = normal.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(least))).normalized();
    for (size_t k = 0; k < std::size(ray_offsets); k += stride)
      for (const double sign : {1.0, -1.0}) {
        const double offset = ray_offsets[k];
        const Eigen::Vector3d through = at + sign * offset * size * aside;
        laid.rays.push_back({through + sign * laid.t * normal, -sign * normal});
        laid.through.push_back(at);
        laid.beside.push_back(offset);
      }
  }
  return laid;
}

struct LookedAtRays {
  int all = 0, given_up = 0;
};

/// Checks the laws. Rays may be given up only on surfaces without polynomials, and then have this status.
inline LookedAtRays look_at_rays(const LimitMap& surface, const Points& points, size_t stride, bool polynomials) {
  const LaidRays laid = laid_rays(surface, points, stride);
  const RayHits hits = intersect(surface, points, laid.rays, {.all = true});
  const double size = diagonal(points);
  const bool closed = why_not_closed(surface).empty();
  LookedAtRays looked{int(laid.rays.size())};
  for (size_t i = 0; i < laid.rays.size(); ++i) {
    SCOPED_TRACE("ray " + std::to_string(i) + " through (" + std::to_string(laid.through[i].x()) + ", " +
                 std::to_string(laid.through[i].y()) + ", " + std::to_string(laid.through[i].z()) + "), " +
                 std::to_string(laid.beside[i]) + " beside");
    bool found = false, touches = false, given_up = false;
    int crossings = 0;
    for (auto k = size_t(hits.first[i]); k < size_t(hits.first[i + 1]); ++k) {
      given_up = given_up || hits.kinds[k] == HitKind::given_up;
      touches = touches || hits.kinds[k] == HitKind::touching;
      crossings += hits.kinds[k] == HitKind::crossing;
      const double off = std::abs(hits.t[k] - laid.t) / size;
      found = found || off <= (hits.kinds[k] == HitKind::touching ? found_touch : found_hit);
    }
    looked.given_up += given_up;
    EXPECT_FALSE(given_up && polynomials);
    if (given_up) continue;
    if (laid.beside[i] <= as_good_as_through) {
      EXPECT_TRUE(found);
    }
    if (closed && !touches) {
      EXPECT_EQ(crossings % 2, 0);
    }
  }
  return looked;
}

/// Returns true if a face has a vertex twice. The limit then folds there at every level, and rays may be given
/// up.
inline bool folds(const Mesh& mesh) {
  size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    std::vector<Index> corners(mesh.face_vertices.begin() + std::ptrdiff_t(first),
                               mesh.face_vertices.begin() + std::ptrdiff_t(first + size_t(size)));
    std::sort(corners.begin(), corners.end());
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) return true;
    first += size_t(size);
  }
  return false;
}

class RayLaws : public ::testing::TestWithParam<std::string> {
 protected:
  /// Checks the laws on a mesh, unless enough rays were checked. Meshes without a limit somewhere are only
  /// counted.
  void look_at_mesh(Mesh mesh, const std::string& name) {
    SCOPED_TRACE(scheme_.name + " on " + name);
    if (folds(mesh)) return;
    // Without polynomials a ray through a vertex takes a hundred times as long.
    const bool is_slow = types_->pieces().has_no_polynomials();
    if (!full_sweep() && rays_ >= (is_slow ? 200 : 800)) return;
    if (scheme_.face_size() == 3) mesh = triangulated(mesh);
    std::unique_ptr<LimitMap> surface;
    try {
      surface = std::make_unique<LimitMap>(scheme_, mesh, SubdivisionOptions{}, types_);
    } catch (const UnsupportedTopology&) {
      mesh = without_creases(mesh);
      surface = std::make_unique<LimitMap>(scheme_, mesh, SubdivisionOptions{}, types_);
    }
    try {
      surface->prepare();
      const bool polynomials = !types_->pieces().has_no_polynomials();  // known once pieces were looked at
      const LookedAtRays looked =
          look_at_rays(*surface, mesh.positions, polynomials || full_sweep() ? 1 : 3, polynomials);
      rays_ += looked.all;
      given_up_ += looked.given_up;
    } catch (const AnalysisError&) {
      ++without_limit_;
    }
  }

  const Scheme<double> scheme_ = *find_scheme(GetParam());
  const std::shared_ptr<LimitCache> types_ = std::make_shared<LimitCache>(scheme_, 4096);
  int rays_ = 0, without_limit_ = 0;
  int given_up_ = 0;  ///< rays given up on pieces without polynomials, which the README allows
};

/// Number of rays through marked places of which at most one may be given up.
constexpr int rays_to_one_given_up = 20;

inline std::vector<std::string> names_of_schemes() {
  std::vector<std::string> names;
  for (const Scheme<double>& scheme : all_schemes()) names.push_back(scheme.name);
  return names;
}

/// Returns the name of a test whose parameter is the name of a scheme.
inline std::string ray_test_name(const ::testing::TestParamInfo<std::string>& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace sublimit::testing
