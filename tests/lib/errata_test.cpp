// SPDX-License-Identifier: Apache-2.0
// Rules that are misprinted or misread in circulation (laws/misreadings.h), each as a scheme of its own, and what
// becomes of it: the reasons why the registry has the rules that it has.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <numeric>
#include <vector>

#include "laws/misreadings.h"
#include "meshes/match_meshes.h"
#include "meshes/meshes.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/closed_form.h"
#include "truth/regular_limit.h"

namespace sublimit::testing {
namespace {

using Plane = LimitMasks::Plane;
using namespace misread;

LocalType vertex_of(int n) { return {.kind = Centre::Kind::vertex, .faces = n}; }
LocalType face_of(int n) { return {.kind = Centre::Kind::face, .faces = n}; }
Plane plane(const Scheme<double>& scheme, const LocalType& type) {
  return isolated_limit(scheme, type)->masks.sides.at(0).plane;
}

// "sqrt(3) interpolates: centroids and flipped edges." Without relaxation old vertices are spikes, regular ones too:
// block 0 decays like 2/3 in a step, the tangents like (2/3) cos(pi/n).
TEST(Errata, Sqrt3WithoutRelaxationMakesSpikes) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum ring(sqrt3_without_relaxation<Precise>(), n);
    expect_eigenvalues(ring, 0, {1, ratio(4, 9)});
    expect_eigenvalues(ring, 1, {2 * (1 + cosine(1, n)) / 9});
    EXPECT_LT(ring.leading(1), ring.leading(0)) << n;
    EXPECT_EQ(plane(sqrt3_without_relaxation<double>(), vertex_of(n)), Plane::no) << n;
  }
}

// "Doo-Sabin: the midpoint of vertex and centroid": (5, 1, 1, 1)/8 on quads.
TEST(Errata, DooSabinHalfwayToTheCentroidHasNoTangentPlane) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum ring(doo_sabin_halfway<Precise>(), n);
    for (int k = 1; k < n; ++k) expect_eigenvalues(ring, k, {ratio(1, 2)});  // at n = 4: three times
    EXPECT_EQ(plane(doo_sabin_halfway<double>(), face_of(n)), n == 3 ? Plane::yes : Plane::no) << n;
  }
}
// A skew quad stays similar to itself, so the normals at its corners differ for ever; with the right weights they meet.
TEST(Errata, DooSabinHalfwayToTheCentroidKeepsQuadsSkew) {
  Points quad(4, 3);
  quad << 1, 1, 2, -1, 1, -2, -1, -1, 2, 1, -1, -2;
  const auto spread = [&](const Scheme<double>& scheme) {
    const Eigen::MatrixXd A = local_patch(scheme, face_of(4))->A;
    Eigen::MatrixXd x = quad;
    for (int step = 0; step < 20; ++step) x = (A * x).eval();
    double least = 1;  // cosine
    std::vector<Eigen::RowVector3d> normals;
    for (int i = 0; i < 4; ++i) {
      const Eigen::RowVector3d next = x.row((i + 1) % 4) - x.row(i), last = x.row((i + 3) % 4) - x.row(i);
      normals.push_back(next.cross(last).normalized());
      for (const Eigen::RowVector3d& other : normals) least = std::min(least, normals.back().dot(other));
    }
    return std::acos(least);
  };
  EXPECT_GT(spread(doo_sabin_halfway<double>()), 1.5);
  constexpr double after_levels = 1e-5;  // what is left of the angle after so many levels
  EXPECT_LT(spread(find_scheme("doo-sabin").value()), after_levels);
}

// Doo and Sabin's weights, summed over i = 0 ... n: a face has n corners, so corner 0 comes twice, the sum is not 1,
// and the surface does not move with its points.
TEST(Errata, DooSabinWithOneTermMoreIsNotAffine) {
  const Scheme<double> scheme = doo_sabin_with_one_term_more<double>();
  const Masks<double>& masks = scheme.steps[0].masks;
  for (Index n = 3; n <= 20; ++n) {
    std::vector<Index> slots(static_cast<size_t>(n));
    std::iota(slots.begin(), slots.end(), 0);
    const Stencil<double> corner = masks.corner(FaceSite<double>(masks, 0, slots));
    double sum = 0;
    for (const auto& [slot, weight] : corner.terms()) sum += weight;
    EXPECT_NEAR(sum, 1 + (n + 5) / (4.0 * n), rounding(2 * n)) << n;
    expect_error<InvalidParameter>([&] { local_patch(scheme, face_of(n)); },
                                   {"one-term-more.corner: the weights add up to", "sum of 1"});
  }
}

// "The mean of centroid, corner and the midpoints of its two edges" is repeated averaging at every face. The weights
// with cosines are another rule: both continue the tensor mask of quads.
TEST(Errata, DooSabinsMeanOfFourHasTheWeightsWithCosinesOnQuadsOnly) {
  for (int n = 3; n <= 20; ++n) {
    const auto difference = [&](const char* name) {
      const auto ours = local_patch(find_scheme(name).value(), face_of(n));
      return (local_patch(doo_sabin_mean_of_four<double>(), face_of(n))->A - ours->A).cwiseAbs().maxCoeff();
    };
    EXPECT_LE(difference("doo-sabin-averaging"), rounding(8)) << n;
    EXPECT_EQ(difference("doo-sabin") <= rounding(8), n == 4) << n;
  }
}

// "Mid-edge twice is Doo-Sabin": the same faces at the same places, other points. They would be the same with weights
// 1/4, 1/2, 1/4 on three corners.
TEST(Errata, TwoMidEdgeStepsHaveTheConnectivityOfDooSabinAndNotItsPositions) {
  const Scheme<double> three_corners = doo_sabin_of_three_corners<double>();
  for (const Mesh& mesh : {jittered(prism(5)), jittered(octahedron()), jittered(torus(4, 5))}) {
    const OurMesh twice = our_mesh("mid-edge", mesh, 2);
    const auto compare = [&](const Scheme<double>& scheme) {
      const Level once = refine(scheme, mesh, 1)[1];
      const Topology& t = once.topology();
      PeerMesh peer{apply(once.S, mesh.positions), {}, {}, t.num_edges()};
      for (Index f = 0; f < t.num_faces(); ++f) {
        peer.face_sizes.push_back(t.size(Face{f}));
        for (const Index v : t.vertices(Face{f})) peer.face_vertices.push_back(v);
      }
      return match(twice, peer);
    };
    EXPECT_EQ(compare(find_scheme("doo-sabin").value()).mismatch, "");
    EXPECT_GT(compare(find_scheme("doo-sabin").value()).error, 1e-2);
    EXPECT_LE(compare(three_corners).error, reference);
  }
}

// "Points of edges at extraordinary places are joined with the centroids of the faces." Read as a rule for edges of
// faces that are not quads: half of the way from the midpoint to the centroid. Such a face then shrinks like
// cos^2(pi/n)/4 in two steps, faster than the 1/4 that its surroundings have in every block: all of these come
// together, and there is no subdominant pair, where the plain rule has one.
TEST(Errata, MidEdgeWithCentroidsOfExtraordinaryFacesLosesItsLeadingPair) {
  for (int n = 5; n <= 20; ++n) {
    const LocalSpectrum corners(mid_edge_with_centroids<Precise>(), n), rings(mid_edge_with_centroids<Precise>(), n, 1);
    for (int k = 1; k < n; ++k) expect_eigenvalues(corners, k, {(1 + cosine(k, n)) / 8});
    const LocalSpectrum plain("mid-edge", n, 1);
    EXPECT_GE(rings.leading(0), rings.leading(1) - closed_form) << n;
    EXPECT_LT(plain.leading(0), plain.leading(1)) << n;
    EXPECT_EQ(plane(mid_edge_with_centroids<double>(), face_of(n)), Plane::no) << n;
    EXPECT_EQ(plane(find_scheme("mid-edge").value(), face_of(n)), Plane::yes) << n;
  }
}

// "(F + 2 R + (n - 3) v)/n with R the mean of the new edge points": R is the mean of the midpoints of the old edges.
// The misreading weighs (1/2, 3/8, 1/8) on regular quads, not (9/16, 3/8, 1/16), and has 1/8 twice where 1/4 and 1/16
// should be.
TEST(Errata, CatmullClarkWithTheMeanOfNewEdgePointsIsNoBSpline) {
  const Scheme<double> misread = catmull_clark_with_new_edge_points<double>();
  const Eigen::MatrixXd S(refine(misread, fan(4), 1)[1].S);
  EXPECT_EQ(S(0, 0), 1.0 / 2);
  EXPECT_EQ(S(0, 1), 3.0 / 32);
  EXPECT_EQ(S(0, 2), 1.0 / 32);
  expect_eigenvalues(LocalSpectrum(catmull_clark_with_new_edge_points<Precise>(), 4), 0, {1, ratio(1, 8), ratio(1, 8)});
  const auto bicubic = [](double x, double y) { return cardinal_bspline(3, x) * cardinal_bspline(3, y); };
  EXPECT_GT(regular_limit_error(misread, bicubic), 1e-2);
}
// With the midpoints of the old edges these words are our rule, at all valences and whatever the faces: F + 2 R is the
// mean of the neighbours and of the face points, and v once more.
TEST(Errata, CatmullClarkWithTheMeanOfOldMidpointsIsTheRule) {
  for (const Mesh& mesh : {prism(5), prism(7), octahedron(), icosahedron(), fan(8)}) {
    const Eigen::MatrixXd S(refine(catmull_clark_with_old_midpoints<double>(), mesh, 1)[1].S);
    const Eigen::MatrixXd T(refine(find_scheme("catmull-clark").value(), mesh, 1)[1].S);
    EXPECT_LE((S - T).cwiseAbs().maxCoeff(), rounding(16));
  }
}

// Loop's beta is the weight of the whole ring. Divided by the valence once more, regular vertices are spikes.
TEST(Errata, LoopWithBetaDividedTwiceMakesSpikes) {
  for (int n = 3; n <= 12; ++n) {
    const LocalSpectrum ring(loop_divided_twice<Precise>(), n);
    EXPECT_GT(ring.leading(0), ring.leading(1)) << n;
    EXPECT_EQ(plane(loop_divided_twice<double>(), vertex_of(n)), Plane::no) << n;
  }
}

// The modified butterfly's rule for valences from 5 on is none for 6: the mean of both ends would not be the
// eight-point mask, but the ten-point one with t = -1/48.
TEST(Errata, ModifiedButterflyWithItsSpecialRuleAtValenceSixIsNoButterfly) {
  const Scheme<double> wrong = modified_butterfly_with_one_formula<double>();
  const auto difference = [&](const SchemeOptions& options) {
    const Mesh mesh = triangle_torus(6, 7);
    const Eigen::MatrixXd S(refine(wrong, mesh, 1)[1].S);
    const Eigen::MatrixXd T(refine(find_scheme("modified-butterfly", options).value(), mesh, 1)[1].S);
    return (S - T).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(difference({}), 2.0 / 48, rounding(16));
  EXPECT_LE(difference({{"t", "-1/48"}}), rounding(16));
}

constexpr Ratio right_r{1, 9}, wrong_r{1, 5};  // g/(8 + g), and the g/(4 + g) that circulates

// "Both ways give the same result": on regular nets, and around one extraordinary vertex if the virtual point is right.
TEST(Errata, KobbeltsTwoWaysAgreeOnRegularNets) {
  const Eigen::MatrixXd ours(refine(find_scheme("kobbelt").value(), torus(6, 7), 1)[1].S);
  for (const int way : {0, 1})
    EXPECT_LE((Eigen::MatrixXd(refine(kobbelt_one_way<double>(way, right_r), torus(6, 7), 1)[1].S) - ours)
                  .cwiseAbs()
                  .maxCoeff(),
              rounding(16));
}
TEST(Errata, KobbeltsTwoWaysAgreeAroundOneVertexWithTheRightVirtualPointOnly) {
  const auto difference = [](int n, Ratio r) {
    const auto one = local_patch(kobbelt_one_way<double>(0, r), vertex_of(n), 2);
    const auto other = local_patch(kobbelt_one_way<double>(1, r), vertex_of(n), 2);
    return (one->A - other->A).cwiseAbs().maxCoeff();
  };
  for (int n = 3; n <= 20; ++n) {
    EXPECT_LE(difference(n, right_r), rounding(64)) << n;
    if (n != 4) {
      EXPECT_GT(difference(n, wrong_r), 1e-3) << n;
    }
  }
}
TEST(Errata, KobbeltsTwoWaysDifferBetweenExtraordinaryVertices) {
  const std::vector<Level> levels = refine(find_scheme("kobbelt").value(), cube(), 1);
  const Points once = apply(levels[1].S, cube().positions);
  const auto again = [&](int way) {
    return apply(next_level(kobbelt_one_way<double>(way, right_r), levels[1]).S, once);
  };
  constexpr double three_digits = 1e-5;  // of the figure
  EXPECT_NEAR((again(0) - again(1)).cwiseAbs().maxCoeff(), 2.65e-3, three_digits);
}

// "Three vertices and a virtual one" on borders is one of two rules. With the four-point rule the border curve does not
// depend on the inside; with virtual vertices it does, unless border vertices are regular.
TEST(Errata, ButterflyBordersDependOnTheInsideWithVirtualVerticesOnly) {
  const auto reaches_inside = [](const char* rule, const Mesh& mesh) {
    const Scheme<double> scheme = find_scheme("modified-butterfly", {{"boundary-rule", rule}}).value();
    SubdivisionOptions options;
    options.boundary = Boundary::edge_only;
    const std::vector<Level> levels = refine(scheme, mesh, 1, options);
    const Topology &parent = levels[0].topology(), &child = levels[1].topology();
    for (Index r = 0; r < levels[1].S.rows(); ++r)
      for (SparseMatrix::InnerIterator it(levels[1].S, r); it; ++it)
        if (child.is_boundary(Vertex{r}) && !parent.is_boundary(Vertex{Index(it.col())}) && std::abs(it.value()) > eps)
          return true;
    return false;
  };
  EXPECT_FALSE(reaches_inside("four-point", fan(7, 3, 2)));
  EXPECT_TRUE(reaches_inside("virtual-vertex", fan(7, 3, 2)));
}

/// Faces that are no quads.
int num_polygons(const Topology& t) {
  int count = 0;
  for (Index f = 0; f < t.num_faces(); ++f) count += t.size(Face{f}) != 4;
  return count;
}

// What one step makes of V vertices, E edges and F faces of a closed mesh, whatever its polygons: "for quad meshes" is
// said of schemes that take any.
TEST(Errata, StepsMakeTheCountsOfTheirSplit) {
  struct Counts {
    std::vector<std::string> schemes;
    Index vertices, edges, faces;
  };
  const auto check = [](const Mesh& mesh, const std::vector<Counts>& all) {
    for (const Counts& counts : all)
      for (const std::string& name : counts.schemes) {
        const Level level = refine(find_scheme(name).value(), mesh, 1)[1];
        EXPECT_EQ(level.topology().num_vertices(), counts.vertices) << name;
        EXPECT_EQ(level.topology().num_edges(), counts.edges) << name;
        EXPECT_EQ(level.topology().num_faces(), counts.faces) << name;
      }
  };
  for (const Mesh& mesh : {prism(5), prism(3), octahedron(), cube(), torus(4, 3)}) {
    const Topology t(view(mesh));
    const Index V = t.num_vertices(), E = t.num_edges(), F = t.num_faces();
    check(mesh, {{{"catmull-clark", "bilinear", "averaging"}, V + E + F, 4 * E, 2 * E},
                 {{"doo-sabin", "doo-sabin-averaging"}, 2 * E, 4 * E, V + E + F},
                 {{"mid-edge", "mid-edge-habib-warren"}, E, 2 * E, V + F}});
  }
  for (const Mesh& mesh : {octahedron(), tetrahedron(), icosahedron(), triangle_torus(3, 4)}) {
    const Topology t(view(mesh));
    const Index V = t.num_vertices(), E = t.num_edges(), F = t.num_faces();
    check(mesh, {{{"loop", "loop-warren", "butterfly", "modified-butterfly"}, V + E, 2 * E + 3 * F, 4 * F},
                 {{"sqrt3", "interpolatory-sqrt3"}, V + F, 3 * E, 3 * F}});
  }
}

// "A second Doo-Sabin step is needed until the number of other polygons stays": the first is enough. A V-face joins the
// points around an old vertex, as many as its valence.
TEST(Errata, DooSabinHasItsPolygonsAfterOneStep) {
  for (const Mesh& mesh : {prism(5), octahedron(), icosahedron(), quads_from_triangles(tetrahedron())}) {
    const std::vector<Level> levels = refine(find_scheme("doo-sabin").value(), mesh, 3);
    const Topology& control = levels[0].topology();
    int expected = num_polygons(control);
    for (Index v = 0; v < control.num_vertices(); ++v) expected += control.num_faces(Vertex{v}) != 4;
    for (int k = 1; k <= 3; ++k) EXPECT_EQ(num_polygons(levels[k].topology()), expected);
    // Faces come from faces, edges and vertices, in this order.
    const Index before = control.num_faces() + control.num_edges();
    for (Index v = 0; v < control.num_vertices(); ++v)
      EXPECT_EQ(levels[1].topology().size(Face{before + v}), control.num_faces(Vertex{v}));
  }
}

// "A non-singular formulation of interpolation exists" for Catmull-Clark, but not as one control point for each vertex:
// alternating corners of a cube leave no trace in the limit.
TEST(Errata, InterpolatingTheCubeIsSingular) {
  const auto limits = [](const std::string& name, const Mesh& mesh) {
    const Scheme<double> scheme = find_scheme(name).value();
    const Level level = control_level(scheme, mesh);
    LimitCache cache(scheme);
    return Eigen::MatrixXd(limit_matrices(level, cache).position);
  };
  const auto smallest = [](const Eigen::MatrixXd& L) { return symmetric_eigenvalues(L); };
  const Eigen::VectorXd values = smallest(limits("catmull-clark", cube()));
  const double expected[] = {0, 1.0 / 6, 1.0 / 6, 1.0 / 6, 0.5, 0.5, 0.5, 1};
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(values[i], expected[i], closed_form);
  Eigen::VectorXd alternating(8);
  for (int v = 0; v < 8; ++v) alternating[v] = (v ^ (v >> 1) ^ (v >> 2)) & 1 ? -1 : 1;
  EXPECT_LE((limits("catmull-clark", cube()) * alternating).norm(), closed_form);
  EXPECT_NEAR(smallest(limits("catmull-clark", torus(6, 8)))[0], 1.0 / 9, closed_form);
  EXPECT_NEAR(smallest(limits("loop", tetrahedron()))[0], 0.2, closed_form);
  EXPECT_NEAR(smallest(limits("loop", octahedron()))[0], .1545, four_decimals);
  EXPECT_NEAR(smallest(limits("loop", icosahedron()))[0], .2350, four_decimals);
}

}  // namespace
}  // namespace sublimit::testing
