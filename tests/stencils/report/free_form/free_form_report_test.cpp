// SPDX-License-Identifier: Apache-2.0
// Reports on shapes whose joins are known: spheres, tori, pipes, the teapot, kinks, gaps, T-junctions.
#include "sublimit/report/free_form/free_form_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "meshes/free_form_shapes.h"
#include "sublimit/base/detail/format_number.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

constexpr double known_angle = 1e-9;  ///< degrees

FreeFormReport report_of(FreeForm shapes, const FreeFormReportOptions& options = {}) {
  return free_form_report(std::move(shapes), "shapes.obj", options);
}
FreeFormReport report_of(const std::string& text, const FreeFormReportOptions& options = {}) {
  return report_of(parse_free_form(text, "shapes.obj"), options);
}

int count_of(const FreeFormReport& report, SeamKind kind) {
  return int(std::ranges::count_if(report.seams, [&](const ReportedSeam& seam) { return seam.seam.kind == kind; }));
}

const FreeFormWarning* warning(const FreeFormReport& report, const std::string& part) {
  for (const FreeFormWarning& w : report.warnings)
    if (w.says.find(part) != std::string::npos) return &w;
  return nullptr;
}

/// A bilinear patch of four points.
std::string patch(const std::array<Eigen::Vector3d, 4>& corners) {
  std::string text;
  for (const Eigen::Vector3d& p : corners)
    text += "v " + format_number(p.x()) + " " + format_number(p.y()) + " " + format_number(p.z()) + "\n";
  return text + "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 -4 -3 -2 -1\nparm u 0 1\nparm v 0 1\nend\n";
}

/// Two unit squares, the second one turned up by an angle about the edge x = 1 and moved.
std::string two_squares(double angle_degrees, double moved = 0) {
  const Eigen::Vector3d far(std::cos(angle_degrees * pi / 180), 0, std::sin(angle_degrees * pi / 180)),
      x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), m = moved * x;
  return patch({Eigen::Vector3d::Zero(), x, y, x + y}) + patch({x + m, x + far + m, x + y + m, x + y + far + m});
}

TEST(FreeFormReport, AKinkOfFiveDegreesIsOne) {
  const FreeFormReport r = report_of(two_squares(5));
  ASSERT_EQ(r.seams.size(), 7u);
  const ReportedSeam& kink = r.seams[0];
  EXPECT_EQ(kink.seam.kind, SeamKind::sides);
  EXPECT_EQ(kink.seam.measured->g, 0);
  EXPECT_EQ(*kink.exact, (JoinOrders{0, 0, false, JoinObstacle::angle}));
  EXPECT_NEAR(r.seam_deviation.angle_degrees.value(), 5, known_angle);
  EXPECT_EQ(r.seam_deviation.gap, 0);
  EXPECT_EQ(r.seam_verdict->says, "G^0 at its only seam: largest angle 5 degrees between patch 0 and patch 1");
  EXPECT_EQ(r.boundary_loops, 1u);
  EXPECT_EQ(count_of(r, SeamKind::boundary), 6);
  EXPECT_FALSE(r.joint_verdict);
  EXPECT_EQ(r.within_tolerance, std::nullopt) << "nothing was asked";
}

TEST(FreeFormReport, TolerancesAreHeldAgainstSeams) {
  const auto held = [](double g1) {
    FreeFormReportOptions options;
    options.tolerance.g1_degrees = g1;
    return report_of(two_squares(5), options);
  };
  EXPECT_EQ(held(5.1).within_tolerance, true);
  EXPECT_TRUE(held(5.1).beyond.empty());
  const FreeFormReport beyond = held(4.9);
  EXPECT_EQ(beyond.within_tolerance, false);
  ASSERT_EQ(beyond.beyond.size(), 1u);
  EXPECT_STREQ(beyond.beyond[0].what, "g1");
  EXPECT_NEAR(beyond.beyond[0].value, 5, known_angle);
  EXPECT_EQ(beyond.beyond[0].number, 0u);
  EXPECT_NEAR(beyond.beyond[0].place.x(), 1, rounding(4));
}

TEST(FreeFormReport, AToleranceWithNothingToCompareIsNotKept) {
  FreeFormReportOptions options;
  options.tolerance.g1_degrees = 1;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const FreeFormReport alone = report_of(patch({Eigen::Vector3d::Zero(), x, y, x + y}), options);
  EXPECT_EQ(alone.within_tolerance, std::nullopt);
  EXPECT_EQ(alone.seam_verdict->compared, 0u);
  EXPECT_EQ(alone.seam_verdict->says, "no seams to compare");
}

TEST(FreeFormReport, SidesThatNearlyMeetHaveAGap) {
  constexpr double gap = 1e-4;  // beyond 1e-6 of the diagonal, within 1e-3
  const FreeFormReport r = report_of(two_squares(0, gap));
  const ReportedSeam& seam = r.seams[0];
  EXPECT_TRUE(seam.is_gap);
  EXPECT_EQ(seam.seam.measured->g, -1);
  EXPECT_NEAR(seam.seam.gap->value, gap, rounding(8));
  EXPECT_FALSE(seam.exact);
  EXPECT_EQ(count_of(r, SeamKind::boundary), 6) << "its sides are no boundary";
  ASSERT_TRUE(warning(r, "there is a gap"));
  EXPECT_EQ(warning(r, "there is a gap")->severity, AssetWarning::Severity::warning);
  FreeFormReportOptions allowed;
  allowed.tolerance.g0 = 2 * gap;
  EXPECT_EQ(report_of(two_squares(0, gap), allowed).within_tolerance, true);
  allowed.tolerance.g0 = gap / 2;
  EXPECT_EQ(report_of(two_squares(0, gap), allowed).within_tolerance, false);
  // Farther away they are two surfaces.
  const FreeFormReport apart = report_of(two_squares(0, 0.1));
  EXPECT_EQ(apart.seam_verdict->compared, 0u);
  EXPECT_EQ(apart.boundary_loops, 2u);
}

TEST(FreeFormReport, SidesAlongABoundaryHaveNoGap) {
  // Forty squares in a row: what is near is then more than a thirty-second of a side.
  using V = Eigen::Vector3d;
  std::string text;
  for (int i = 0; i < 40; ++i) text += patch({V(i, 0, 0), V(i + 1, 0, 0), V(i, 1, 0), V(i + 1, 1, 0)});
  const FreeFormReport r = report_of(text);
  EXPECT_EQ(r.seam_verdict->says, "C^infinity, G^infinity at all 39 seams");
  EXPECT_EQ(count_of(r, SeamKind::boundary), 82);
  EXPECT_EQ(r.boundary_loops, 1u);
}

TEST(FreeFormReport, ATJunctionIsNamed) {
  using V = Eigen::Vector3d;
  const auto rectangle = [](double x0, double x1, double y0, double y1) {
    return patch({V(x0, y0, 0), V(x1, y0, 0), V(x0, y1, 0), V(x1, y1, 0)});
  };
  const FreeFormReport r = report_of(rectangle(0, 3, 0, 1) + rectangle(0, 1, -1, 0) + rectangle(1, 3, -1, 0));
  EXPECT_EQ(count_of(r, SeamKind::partial), 2);
  ASSERT_TRUE(warning(r, "T-junction"));
  EXPECT_EQ(warning(r, "T-junction")->count, 2);
  EXPECT_EQ(r.seam_verdict->says, "G^2 at least at all 3 seams") << "flat all over";
}

TEST(FreeFormReport, SphereTorusAndPipeAreSmooth) {
  const FreeFormReport sphere = report_of(free_form_of({unit_sphere()}));
  EXPECT_EQ(sphere.seam_verdict->says, "G^2 at least at all 5 seams");
  EXPECT_EQ(count_of(sphere, SeamKind::knot), 4);
  EXPECT_EQ(count_of(sphere, SeamKind::sides), 1);
  EXPECT_EQ(count_of(sphere, SeamKind::collapsed), 2);
  ASSERT_TRUE(warning(sphere, "a pole with a limit of normals"));
  EXPECT_EQ(warning(sphere, "a pole with a limit of normals")->count, 2);
  EXPECT_FALSE(warning(sphere, "no tangent plane"));
  EXPECT_EQ(sphere.boundary_loops, 0u);
  for (const ReportedSeam& seam : sphere.seams)
    if (seam.seam.is_compared()) {
      EXPECT_NEAR(seam.seam.greatest_curvature, 1, other_route) << "of the unit sphere";
    }

  const FreeFormReport ring = report_of(free_form_of({torus()}));
  EXPECT_EQ(ring.seam_verdict->says, "G^2 at least at all 8 seams");
  ASSERT_EQ(ring.vertices.size(), 1u);
  EXPECT_TRUE(ring.vertices[0].planes_agree);
  EXPECT_TRUE(ring.warnings.empty());

  const FreeFormReport tube = report_of(free_form_of({pipe()}));
  EXPECT_EQ(tube.seam_verdict->says, "G^2 at least at all 4 seams");
  EXPECT_EQ(tube.boundary_loops, 2u);
  EXPECT_EQ(count_of(tube, SeamKind::boundary), 2);
  ASSERT_TRUE(warning(tube, "in 2 loops"));
}

TEST(FreeFormReport, TheTeapotIsWhatItIsKnownToBe) {
  const FreeFormReport r = report_of(teapot());
  // G^1 all over, and G^2 only between the patches of a ring.
  EXPECT_EQ(count_of(r, SeamKind::sides), 52);
  std::map<int, int> measured, exact;
  for (const ReportedSeam& seam : r.seams) {
    if (!seam.seam.is_compared()) continue;
    ++measured[seam.seam.measured->g];
    ++exact[seam.exact->g];
    EXPECT_EQ(seam.seam.gap->value, 0);
  }
  EXPECT_EQ(measured, (std::map<int, int>{{1, 20}, {2, 32}}));
  // Decimal fractions are rounded: where tangents are parallel and of other lengths they are so up to the last bit.
  EXPECT_EQ(exact, (std::map<int, int>{{0, 10}, {1, 10}, {2, 32}}));
  EXPECT_EQ(r.seam_verdict->exceptions, 20u);
  EXPECT_TRUE(r.seam_verdict->says.starts_with("G^2 everywhere but 20 seams: largest jump of curvature 68.43 between "))
      << r.seam_verdict->says;
  // The knob of the lid: one side is its top, and an inner row is the point where it narrows to.
  ASSERT_TRUE(warning(r, "an inner row of control points is one point"));
  EXPECT_EQ(warning(r, "an inner row of control points is one point")->patches, (std::vector<size_t>{12, 13, 14, 15}));
  EXPECT_EQ(count_of(r, SeamKind::collapsed), 8) << "of the lid and the bottom";
  EXPECT_EQ(warning(r, "a pole with a limit of normals")->count, 8);
  // Rim, lid, both ends of the handle and of the spout: nothing is joined to the body there.
  EXPECT_EQ(r.boundary_loops, 6u);
  EXPECT_EQ(count_of(r, SeamKind::boundary), 16);
  for (const SeamVertex& vertex : r.vertices) EXPECT_TRUE(vertex.is_degenerate || vertex.planes_agree);

  // As it was made first, without a bottom: one loop more, of four sides.
  FreeForm open = teapot();
  std::erase_if(open.surfaces, [&](const FreeFormSurface& surface) {
    return std::ranges::all_of(surface.points, [&](Index v) { return open.vertices(v, 2) <= 0.15; });
  });
  ASSERT_EQ(open.surfaces.size(), 28u);
  const FreeFormReport bottomless = report_of(open);
  EXPECT_EQ(bottomless.boundary_loops, 7u);
  EXPECT_EQ(count_of(bottomless, SeamKind::boundary), 20);
  EXPECT_EQ(count_of(bottomless, SeamKind::collapsed), 4);
}

TEST(FreeFormReport, PicturesHaveNetsAndIsolines) {
  const FreeFormReport r = report_of(two_squares(5));
  EXPECT_EQ(r.picture.net.rows(), 8);
  EXPECT_EQ(r.picture.net_edges.size(), 8u);
  EXPECT_GT(r.picture.surface.face_sizes.size(), 100u);
  EXPECT_FALSE(r.picture.isolines.empty());
  for (const ReportedSeam& seam : r.seams) EXPECT_GE(seam.line.size(), 9u);
}

TEST(FreeFormReport, DegenerateDataAreNamed) {
  // A cone: v = 1 is its apex, without a tangent plane.
  RationalShape cone = pipe();
  for (Eigen::Index i = 9; i < 18; ++i) cone.columns.row(i) << cone.columns(i, 3) * 4, 0, 0, cone.columns(i, 3);
  const FreeFormReport apex = report_of(free_form_of({cone}));
  ASSERT_TRUE(warning(apex, "no tangent plane there"));
  EXPECT_EQ(warning(apex, "no tangent plane there")->count, 1);
  // Rows that repeat; weights; a mesh besides; trims.
  const FreeFormReport rest = report_of(
      "v 0 0 0\nv 1 0 0\nv 0 1 0 -1\nv 1 1 0\nv 0 1 1\nv 1 1 1\nf 1 2 4\n"
      "cstype rat bezier\ndeg 1 2\nsurf 0 1 0 1 1 2 3 4 5 6\nparm u 0 1\nparm v 0 1\nend\n"
      "cstype bezier\ndeg 1 2\nsurf 0 1 0 1 1 2 1 2 5 6\nparm u 0 1\nparm v 0 1\nend\n");
  ASSERT_TRUE(warning(rest, "not positive"));
  EXPECT_EQ(warning(rest, "not positive")->patches, (std::vector<size_t>{0}));
  ASSERT_TRUE(warning(rest, "repeats the one before"));
  EXPECT_EQ(warning(rest, "repeats the one before")->patches, (std::vector<size_t>{1}));
  ASSERT_TRUE(warning(rest, "a mesh too, of 1 faces"));
}

TEST(FreeFormReport, NothingToLookAtIsRefused) {
  expect_error<UnsupportedTopology>([] { report_of(FreeForm{}); },
                                    {"shapes.obj", "neither curves in space nor surfaces", "surf"});
}

}  // namespace
}  // namespace sublimit::testing
