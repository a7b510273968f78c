// SPDX-License-Identifier: Apache-2.0
// Schemes that the library does not have get limit surfaces like any other: with polynomials where there are some, and
// without where masks make none.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "laws/limits_at_thirds.h"
#include "meshes/hard_meshes.h"
#include "meshes/meshes.h"
#include "meshes/places.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/cubic_bspline_creases.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Catmull-Clark's masks on regular meshes, but for what the vertex keeps: bicubic if that is 9/16, and else no
/// polynomial.
Scheme<double> leaning(double center) {
  return {.name = "leaning",
          .source = "here",
          .steps = {Step<double>{
              .split = Split::pqq,
              .masks = {.vertex =
                            [=](const Ring<double>& v) {
                              // Six of the neighbours to one of the diagonals.
                              return center * v.center() +
                                     (1 - center) / 7 *
                                         (4 * v.neighbor_mean() + 4 * v.face_centroid_mean() - v.center());
                            },
                        .edge =
                            [](const EdgeSite<double>& e) {
                              return (e.tail() + e.head() + e.left_face().point() + e.right_face().point()) / 4;
                            },
                        .face = [](const FaceSite<double>& f) { return f.centroid(); }}}},
          .creases = cubic_bspline_creases<double>(),
          .claims = {.regular = 1, .extraordinary = 1, .limit = "whatever it is"}};
}

RowMatrix dense(const LimitMap& surface, const Place& s, int order = 0) {
  const LimitStencil stencil = surface.stencil(s, order);
  RowMatrix rows = RowMatrix::Zero(stencil.weights.rows(), surface.level().topology().num_vertices());
  for (size_t j = 0; j < stencil.vertices.size(); ++j) rows.col(stencil.vertices[j]) = stencil.weights.col(Index(j));
  return rows;
}

double norm1(const RowMatrix& row) { return row.cwiseAbs().sum(); }

/// L_k P_k at the vertices of level k that lie at multiples of 2^-k in a square, against stencils there.
void expect_dyadic_limits(const Scheme<double>& scheme, const Mesh& mesh, int k, int stride) {
  const LimitMap surface(scheme, mesh);
  const std::vector<Level> levels = refine(scheme, mesh, k);
  LimitCache cache(scheme);
  const SparseMatrix limits = limit_matrices(levels[size_t(k)], cache).position * refinement_matrix(levels);
  const Topology& t = surface.level().topology();
  const bool triangles = surface.addresses().triangles();
  for (Index i = 0; i < t.num_half_edges(); i += stride) {
    const HalfEdge corner{i};
    const bool quad = t.size(t.face(corner)) == 4;
    // From a corner along its edge, k times to the first half: 2^-k of the edge away.
    HalfEdge h = corner;
    for (int j = 0; j < k; ++j) h = levels[size_t(j) + 1].steps[0].halves(levels[size_t(j)].topology(), h).first;
    const Topology& fine = levels[size_t(k)].topology();
    const HalfEdge next = fine.next(h), last = fine.next(next);
    const double d = std::ldexp(quad || triangles ? 1.0 : 2.0, -k);
    const auto expect_limit = [&](Vertex v, double a, double b) {
      const RowMatrix x = dense(surface, from_corner(t, surface.addresses(), corner, a, b)),
                      y = RowMatrix(limits.row(index(v)));
      EXPECT_LE(norm1(x - y), reference * norm1(y)) << scheme.name << ", corner " << i << " + " << a << ", " << b;
    };
    expect_limit(fine.tail(h), 0, 0);
    expect_limit(fine.tail(next), d, 0);
    expect_limit(fine.tail(last), triangles ? 0 : d, d);
    if (!triangles) expect_limit(fine.head(last), 0, d);
  }
}

TEST(OwnScheme, WithPolynomialsIsCatmullClarkOnRegularMeshes) {
  const Mesh mesh = torus(7, 6);
  const LimitMap own(leaning(9.0 / 16), mesh), known(find_scheme("catmull-clark").value(), mesh);
  for (const Place& s : random_places(own.addresses(), 30, 1)) {
    const RowMatrix x = dense(own, s, 2), y = dense(known, s, 2);
    ASSERT_EQ(x.rows(), 6);
    for (int k = 0; k < 6; ++k) EXPECT_LE(norm1(x.row(k) - y.row(k)), eigen(10) * norm1(y.row(k)));
  }
}

TEST(OwnScheme, WithoutPolynomialsEqualsRefinementAndLimitMasks) {
  for (const double center : {0.5, 0.55, 0.6}) {
    const auto types = std::make_shared<LimitCache>(leaning(center));
    const LimitMap surface(leaning(center), torus(7, 6), {}, types);
    surface.stencil({0, 0.25, 0.375}, 1);
    EXPECT_TRUE(types->pieces().has_no_polynomials());
    expect_dyadic_limits(leaning(center), hard_polygons(1), 3, 5);
    expect_dyadic_limits(leaning(center), hard_polygons(2, {.open = true, .semi_sharp = true}), 3, 5);
  }
}

TEST(OwnScheme, OfManyStepsIsTheRegisteredOneOfTheSameMasks) {
  Scheme<double> quintic = find_scheme("averaging", {{"degree", "5"}}).value();
  quintic.name = "my-quintic";
  quintic.claims = {};
  const Mesh mesh = hard_polygons(1, {.open = true});
  const LimitMap own(quintic, mesh), known(find_scheme("averaging", {{"degree", "5"}}).value(), mesh);
  for (const Place& s : random_places(own.addresses(), 12, 1)) {
    const RowMatrix x = dense(own, s), y = dense(known, s);
    EXPECT_LE(norm1(x - y), eigen(10) * norm1(y));
  }
}

TEST(NonPolynomialLimits, AtDyadicPlacesEqualRefinementAndLimitMasks) {
  for (const char* name : {"butterfly", "modified-butterfly"})
    for (const bool open : {false, true})
      expect_dyadic_limits(find_scheme(name).value(), hard_triangles(1, {.open = open}), 3, 17);
  Mesh quads = quads_from_triangles(hard_triangles(1));
  expect_dyadic_limits(find_scheme("kobbelt").value(), quads, 3, 17);
}

/// Of dyadic places ever nearer to a place the limits come to that of the place.
TEST(NonPolynomialLimits, ConvergeAtRandomPlaces) {
  std::vector<std::pair<Scheme<double>, Mesh>> cases;
  for (const char* name : {"butterfly", "modified-butterfly", "sqrt3", "interpolatory-sqrt3"})
    cases.emplace_back(find_scheme(name).value(), hard_triangles(1));
  cases.emplace_back(find_scheme("kobbelt").value(), hard_polygons(1));
  cases.emplace_back(leaning(0.55), hard_polygons(1));
  for (const auto& [scheme, mesh] : cases) {
    const LimitMap surface(scheme, mesh);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.05, 0.45);
    for (int i = 0; i < 5; ++i) {
      const Place s{Index(random() % std::uint32_t(surface.addresses().size())), unit(random), unit(random)};
      const RowMatrix x = dense(surface, s);
      for (const int k : {6, 12, 24, 48}) {
        const double steps = std::ldexp(1.0, k);
        const RowMatrix y = dense(surface, {s.face, std::floor(s.u * steps) / steps, std::floor(s.v * steps) / steps});
        EXPECT_LE(norm1(x - y), 40 / steps + eigen(10)) << scheme.name << " " << s.face << " " << k;
      }
    }
  }
}

TEST(NonPolynomialLimits, AtTriadicPlacesEqualRefinementAndLimitMasks) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto of_triangles = [&](const std::vector<std::vector<Index>>& triangles) {
    std::vector<Eigen::Vector3d> points(5);
    for (Eigen::Vector3d& x : points) x = {unit(random), unit(random), unit(random)};
    return make_mesh(points, triangles);
  };
  const Mesh meshes[] = {hard_triangles(1),
                         hard_triangles(2, {.open = true}),
                         of_triangles({{0, 1, 2}}),                         // borders all around
                         of_triangles({{0, 1, 2}, {2, 1, 3}}),              // two each
                         of_triangles({{0, 1, 2}, {2, 1, 0}}),              // one neighbour, three times
                         of_triangles({{0, 1, 2}, {1, 0, 2}, {2, 1, 3}}),   // and twice
                         of_triangles({{0, 1, 0}, {0, 0, 2}}),              // glued to itself
                         of_triangles({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),   // three at an edge
                         of_triangles({{0, 1, 2}, {0, 3, 4}, {1, 0, 3}}),   // two fans at a vertex
                         of_triangles({{0, 1, 2}, {0, 2, 1}, {1, 2, 3}})};  // wound against each other
  for (const char* name : {"sqrt3", "interpolatory-sqrt3"})
    for (size_t i = 0; i < std::size(meshes); ++i) {
      const Scheme<double> scheme = find_scheme(name).value();
      EXPECT_EQ(wrong_at_thirds(LimitMap(scheme, meshes[i]), scheme), "") << name << " on mesh " << i;
    }
}

}  // namespace
}  // namespace sublimit::testing
