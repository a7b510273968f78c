// SPDX-License-Identifier: Apache-2.0
// What a scheme's file claims steers nothing: smoothness and hulls come from the masks.
#include <gtest/gtest.h>

#include <algorithm>

#include "laws/laws.h"
#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "sublimit/neighborhood/regular_smoothness.h"
#include "sublimit/search/closest_point.h"

namespace sublimit::testing {
namespace {

TEST(RegularSmoothness, IsThatOfTheLiterature) {
  for (const auto& variant : scheme_names_and_options()) {
    const Scheme<double> scheme = *find_scheme(variant.first, variant.second);
    EXPECT_EQ(regular_smoothness(scheme), std::min(scheme.claims.regular, 2)) << described(variant);
  }
}

TEST(RegularSmoothness, DoesNotNeedPolynomialsNorClaims) {
  // Catmull-Clark's edge and face points around a vertex that keeps less: the limit is no spline, and no better than
  // C^1.
  Scheme<double> scheme = *find_scheme("catmull-clark");
  scheme.claims.regular = 7;
  EXPECT_EQ(regular_smoothness(scheme), 2);
  scheme.steps[0].masks.vertex = [](const Ring<double>& v) {
    return v.center() / 2 + (4 * v.neighbor_mean() + 4 * v.face_centroid_mean() - v.center()) / 14;
  };
  EXPECT_EQ(regular_smoothness(scheme), 1);
  // Faces alone, cut in four.
  scheme.steps[0].masks.vertex = [](const Ring<double>& v) { return v.center(); };
  scheme.steps[0].masks.edge = [](const EdgeSite<double>& e) { return (e.tail() + e.head()) / 2; };
  EXPECT_EQ(regular_smoothness(scheme), 0);
}

std::vector<Place> places_on(const LimitMap& surface) {
  const Topology& t = surface.level().topology();
  std::vector<Place> places = random_places(surface.addresses(), 40, 5);
  for (Index h = 0; h < t.num_half_edges(); h += 3) {
    places.push_back(from_corner(t, surface.addresses(), HalfEdge{h}, 0, 0));
    for (const double s : {0.25, 0.5, 0.71}) places.push_back(on_edge(t, surface.addresses(), HalfEdge{h}, s));
  }
  return places;
}

void expect_same(const LimitSamples& a, const LimitSamples& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.position, b.position);
  for (const auto part : {&LimitSamples::du, &LimitSamples::dv, &LimitSamples::duu, &LimitSamples::duv,
                          &LimitSamples::dvv, &LimitSamples::normal})
    EXPECT_EQ(a.*part, b.*part);
}

class ErasedClaims : public ::testing::TestWithParam<TestedScheme> {};

TEST_P(ErasedClaims, SteerNothing) {
  const Scheme<double> scheme = GetParam().scheme();
  // None at all, as users write schemes; and wrong ones.
  Claims wrong;
  wrong.regular = scheme.claims.regular == 1 ? 2 : 1;
  wrong.convex_hull = !scheme.claims.convex_hull;
  for (const Claims& claims : {Claims{}, wrong}) {
    Scheme<double> other = scheme;
    other.claims = claims;
    const Mesh mesh = hard_meshes(scheme, 11).back();
    const LimitMap surface(scheme, mesh), same(other, mesh);
    const std::vector<Place> places = places_on(surface);
    expect_same(surface.evaluate(mesh.positions, places, 2), same.evaluate(mesh.positions, places, 2));
    const auto boxes = surface.bounding_boxes(mesh.positions), same_boxes = same.bounding_boxes(mesh.positions);
    for (size_t i = 0; i < boxes.size(); ++i)
      EXPECT_TRUE(boxes[i].min() == same_boxes[i].min() && boxes[i].max() == same_boxes[i].max()) << i;
    const Points queries = 1.5 * mesh.positions.topRows(4);
    const ClosestPoints near = closest(surface, mesh.positions, queries, {.most_cells = 100}),
                        same_near = closest(same, mesh.positions, queries, {.most_cells = 100});
    EXPECT_EQ(near.points, same_near.points);
    EXPECT_EQ(near.normals, same_near.normals);
    EXPECT_EQ(near.status, same_near.status);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, ErasedClaims, ::testing::ValuesIn(schemes_and_degrees()), test_name);

}  // namespace
}  // namespace sublimit::testing
