// SPDX-License-Identifier: Apache-2.0
// What the gallery's numbers say of the schemes, and why.
#include "sublimit/stencils/gallery/exhibit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using namespace gallery;

bool takes(const Scheme<double>& scheme, const std::string& cage) { return scheme.face_size() != 3 || cage != "cube"; }

/// Each is measured once.
const Measured& measured(const std::string& scheme, const std::string& cage) {
  static std::map<std::string, LimitCache> caches;
  static std::map<std::pair<std::string, std::string>, Measured> all;
  const auto [found, fresh] = all.try_emplace({scheme, cage});
  if (fresh) {
    LimitCache& cache = caches.try_emplace(scheme, find_scheme(scheme).value()).first->second;
    for (const Cage& one : cages())
      if (one.name == cage) found->second = exhibit(one, cache, {.levels = 0, .faces = 1000}).measured;
  }
  return found->second;
}

constexpr const char* all_cages[] = {"cube", "cube-tetrahedral", "cube-irregular", "tetrahedron"};
constexpr const char* cages_of_triangles[] = {"cube-tetrahedral", "cube-irregular", "tetrahedron"};

double bending(const Measured& m) { return m.bending.back().energy; }
/// What fourfold refinement multiplies the bending energy by: 1 where curvature is square integrable.
double growth(const Measured& m) { return bending(m) / m.bending[m.bending.size() - 2].energy; }

// Biquadratic patches depend on fewer points than bicubic ones: over a corner of the cube the limit is at 2/3 of it
// (DooSabin.CubeCornersTendToTwoThirds), not at 1/2 (Halstead's mask of valence 3: (9 - 1 + 4)/24).
TEST(Exhibit, DooSabinStaysTwiceAsNearTheCageAsCatmullClark) {
  for (const char* cage : {"cube", "tetrahedron"})
    EXPECT_LT(measured("doo-sabin", cage).mean_distance, measured("catmull-clark", cage).mean_distance / 2) << cage;
  const double corner = std::sqrt(3.) / 6;  // from (1, 1, 1)/2 to the nearest face, over the diagonal
  EXPECT_NEAR(measured("catmull-clark", "cube").max_distance, corner / 2, other_route);
}

// Masks see the net alone: where diagonals cut the faces of a cube, the symmetries that do not keep the diagonals are
// lost. Bilinear limits are the cage itself.
TEST(Exhibit, LimitsHaveTheSymmetriesOfTheNet) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const std::string cage : all_cages) {
      if (!takes(scheme, cage)) continue;
      const bool cut = cage == "cube-tetrahedral" || cage == "cube-irregular";
      const double defect = measured(scheme.name, cage).symmetry_defect;
      if (cut && scheme.claims.regular > 0) {
        EXPECT_GT(defect, .01) << scheme.name << ", " << cage;
      } else {
        EXPECT_LT(defect, other_route) << scheme.name << ", " << cage;
      }
    }
}

// Means of points lie inside of their hull; a surface through the corners that has tangent planes there must leave it.
TEST(Exhibit, ApproximationShrinksAndInterpolationSwells) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const char* cage : all_cages) {
      if (!takes(scheme, cage) || scheme.claims.regular == 0) continue;
      EXPECT_EQ(measured(scheme.name, cage).volume > 1, scheme.claims.interpolates) << scheme.name << ", " << cage;
    }
}

// Every vertex of a tetrahedron is every other one's neighbour, so that limits are means of all four points: Loop's of
// a vertex is at 1/5 of it (Errata.InterpolatingTheCubeIsSingular), and little of the volume is left. Doo and Sabin's
// points are means of a face alone, and that limit is at 5/9.
TEST(Exhibit, TetrahedraShrinkMostUnderTheWidestMasks) {
  for (const char* scheme : {"catmull-clark", "loop", "loop-warren", "sqrt3", "averaging"})
    EXPECT_LT(measured(scheme, "tetrahedron").volume, .2) << scheme;
  for (const char* scheme : {"doo-sabin", "mid-edge-habib-warren"})
    EXPECT_GT(measured(scheme, "tetrahedron").volume, .5) << scheme;
}

// The limit over a corner is (1, 1, 1)/2. Over the middle of a face it is that of the face point (1, 0, 0) of level 1,
// among four edge points like (3, 3, 0)/4 and four vertex points like 5/9 (1, 1, 1): (16 + 12 + 20/9)/36 = 68/81.
TEST(Exhibit, CatmullClarkOfACubeIsThreePerCentOffASphere) {
  EXPECT_NEAR(measured("catmull-clark", "cube").roundness, (68. / 81) / (std::sqrt(3.) / 2), other_route);
}

// Schemes that keep vertices have no second derivatives, on regular nets neither, and the energy of finer meshes goes
// on growing. Curvatures of Loop and of Catmull and Clark are square integrable (Reif, Schroeder 2001).
TEST(Exhibit, BendingEnergyGrowsUnderInterpolationOnly) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const char* cage : all_cages) {
      if (!takes(scheme, cage)) continue;
      const double g = growth(measured(scheme.name, cage));
      if (scheme.claims.interpolates) {
        EXPECT_GT(g, 1.02) << scheme.name << ", " << cage;
      }
      if (scheme.name == "catmull-clark" || scheme.name == "loop") {
        EXPECT_LT(g, 1.02) << scheme.name << ", " << cage;
      }
    }
}

// It also bends more than the approximating surface of the same split: it must turn within the faces next to a vertex.
TEST(Exhibit, InterpolatingSurfacesBendMoreThanApproximatingOnesOfTheirSplit) {
  const std::pair<const char*, const char*> pairs[] = {
      {"kobbelt", "catmull-clark"}, {"modified-butterfly", "loop"}, {"interpolatory-sqrt3", "sqrt3"}};
  for (const char* cage : cages_of_triangles)
    for (const auto& [through, near] : pairs)
      EXPECT_GT(bending(measured(through, cage)), bending(measured(near, cage))) << through << ", " << cage;
  EXPECT_GT(bending(measured("kobbelt", "cube")), bending(measured("catmull-clark", "cube")));
}

}  // namespace
}  // namespace sublimit::testing
