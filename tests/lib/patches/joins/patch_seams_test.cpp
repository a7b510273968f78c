// SPDX-License-Identifier: Apache-2.0
// Seams of models: spheres and tori, cubes, surfaces that were cut, in every arrangement of their pieces.
#include "sublimit/patches/joins/patch_seams.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <random>

#include "meshes/spline_models.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/joins/seam_vertices.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/classical_splines.h"

namespace sublimit::testing {
namespace {

std::map<SeamKind, int> counts(const PatchSeams& found) {
  std::map<SeamKind, int> result;
  for (const PatchSeam& seam : found.seams) ++result[seam.kind];
  return result;
}
using Counts = std::map<SeamKind, int>;

PatchSeams seams_of(const SplineModel& model, const SeamOptions& options = {}) {
  return patch_seams(model.patches(), model.coordinates, options);
}

TEST(PatchSeams, SphereAndTorusAreSmoothThoughTheirColumnsAreNot) {
  const PatchSeams sphere = seams_of(nurbs_sphere());
  EXPECT_EQ(counts(sphere), (Counts{{SeamKind::knot, 4}, {SeamKind::sides, 1}, {SeamKind::collapsed, 2}}));
  const PatchSeams torus = seams_of(nurbs_torus());
  EXPECT_EQ(counts(torus), (Counts{{SeamKind::knot, 6}, {SeamKind::sides, 2}}));
  for (const PatchSeams* model : {&sphere, &torus})
    for (const PatchSeam& seam : model->seams) {
      if (seam.kind == SeamKind::collapsed) {
        EXPECT_TRUE(seam.has_plane);
        continue;
      }
      EXPECT_EQ(seam.measured->c, 1) << name(seam.kind) << seam.knot;
      EXPECT_EQ(seam.measured->g, 2) << name(seam.kind) << seam.knot << name(seam.measured->obstacle);
      if (seam.kind == SeamKind::knot) {
        EXPECT_EQ(seam.columns_c, 0);
      }
      EXPECT_TRUE(seam.same_orientation);
      EXPECT_LE(seam.gap->value, rounding(16, 4));
      EXPECT_LE(seam.angle->value, reference_angle);
    }
  EXPECT_EQ(sphere.smooth_lines + torus.smooth_lines, 0);
  const std::vector<SeamVertex> poles = seam_vertices(nurbs_sphere().patches(), Coordinates::homogeneous, sphere);
  EXPECT_EQ(poles.size(), 2);
  for (const SeamVertex& pole : poles) EXPECT_TRUE(pole.is_degenerate);
  const SplineModel ring = nurbs_torus();
  const std::vector<SeamVertex> corners = seam_vertices(ring.patches(), ring.coordinates, torus);
  ASSERT_EQ(corners.size(), 1);
  EXPECT_EQ(corners[0].valence(), 4);
  EXPECT_TRUE(corners[0].is_interior);
  EXPECT_TRUE(corners[0].planes_agree);
  EXPECT_LE(*corners[0].twist_residual, reference);
  EXPECT_LE(std::abs(*corners[0].enclosure), reference);
  EXPECT_EQ(corners[0].can_be_enclosed, true);
}

TEST(PatchSeams, ClosedKnotsHaveAPeriod) {
  // A torus of doubly closed uniform knots: C^1 of degree 2.
  std::mt19937 random(1);
  SplineModel model;
  model.add(Knots<double>::closed(2, {0, 1, 2, 3, 4, 5}), Knots<double>::closed(2, {0, 1, 2, 3, 4}),
            [&](double u, double v) -> Eigen::RowVector3d {
              // Not regular: the curvature of regular ones does not jump.
              const double a = 2 * std::numbers::pi * u / 5, b = 2 * std::numbers::pi * v / 4, r = 3 + std::cos(b);
              return Eigen::RowVector3d(r * std::cos(a), r * std::sin(a), std::sin(b)) +
                     random_points(random, 1, 3) / 4;
            });
  const PatchSeams found = seams_of(model);
  EXPECT_EQ(counts(found), (Counts{{SeamKind::knot, 4 + 3}, {SeamKind::period, 2}}));
  for (const PatchSeam& seam : found.seams) {
    EXPECT_EQ(seam.measured->c, 1);
    EXPECT_EQ(seam.measured->g, 1);
    EXPECT_EQ(seam.columns_c, 1);
    EXPECT_TRUE(seam.same_orientation);
  }
  // Smooth ones are not compared.
  SplineModel cubic;
  cubic.add(Knots<double>::closed(3, {0, 1, 2, 3, 4, 5}), bezier_knots<double>(1),
            [](double u, double v) -> Eigen::RowVector3d {
              return {std::cos(u), std::sin(u), v};
            });
  const PatchSeams smooth = seams_of(cubic);
  EXPECT_EQ(counts(smooth), (Counts{{SeamKind::boundary, 2}}));
  EXPECT_EQ(smooth.smooth_lines, 5);
  EXPECT_TRUE(seam_vertices(cubic.patches(), cubic.coordinates, smooth).empty());
}

TEST(PatchSeams, ARepeatedRowOfControlPointsIsNoSmoothKnot) {
  // Cubic with simple knots, three equal rows: C^2 and an edge.
  SplineModel model;
  const double x[] = {0, 1, 2, 2, 2, 3, 4}, z[] = {0, 0, 0, 0, 0, 1, 2};
  std::vector<double> knots;
  for (int i = 0; i < 11; ++i) knots.push_back(i);
  model.add(Knots<double>::open(3, 7, knots), bezier_knots<double>(1));
  for (Index i = 0; i < 14; ++i) model.columns.back().row(i) << x[i % 7], i / 7, z[i % 7];
  const PatchSeams found = seams_of(model);
  ASSERT_EQ(counts(found), (Counts{{SeamKind::knot, 1}, {SeamKind::boundary, 4}}));
  EXPECT_EQ(found.smooth_lines, 2);
  EXPECT_EQ(found.seams[0].knot, 5);
  EXPECT_EQ(found.seams[0].columns_c, 2);
  EXPECT_EQ(found.seams[0].measured->c, 2);
  EXPECT_EQ(found.seams[0].measured->g, 0);
}

TEST(PatchSeams, PiecesOfASurfaceMeetAsItDoesInEveryArrangement) {
  // A bicubic surface with knots along the cut, cut at a knot of multiplicity 3 - c.
  std::mt19937 random(2);
  for (int c = 0; c <= 2; ++c) {
    std::vector<double> knots{0, 0, 0, 0};
    knots.insert(knots.end(), size_t(3 - c), 1);
    knots.insert(knots.end(), {2.5, 2.5, 2.5, 2.5});
    const auto across = Knots<double>::open(3, Index(knots.size()) - 4, knots);
    const auto along = Knots<double>::open(3, 6, {0, 0, 0, 0, 0.3, 0.6, 1, 1, 1, 1});
    SplineModel whole;
    whole.add(across, along, [&](double u, double v) -> Eigen::RowVector3d {
      std::uniform_real_distribution<double> noise(-0.1, 0.1);
      return {u + noise(random), v + noise(random), noise(random)};
    });
    const std::array<SplineModel, 2> halves = cut_in_u(whole, 1);
    for (int arrangement = 0; arrangement < 64; ++arrangement) {
      SplineModel both = arranged(halves[0], arrangement % 8);
      both.append(arranged(halves[1], arrangement / 8));
      const PatchSeams found = seams_of(both);
      ASSERT_EQ(counts(found)[SeamKind::sides], 1);
      EXPECT_EQ(counts(found)[SeamKind::boundary], 6);
      const PatchSeam& seam = *std::ranges::find(found.seams, SeamKind::sides, &PatchSeam::kind);
      EXPECT_EQ(seam.measured->c, c) << arrangement;
      EXPECT_EQ(seam.measured->g, c) << arrangement << name(seam.measured->obstacle);
      // Reversed or transposed once is turned over, twice is not.
      const auto is_turned = [](int a) { return (a % 2 + a / 2 % 2 + a / 4) % 2 == 1; };
      EXPECT_EQ(seam.same_orientation, is_turned(arrangement % 8) == is_turned(arrangement / 8)) << arrangement;
      EXPECT_LE(seam.gap->value, reference);
      const std::vector<SeamVertex> vertices = seam_vertices(both.patches(), both.coordinates, found);
      EXPECT_EQ(vertices.size(), 6);
      EXPECT_EQ(std::ranges::count(vertices, 2, &SeamVertex::valence), 2);
      for (const SeamVertex& vertex : vertices) {
        EXPECT_FALSE(vertex.is_interior);
        EXPECT_EQ(vertex.planes_agree, c > 0 || vertex.valence() == 1);
      }
    }
    // With other knots and degrees along the seam on one side it is the same.
    SplineModel finer = halves[0];
    SplineModel other = halves[1];
    other.refine(other.surfaces[0].u(), halved_knots(other.surfaces[0].v()));
    other.refine(other.surfaces[0].u(), elevated_knots(other.surfaces[0].v()));
    finer.refine(finer.surfaces[0].u(), with_knot(finer.surfaces[0].v(), 0.45));
    finer.append(arranged(other, 5));
    const PatchSeams found = seams_of(finer);
    const PatchSeam& seam = *std::ranges::find(found.seams, SeamKind::sides, &PatchSeam::kind);
    EXPECT_EQ(seam.measured->c, c);
    EXPECT_EQ(seam.measured->g, c);
  }
}

TEST(PatchSeams, ACubeHasTwelveEdgesAndEightVertices) {
  const SplineModel cube = bilinear_cube();
  const PatchSeams found = seams_of(cube);
  EXPECT_EQ(counts(found), (Counts{{SeamKind::sides, 12}}));
  for (const PatchSeam& seam : found.seams) {
    EXPECT_EQ(*seam.measured, (JoinOrders{0, 0, false, JoinObstacle::angle}));
    EXPECT_NEAR(seam.angle->value, std::numbers::pi / 2, rounding(4));
    EXPECT_TRUE(seam.same_orientation);
  }
  const std::vector<SeamVertex> vertices = seam_vertices(cube.patches(), cube.coordinates, found);
  EXPECT_EQ(vertices.size(), 8);
  for (const SeamVertex& vertex : vertices) {
    EXPECT_EQ(vertex.valence(), 3);
    EXPECT_TRUE(vertex.is_interior);
    EXPECT_FALSE(vertex.is_degenerate);
    EXPECT_FALSE(vertex.planes_agree);
    EXPECT_NEAR(vertex.plane_angle, std::numbers::pi / 2, rounding(4));
    EXPECT_FALSE(vertex.twist_residual);
  }
  // One face turned over.
  SplineModel turned = cube;
  turned.columns[2] = arranged(cube.only(2), 1).columns[0];
  int other = 0;
  for (const PatchSeam& seam : seams_of(turned).seams) other += !seam.same_orientation;
  EXPECT_EQ(other, 4);
}

TEST(PatchSeams, SidesThatTouchPartsOfOthersAreSaidToBePartial) {
  // A plane rectangle over two others, the second bent up by an angle.
  const auto rectangle = [](double x0, double x1, double y0, double y1, double slope) {
    SplineModel model;
    model.add(bezier_knots<double>(1), bezier_knots<double>(1), [=](double u, double v) -> Eigen::RowVector3d {
      const double y = y0 + v * (y1 - y0);
      return {x0 + u * (x1 - x0), y, -slope * std::min(y, 0.0)};
    });
    return model;
  };
  SplineModel model = rectangle(0, 3, 0, 1, 0);
  model.append(rectangle(0, 1, -1, 0, 0));
  model.append(rectangle(1, 3, -1, 0, 0.25));
  const PatchSeams found = seams_of(model);
  EXPECT_EQ(counts(found), (Counts{{SeamKind::partial, 2}, {SeamKind::boundary, 9}}));
  std::vector<PatchSeam> partial;
  for (const PatchSeam& seam : found.seams)
    if (seam.kind == SeamKind::partial) partial.push_back(seam);
  ASSERT_EQ(partial.size(), 2);
  for (const PatchSeam& seam : partial) {
    EXPECT_EQ(seam.lines[1].patch, 0);  // the small sides are on a part of the large one
    EXPECT_EQ((*seam.part), (std::array<double, 2>{0, 1}));
    EXPECT_LE(seam.gap->value, reference);
    const bool flat = seam.lines[0].patch == 1;
    EXPECT_EQ(seam.measured->g, flat ? 2 : 0);
    EXPECT_NEAR(seam.angle->value, flat ? 0 : std::atan(0.25), reference);
    EXPECT_TRUE(seam.same_orientation);
  }
  // Sides that overlap.
  SplineModel shifted = rectangle(0, 2, 0, 1, 0);
  shifted.append(rectangle(0.5, 2.5, -1, 0, 0));
  for (const PatchSeam& seam : seams_of(shifted).seams) {
    if (seam.kind != SeamKind::partial) continue;
    constexpr double searched = 1e-5;  // how far ends of a shared part are halved
    EXPECT_NEAR((*seam.part)[0], 0.25, searched);
    EXPECT_EQ((*seam.part)[1], 1);
  }
}

TEST(PatchSeams, OneCurveInTwoParametersIsMeasuredAtNearestPoints) {
  // The same parabola in u and in u + u (1 - u)/2.
  SplineModel model;
  model.add(bezier_knots<double>(2), bezier_knots<double>(1), [](double u, double v) -> Eigen::RowVector3d {
    return {u, v, u == 0.5 ? 0.0 : u};  // control points of z = x^2
  });
  model.add(bezier_knots<double>(4), bezier_knots<double>(1));
  // x = 3/2 t - t^2/2, z = x^2 = 9/4 t^2 - 3/2 t^3 + t^4/4, by the sums of binomials.
  const double x[] = {0, 0.375, 0.75 - 1.0 / 12, 1.125 - 0.25, 1}, z[] = {0, 0, 0.375, 1.125 - 0.375, 1};
  for (Index i = 0; i < 10; ++i) model.columns[1].row(i) << x[i % 5], -double(i / 5), z[i % 5];
  const PatchSeams found = seams_of(model);
  ASSERT_EQ(counts(found), (Counts{{SeamKind::reparametrised, 1}, {SeamKind::boundary, 6}}));
  const PatchSeam& seam = found.seams[0];
  EXPECT_LE(seam.gap->value, reference);
  EXPECT_EQ(seam.measured->g, 2);
  EXPECT_FALSE(seam.same_orientation);  // v runs the other way
}

TEST(PatchSeams, ThreeSidesOnOneCurveAreNonManifold) {
  SplineModel model;
  for (int k = 0; k < 3; ++k)
    model.add(bezier_knots<double>(1), bezier_knots<double>(1), [&](double u, double v) -> Eigen::RowVector3d {
      return {u * std::cos(2.0 * k), u * std::sin(2.0 * k), v};
    });
  const PatchSeams found = seams_of(model);
  EXPECT_EQ(counts(found), (Counts{{SeamKind::non_manifold, 1}, {SeamKind::boundary, 9}}));
  EXPECT_EQ(found.seams[0].lines.size(), 3);
  EXPECT_FALSE(found.seams[0].is_compared());
}

/// Around a vertex in the plane z = 0: c_i = t_i u + k_i |t_i|^2 u^2/2 N, and twists m_i N.
SplineModel star(const std::vector<double>& angles, const std::vector<double>& curvatures,
                 const std::vector<double>& twists) {
  SplineModel model;
  const size_t n = angles.size();
  const auto tangent = [&](size_t i) -> Eigen::RowVector3d {
    const double length = 1 + 0.25 * double(i % n);
    return {length * std::cos(angles[i % n]), length * std::sin(angles[i % n]), 0};
  };
  for (size_t i = 0; i < n; ++i) {
    model.add(bezier_knots<double>(2), bezier_knots<double>(2));
    const Eigen::RowVector3d a = tangent(i), b = tangent(i + 1), up(0, 0, 1);
    const Eigen::RowVector3d uu = curvatures[i] * a.squaredNorm() * up,
                             vv = curvatures[(i + 1) % n] * b.squaredNorm() * up, uv = twists[i] * up;
    // Bezier points from the derivatives at the corner.
    for (int j = 0; j <= 2; ++j)
      for (int k = 0; k <= 2; ++k)
        model.columns.back().row(k + 3 * j) =
            k / 2.0 * a + j / 2.0 * b + (k == 2 ? 0.5 : 0.0) * uu + (j == 2 ? 0.5 : 0.0) * vv + k * j / 4.0 * uv;
  }
  return model;
}

/// The vertex in the middle.
SeamVertex middle(const SplineModel& model) {
  const std::vector<SeamVertex> all = seam_vertices(model.patches(), model.coordinates, seams_of(model));
  return *std::ranges::find(all, true, &SeamVertex::is_interior);
}

TEST(SeamVertices, EnclosureIsPetersCondition) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1, 1);
  for (int n = 3; n <= 8; ++n)
    for (int repeat = 0; repeat < 6; ++repeat) {
      std::vector<double> angles, curvatures, twists;
      for (int i = 0; i < n; ++i) {
        angles.push_back((i + 0.25 * draw(random)) * 2 * std::numbers::pi / n);
        curvatures.push_back(draw(random));
        twists.push_back(draw(random));
      }
      const SeamVertex any = middle(star(angles, curvatures, twists));
      EXPECT_EQ(any.valence(), n);
      EXPECT_TRUE(any.planes_agree);
      EXPECT_GT(*any.twist_residual, 0);
      EXPECT_EQ(any.enclosure.has_value(), n % 2 == 0);
      if (n % 2 == 0) {
        double sum = 0;
        for (int i = 0; i < n; ++i) {
          const double before = angles[size_t(i)] - angles[size_t((i + n - 1) % n)],
                       after = angles[size_t((i + 1) % n)] - angles[size_t(i)];
          sum += (i % 2 == 0 ? 1 : -1) * curvatures[size_t(i)] * std::sin(before + after) /
                 (std::sin(before) * std::sin(after));
        }
        EXPECT_NEAR(std::abs(*any.enclosure), std::abs(sum), reference * 100);
        EXPECT_EQ(any.can_be_enclosed, false);
      }
      // Curvatures of one second fundamental form, and its twists.
      const double L = draw(random), M = draw(random), N = draw(random);
      const auto form = [&](double a, double b) {
        return L * std::cos(a) * std::cos(b) + M * std::sin(a + b) + N * std::sin(a) * std::sin(b);
      };
      for (int i = 0; i < n; ++i) {
        const double a = angles[size_t(i)], b = angles[size_t((i + 1) % n)];
        curvatures[size_t(i)] = form(a, a);
        twists[size_t(i)] = (1 + 0.25 * i) * (1 + 0.25 * ((i + 1) % n)) * form(a, b);
      }
      const SeamVertex smooth = middle(star(angles, curvatures, twists));
      EXPECT_LE(*smooth.twist_residual, reference * 100);
      EXPECT_EQ(smooth.can_be_enclosed, n % 2 == 0 ? std::optional(true) : std::nullopt) << "asked of even ones";
      if (n % 2 == 0) {
        EXPECT_LE(std::abs(*smooth.enclosure), reference * 100);
      }
    }
}

TEST(PatchSeams, RefusesBrokenInput) {
  expect_error<InvalidParameter>([] { patch_seams({}, Coordinates::plain); }, {"no patches"});
  SplineModel model = bilinear_cube();
  model.columns[3](2, 1) = std::nan("");
  expect_error<InvalidParameter>([&] { seams_of(model); }, {"patch 3", "control point 2", "not finite"});
  model.columns[3].conservativeResize(3, 3);
  expect_error<InvalidParameter>([&] { seams_of(model); }, {"patch 3", "3 x 3, not 4 x 3"});
  const SplineModel cube = bilinear_cube();
  expect_error<InvalidParameter>([&] { patch_seams(cube.patches(), Coordinates::homogeneous); }, {"4 x 3, not 4 x 4"});
  std::vector<std::shared_ptr<const Patch>> patches;
  for (const SplineSurface& surface : cube.surfaces) patches.push_back(std::make_shared<const SplineSurface>(surface));
  const PatchSet set(patches);
  expect_error<InvalidParameter>([&] { patch_columns(set, Points::Zero(3, 3)); }, {"3 control points", "24"});
  EXPECT_EQ(patch_columns(set, Points::Zero(24, 3)).size(), 6);
}

}  // namespace
}  // namespace sublimit::testing
