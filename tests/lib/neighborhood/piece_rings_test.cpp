// SPDX-License-Identifier: Apache-2.0
// How far pieces reach is computed from the masks, of schemes of a user's own too.
#include "sublimit/neighborhood/piece_rings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "laws/tested_schemes.h"
#include "meshes/irregular_meshes.h"
#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/neighborhood/piece_walk.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::testing {
namespace {

/// Sums of weights in another order, over a few levels.
constexpr double other_order = 1e-12;

/// Each mask takes all that its site has: the points of faces are made of the edge points around them, and these of the
/// rings at both ends. Then vertices are moved by the faces around them. No scheme of the library reaches so far.
Scheme<double> far_reaching() {
  using T = double;
  const auto middle = [](const auto& e) { return (e.tail() + e.head()) / 2; };
  const auto between = [](const CreaseSite<T>& v) { return (v.before() + 2 * v.center() + v.after()) / 4; };
  const auto around = [](const Ring<T>& v) {
    return v.is_closed() ? (v.neighbor_mean() + v.face_centroid_mean()) / 2 : v.center();
  };
  const Step<T> wide{.split = Split::pqq,
                     .masks = {.vertex = [=](const Ring<T>& v) { return (v.center() + around(v)) / 2; },
                               .wide_edge =
                                   [=](const WideEdgeSite<T>& e) {
                                     return (e.tail() + e.head() + around(e.tail_ring()) + around(e.head_ring())) / 4;
                                   },
                               .wide_face =
                                   [=](const WideFaceSite<T>& f) {
                                     Stencil<T> sum;
                                     for (int i = 0; i < 4; ++i)
                                       sum += f.corner(i) + around(f.ring(i)) + f.edge_point(i) +
                                              (f.has_across(i) ? f.edge_point_beyond(i) : f.edge_point(i));
                                     return sum / 16;
                                   }},
                     .creases = {.vertex = between, .edge = middle}};
  const Step<T> smooth{.split = Split::keep,
                       .masks = {.vertex = [](const Ring<T>& v) { return v.face_centroid_mean(); }},
                       .creases = {.vertex = between, .edge = middle}};
  return {.name = "far",
          .source = "a test",
          .steps = {wide, smooth},
          .creases = {.vertex = between, .edge = middle},
          .sharpening = Sharpening::boundary,
          .corners = 4};
}

double difference(const LimitStencil& a, const SparseMatrix& S, const LimitStencil& b) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(S.cols());
  for (size_t i = 0; i < b.vertices.size(); ++i)
    for (SparseMatrix::InnerIterator it(S, b.vertices[i]); it; ++it)
      all[it.col()] += b.weights(0, Eigen::Index(i)) * it.value();
  for (size_t i = 0; i < a.vertices.size(); ++i) all[a.vertices[i]] -= a.weights(0, Eigen::Index(i));
  return all.cwiseAbs().maxCoeff();
}

/// The place in a face of a place in a quadrilateral piece of it.
Place place_of(const Topology& t, const Piece& piece, const PieceCoordinates& p) {
  const Face face = t.face(piece.start);
  switch (index(piece.start) - index(t.first(face))) {
    case 1:
      return {index(face), p.v1, p.u};
    case 2:
      return {index(face), p.u1, p.v1};
    case 3:
      return {index(face), p.v, p.u1};
    default:
      return {index(face), p.u, p.v};
  }
}

/// The limit of a quadrilateral is that of its children, level by level: what lies beyond the rings that a piece is
/// given would be missing in one of them.
void expect_limit_of_children(const Scheme<double>& scheme, const Mesh& mesh) {
  const std::vector<Level> levels = refine(scheme, mesh, 2);
  const LimitMap whole(scheme, mesh);
  const SparseMatrix P = refinement_matrix(levels);
  const LimitMap fine(scheme, levels[2]);
  for (Index f = 0; f < levels[0].topology().num_faces(); ++f)
    for (const PieceCoordinates& start : {quad_place(0.3, 0.45), quad_place(0.9, 0.6), quad_place(0.05, 0.95)}) {
      Piece piece{Piece::Kind::quad, levels[0].topology().first(Face{f})};
      PieceCoordinates place = start;
      for (int k = 0; k < 2; ++k) {
        std::vector<LevelStep> steps;
        for (const Refinement& step : levels[size_t(k) + 1].steps) steps.push_back({&step, k});
        const std::vector<PieceChild> all = children(piece, levels[size_t(k)].topology(), steps);
        const auto child = std::ranges::find_if(all, [&](const PieceChild& c) { return c.map.contains(place); });
        ASSERT_NE(child, all.end());
        piece = child->piece;
        place = child->map(place);
      }
      ASSERT_LT(difference(whole.stencil({f, start.u, start.v}), P,
                           fine.stencil(place_of(levels[2].topology(), piece, place))),
                other_order)
          << scheme.name << ": face " << f;
    }
  LimitCache cache(scheme);
  const SparseMatrix coarse = limit_matrices(levels[0], cache).position, L = limit_matrices(levels[2], cache).position;
  const SparseMatrix pulled = L * P;
  for (Index v = 0; v < coarse.rows(); ++v) {
    const Eigen::VectorXd rest = Eigen::VectorXd(coarse.row(v)) - Eigen::VectorXd(pulled.row(v));
    ASSERT_LT(rest.cwiseAbs().maxCoeff(), other_order) << scheme.name << ": vertex " << v;
  }
}

TEST(PieceRings, OfAUsersSchemeThatReachesFar) {
  const Scheme<double> scheme = far_reaching();
  EXPECT_GT(piece_rings(scheme), 3);
  expect_limit_of_children(scheme, torus(9, 7));
  expect_limit_of_children(scheme, quads_from_triangles(bipyramid(5)));
  expect_limit_of_children(scheme, grid(6, 5));
}

TEST(PieceRings, OfASchemeWithoutARuleForBorders) {
  Scheme<double> scheme = far_reaching();
  scheme.steps.pop_back();
  const auto closed = [](const auto& site, const Ring<double>& ring) {
    if (!ring.is_closed()) throw InvalidParameter("no rule for borders");
    return site;
  };
  const auto edge = scheme.steps[0].masks.wide_edge;
  scheme.steps[0].masks.wide_edge = [=](const WideEdgeSite<double>& e) { return edge(closed(e, e.tail_ring())); };
  const auto face = scheme.steps[0].masks.wide_face;
  scheme.steps[0].masks.wide_face = [=](const WideFaceSite<double>& f) { return face(closed(f, f.ring(0))); };
  EXPECT_GT(piece_rings(scheme), 2);
  expect_limit_of_children(scheme, torus(9, 7));
}

// Two faces back to back, once by themselves, once with other faces at one of their edges, which no vertex opposite
// sees.
TEST(PieceRings, TellFacesApartThatShareAllPointsButNotAnEdge) {
  const Mesh alone = make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}}, {{0, 1, 2, 3}, {3, 2, 1, 0}});
  const Mesh joined =
      make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}, {0, 0, 2}, {1, 0, 2}, {0, 0, 3}, {1, 0, 3}},
                {{0, 1, 2, 3}, {3, 2, 1, 0}, {0, 1, 5, 4}, {1, 0, 6, 7}});
  const Mesh both = disjoint_union(joined, alone);
  for (const char* name : {"mid-edge", "mid-edge-habib-warren", "doo-sabin", "averaging", "catmull-clark"}) {
    const Scheme<double> scheme = *find_scheme(name);
    const LimitMap of_both(scheme, both), of_alone(scheme, alone);
    for (const double u : {0.0, 0.3, 1.0})
      for (const double v : {0.0, 0.6, 1.0}) {
        for (Index face = 0; face < 4; ++face) (void)of_both.stencil({face, u, v});  // their types are there first
        for (const Index face : {0, 1}) {
          const LimitStencil with = of_both.stencil({4 + face, u, v}), without = of_alone.stencil({face, u, v});
          ASSERT_EQ(with.vertices.size(), without.vertices.size()) << name;
          for (size_t i = 0; i < with.vertices.size(); ++i) {
            EXPECT_EQ(with.vertices[i], without.vertices[i] + joined.num_vertices()) << name;
            EXPECT_NEAR(with.weights(0, Eigen::Index(i)), without.weights(0, Eigen::Index(i)), other_order) << name;
          }
        }
      }
  }
}

TEST(PieceRings, AreThoseOfTheSupport) {
  // The points of a face after some levels depend on nothing else.
  for (const TestedScheme& tested : schemes_and_degrees()) {
    const Scheme<double> scheme = tested.scheme();
    if (scheme.is_dual() || scheme.period > 1) continue;
    const int rings = piece_rings(scheme);
    const Mesh mesh = takes_triangles(scheme) ? triangle_torus(13, 12) : torus(13, 12);
    const std::vector<Level> levels = refine(scheme, mesh, 2 * scheme.period);
    const SparseMatrix P = refinement_matrix(levels);
    PieceWalker walker;
    const Topology& t = levels[0].topology();
    const Piece piece{takes_triangles(scheme) ? Piece::Kind::triangle : Piece::Kind::quad, t.first(Face{0})};
    std::vector<Index> points = walker.walk(t, levels[0].sharpness, piece, rings, 0).vertices;
    std::sort(points.begin(), points.end());
    const Topology& fine = levels.back().topology();
    for (Index f = 0; f < fine.num_faces(); ++f) {
      Index parent = f;
      for (size_t k = levels.size(); k-- > 1;)
        for (auto step = levels[k].steps.rbegin(); step != levels[k].steps.rend(); ++step)
          parent = step->face_parent[parent];
      if (parent != 0) continue;
      for (const Index v : fine.vertices(Face{f}))
        for (SparseMatrix::InnerIterator it(P, v); it; ++it)
          if (it.value() != 0) {
            ASSERT_TRUE(std::binary_search(points.begin(), points.end(), Index(it.col()))) << scheme.name;
          }
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
