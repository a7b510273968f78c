// SPDX-License-Identifier: Apache-2.0
// Schemes of one's own are checked before anything is computed with them: a mistake is an error that names scheme, step
// and mask.
#include "sublimit/scheme/detail/check_scheme.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

/// Written as a newcomer would, in plain braces.
Scheme<double> own() {
  return {.name = "own",
          .source = "here",
          .steps = {{.split = Split::pqq,
                     .masks = {.vertex =
                                   [](const Ring<double>& v) {
                                     const int n = v.valence();
                                     return ((n - 2) * v.center() + v.neighbor_mean() + v.face_point_mean()) / n;
                                   },
                               .edge =
                                   [](const EdgeSite<double>& e) {
                                     return (e.tail() + e.head() + e.left_face().point() + e.right_face().point()) / 4;
                                   },
                               .face = [](const FaceSite<double>& f) { return f.centroid(); }}}},
          .creases = cubic_bspline_creases<double>()};
}

/// Expects the same error at every door that takes a scheme and a mesh.
void expect_refused(const Scheme<double>& scheme, const Mesh& mesh, std::initializer_list<std::string_view> parts) {
  expect_error<InvalidParameter>([&] { refine(scheme, mesh, 2); }, parts);
  expect_error<InvalidParameter>([&] { refined_mesh(scheme, mesh, 2); }, parts);
  expect_error<InvalidParameter>(
      [&] {
        const LimitMap surface(scheme, mesh);
        surface.prepare();
        surface.evaluate(mesh.positions, std::vector<Place>{{0, 0.3, 0.4}, {0, 0, 0}});
      },
      parts);
}

TEST(CheckedSchemes, OwnOnesAreTaken) {
  const Points expected = refined_mesh(*find_scheme("catmull-clark"), cube(), 3).positions;
  EXPECT_EQ(refined_mesh(own(), cube(), 3).positions, expected);
  for (const Scheme<double>& scheme : all_schemes()) EXPECT_NO_THROW(check_scheme(scheme)) << scheme.name;
}

TEST(CheckedSchemes, HaveSteps) {
  Scheme<double> scheme = own();
  scheme.steps.clear();
  expect_refused(scheme, cube(), {"own has no steps"});
  expect_error<InvalidParameter>([&] { LimitCache types(scheme); }, {"own has no steps"});
  expect_error<InvalidParameter>([&] { PieceTypes types(scheme); }, {"own has no steps"});
}

TEST(CheckedSchemes, HaveTheMasksOfTheirSplit) {
  const auto without = [](auto&& drop) {
    Scheme<double> scheme = own();
    drop(scheme);
    return scheme;
  };
  using S = Scheme<double>;
  const Mesh open = grid(3, 3);
  expect_refused(without([](S& s) { s.steps[0].masks.vertex = {}; }), open,
                 {"own lacks the mask vertex", "split pqq", "points of vertices", "steps[0]"});
  expect_refused(without([](S& s) { s.steps[0].masks.edge = {}; }), open, {"own lacks the mask edge or wide_edge"});
  expect_refused(without([](S& s) { s.steps[0].masks.face = {}; }), open, {"own lacks the mask face or wide_face"});
  expect_refused(without([](S& s) { s.creases = {}; }), open, {"own lacks the mask crease_vertex"});
  expect_refused(without([](S& s) { s.creases.edge = {}; }), open, {"own lacks the mask crease_edge"});
  expect_refused(without([](S& s) { s.steps[0].split = Split::dqq; }), open,
                 {"own lacks the mask corner", "split dqq"});
  expect_refused(without([](S& s) { s.steps.push_back({.split = Split::dual, .masks = {}}); }), open,
                 {"own lacks the mask face", "steps[1]"});
  expect_refused(without([](S& s) {
                   s.corners = 4;
                   s.preparation = {{.split = Split::quads, .masks = {}}};
                 }),
                 open, {"own lacks the mask vertex", "preparation[0]"});
}

TEST(CheckedSchemes, HaveNumbersThatFitTogether) {
  Scheme<double> scheme = own();
  scheme.period = 0;
  expect_refused(scheme, cube(), {"own: period is 0"});
  scheme = own();
  scheme.corners = 2;
  expect_refused(scheme, cube(), {"own: corners is 2"});
  scheme = own();
  scheme.preparation = scheme.steps;
  expect_refused(scheme, cube(), {"own has steps of preparation"});
}

TEST(CheckedSchemes, HaveAffineMasks) {
  Scheme<double> scheme = own();
  scheme.steps[0].masks.edge = [](const EdgeSite<double>& e) { return 0.55 * (e.tail() + e.head()); };
  expect_refused(scheme, cube(), {"own.edge: the weights add up to 1.1"});
  scheme = own();
  scheme.steps[0].masks.vertex = [](const Ring<double>& v) { return v.center() - v.neighbor_mean(); };
  expect_refused(scheme, cube(), {"own.vertex: the weights add up to "});
  scheme = own();
  scheme.steps[0].masks.face = [](const FaceSite<double>& f) { return std::nan("") * f.corner(0); };
  expect_refused(scheme, cube(), {"the weights add up to nan"});
  scheme = own();
  scheme.creases.edge = [](const CreaseEdgeSite<double>& e) { return e.tail() + e.head(); };
  expect_refused(scheme, grid(3, 3), {"own.crease_edge: the weights add up to 2"});
  scheme = own();
  scheme.creases.vertex = [](const CreaseSite<double>& v) { return v.before() + v.after(); };
  expect_refused(scheme, grid(3, 3), {"own.crease_vertex: the weights add up to 2"});
  Scheme<double> wide = *find_scheme("butterfly");
  wide.name = "own-butterfly";
  wide.steps[0].masks.wide_edge = [](const WideEdgeSite<double>& e) { return e.tail() + e.head() / 10; };
  expect_refused(wide, icosahedron(), {"own-butterfly.wide_edge: the weights add up to 1.1"});
}

TEST(CheckedSchemes, MayHaveLargeWeightsThatCancel) {
  Scheme<double> scheme = own();
  scheme.steps[0].masks.face = [](const FaceSite<double>& f) {
    return f.centroid() + 1e9 / 3 * (f.corner(0) - f.corner(1)) + 1e9 / 7 * (f.corner(1) - f.corner(0));
  };
  EXPECT_NO_THROW(refine(scheme, cube(), 1));
}

TEST(CheckedSchemes, UsePointsOfTheirSiteAlone) {
  Scheme<double> scheme = own();
  scheme.steps[0].masks.face = [](const FaceSite<double>&) { return Stencil<double>(4); };
  expect_refused(scheme, cube(), {"own.face returns points of another site", "slot 4", "the site has 4"});
  scheme.steps[0].masks.face = [](const FaceSite<double>&) { return Stencil<double>(-1); };
  expect_refused(scheme, cube(), {"returns points of another site", "slot -1"});
}

TEST(Sites, FacesHaveTheirCornersAndNoOthers) {
  const Masks<double> masks;
  const FaceSite<double> triangle(masks, 0, {5, 7, 9});
  EXPECT_EQ(triangle.corner(-1).terms()[0].first, 9);
  EXPECT_EQ(triangle.corner(-3).terms()[0].first, 5);
  for (const int i : {3, -4}) {
    expect_error<InvalidParameter>([&] { triangle.corner(i); },
                                   {"corner " + std::to_string(i) + " of a face of 3; 0 to 2 exist"});
    expect_error<InvalidParameter>([&] { triangle.knots(i); }, {"0 to 2 exist"});
    expect_error<InvalidParameter>([&] { triangle.knots_to_next(i); }, {"0 to 2 exist"});
    expect_error<InvalidParameter>([&] { triangle.knots_to_previous(i); }, {"0 to 2 exist"});
  }
  expect_error<InvalidParameter>([&] { triangle.point(); }, {"no mask `face`"});
}

TEST(Sites, OpenRingsEnd) {
  const Masks<double> masks;
  // Edges -1, 0, 1 and 2 of two faces before and one behind edge 0.
  const Ring<double> ring(masks, 0, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}, false, 1);
  for (const int i : {-1, 0, 1, 2}) EXPECT_EQ(ring.neighbor(i).terms()[0].first, i + 2);
  for (const int i : {-2, 3}) {
    EXPECT_FALSE(ring.has_neighbor(i));
    expect_error<InvalidParameter>([&] { ring.neighbor(i); }, {"edge " + std::to_string(i), "-1 to 2 exist"});
  }
  for (const int i : {-2, 2}) expect_error<InvalidParameter>([&] { ring.face(i); }, {"face", "-1 to 1 exist"});
  expect_error<InvalidParameter>([&] { ring.diagonal(0); }, {"diagonal of face 0", "3 corners"});
  expect_error<InvalidParameter>([&] { ring.neighbor_mean(); }, {"open ring"});
  expect_error<InvalidParameter>([&] { ring.face_centroid_mean(); }, {"open ring"});
  const Ring<double> quads(masks, 0, {{0, 1, 2, 3}, {0, 3, 4, 1}}, true, 0);
  EXPECT_EQ(quads.neighbor(7).terms()[0].first, quads.neighbor(-1).terms()[0].first) << "closed ones go round";
  expect_error<InvalidParameter>([&] { quads.continued(0); }, {"4 corners", "triangles"});
}

TEST(Sites, WideFacesHaveTheirEdgesAndNoOthers) {
  const Masks<double> masks;
  const std::vector<FanShape> open(4, FanShape{1, 0});  // a quadrilateral alone
  const WideFaceSite<double> face(masks, 0, open);
  EXPECT_FALSE(face.has_across(-1));
  for (const int i : {4, -5}) {
    expect_error<InvalidParameter>([&] { face.corner(i); }, {"0 to 3 exist"});
    expect_error<InvalidParameter>([&] { face.ring(i); }, {"0 to 3 exist"});
    expect_error<InvalidParameter>([&] { face.has_across(i); }, {"0 to 3 exist"});
    expect_error<InvalidParameter>([&] { face.edge_point(i); }, {"0 to 3 exist"});
  }
  expect_error<InvalidParameter>([&] { face.edge_point_beyond(0); }, {"no face across"});
}

}  // namespace
}  // namespace sublimit::testing
