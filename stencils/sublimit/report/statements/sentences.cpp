// SPDX-License-Identifier: Apache-2.0
// The table: where a sentence stands, what it says, what is right, and the experiment. No verdict is written here.
#include "sublimit/certificates/exact_schemes.h"
#include "sublimit/report/statements/curves.h"
#include "sublimit/report/statements/meshes.h"
#include "sublimit/report/statements/misreadings.h"
#include "sublimit/report/statements/patches.h"
#include "sublimit/report/statements/regular.h"
#include "sublimit/report/statements/small_meshes.h"
#include "sublimit/report/statements/spectra.h"
#include "sublimit/report/statements/splines.h"
#include "sublimit/report/statements/statements.h"

namespace sublimit::report {
namespace {

const std::vector<int> valences = {3, 4, 5, 6, 7, 8}, few = {3, 5, 8};  // few: where maps have to be sampled

Scheme<Algebraic> exact(const char* name) { return find_scheme<Algebraic>(name).value(); }
const Directions box222 = {{1, 0}, {1, 0}, {0, 1}, {0, 1}, {-1, 1}, {-1, 1}};

/// A rule of misreadings.h in both numbers.
#define SUBLIMIT_MISREAD(rule) both_of(misread::rule<double>(), misread::rule<Algebraic>())

Finding regular_and_extraordinary(const char* name, const Directions& directions, int k) {
  return both(is_smooth_box_spline(exact(name), directions, k), is_c1(reported_scheme(name), valences));
}

/// C^k, and C^1 at extraordinary points.
Finding smooth(const char* name, int k) {
  return both(is_regularly_smooth(exact(name), k), is_c1(reported_scheme(name), few));
}

Finding kobbelt_ways(Ratio r) {
  Finding lone =
      same_rule(misread::kobbelt_one_way<Algebraic>(0, r), misread::kobbelt_one_way<Algebraic>(1, r), few, 2);
  Finding cube = same_points(misread::kobbelt_one_way<double>(0, r), misread::kobbelt_one_way<double>(1, r), prism(4));
  const Fate fates[] = {lone.fate, cube.fate};
  Finding f = both(std::move(lone), cube);
  f.fate = fates[0] == fates[1] ? fates[0] : Fate::depends;
  return f;
}

const std::vector<Statement> sentences = {
    // Masks of surfaces, and what their spectra say.
    {"lecture notes 000, sqrt(3)", "sqrt(3) interpolates: centroids of triangles, flipped edges, nothing else",
     "old vertices are relaxed with (4 - 2 cos(2 pi/n))/9, so the scheme approximates; without that each is a spike",
     [] { return is_c1(SUBLIMIT_MISREAD(sqrt3_without_relaxation), valences); }},
    {"lecture notes 000, table", "sqrt(3) is C^2, and C^1 at extraordinary vertices", "so with relaxation",
     [] { return smooth("sqrt3", 2); }},
    {"lecture notes 000, Doo-Sabin", "a new point is the midpoint of vertex and centroid",
     "it is the mean of vertex, centroid and two edge midpoints, or has the weights with cosines",
     [] { return is_c1(SUBLIMIT_MISREAD(doo_sabin_halfway), valences); }},
    {"lecture notes 000, Doo-Sabin", "the new point is a sum over i = 0 ... n",
     "over i = 0 ... n - 1: a face has n corners",
     [] { return is_affine(misread::doo_sabin_with_one_term_more<Algebraic>(), valences); }},
    {"lecture notes 000, table", "Doo-Sabin is C^0 only at extraordinary points", "C^1 there too",
     [] { return denied(is_c1(reported_scheme("doo-sabin"), valences)); }},
    {"lecture notes 003, Doo-Sabin", "C^1 at singular points", "",
     [] { return is_c1(reported_scheme("doo-sabin"), valences); }},
    {"lecture notes 003, Doo-Sabin", "weights (K + 5)/(4K) and (3 + 2 cos(2 pi (i - j)/K))/(4K)", "",
     [] {
       return both(is_affine(exact("doo-sabin"), valences), is_box_spline(exact("doo-sabin"), tensor_directions(2)));
     }},
    {"lecture notes 002, Doo-Sabin", "a new point is the mean of vertex, centroid and two edge midpoints",
     "the weights of repeated averaging",
     [] {
       return both(same_rule(misread::doo_sabin_mean_of_four<Algebraic>(), exact("doo-sabin-averaging"), valences),
                   is_c1(SUBLIMIT_MISREAD(doo_sabin_mean_of_four), valences));
     }},
    {"lecture notes 002, Doo-Sabin", "that mean has the weights with cosines of Doo and Sabin",
     "for quadrilaterals only",
     [] { return same_rule(misread::doo_sabin_mean_of_four<Algebraic>(), exact("doo-sabin"), valences); }},
    {"lecture notes 004, Doo-Sabin", "G^1, and centroids of faces are fixed points", "",
     [] { return both(keeps_centroids(exact("doo-sabin"), valences), is_c1(reported_scheme("doo-sabin"), valences)); }},
    {"lecture notes 000, mid-edge", "two mid-edge steps are one step of Doo-Sabin",
     "the same faces, other points: weights 1/4, 1/2, 1/4 on three corners, and another limit",
     [] { return same_regular_mask(exact("mid-edge"), exact("doo-sabin")); }},
    {"lecture notes 000, mid-edge", "edge points at extraordinary places are joined with centroids of faces",
     "no such rule is needed, and read as half of the way it takes the tangent plane away",
     [] {
       return is_c1(SUBLIMIT_MISREAD(mid_edge_with_centroids), {5, 6, 7, 8});
     }},
    {"lecture notes 000, mid-edge", "C^1 everywhere",
     "n = 3 is a Jordan case: the tangent plane is reached, but slowly, and the criterion does not apply",
     [] { return is_c1(reported_scheme("mid-edge"), valences); }},
    {"lecture notes 000, Catmull-Clark", "R is the mean of the midpoints of old edges", "",
     [] {
       return same_rule(misread::catmull_clark_with_old_midpoints<Algebraic>(), exact("catmull-clark"), valences);
     }},
    {"lecture notes 002 and 004, Catmull-Clark", "R is the mean of the new edge points",
     "of the midpoints of the old edges; else regular meshes give no bicubic B-spline",
     [] { return is_box_spline(misread::catmull_clark_with_new_edge_points<Algebraic>(), tensor_directions(3)); }},
    {"lecture notes 000, Catmull-Clark", "3/(2n) and 1/(4n) for neighbours and diagonals", "for all of them together",
     [] { return same_rule(misread::catmull_clark_by_totals<Algebraic>(), exact("catmull-clark"), valences); }},
    {"lecture notes 000, table", "Catmull-Clark is C^2, and C^1 at extraordinary points", "",
     [] { return regular_and_extraordinary("catmull-clark", tensor_directions(3), 2); }},
    {"lecture notes 000, Loop", "beta = 5/8 - (3/8 + cos(2 pi/n)/4)^2 is the weight of the ring", "",
     [] { return regular_and_extraordinary("loop", box222, 2); }},
    {"lecture notes 000, Loop", "beta is to be divided by n once more", "it is the weight of all neighbours together",
     [] { return is_c1(SUBLIMIT_MISREAD(loop_divided_twice), valences); }},
    {"lecture notes 000, butterfly", "the mask is over eight points around a vertex", "around an edge; vertices stay",
     [] { return vertex_mask_has_points(exact("butterfly"), 8); }},
    {"lecture notes 000, butterfly", "C^1 except at extraordinary vertices", "it fails at n = 3 and n >= 8 only",
     [] {
       return denied(is_c1(reported_scheme("butterfly"), {3, 4, 5, 7, 8, 9}));
     }},
    {"lecture notes 000, modified butterfly", "the formula for valences k >= 5 serves k = 6 too",
     "at k = 6 the mask is the butterfly's: the formula gives the ten-point mask with t = -1/48",
     [] { return same_regular_mask(misread::modified_butterfly_with_one_formula<Algebraic>(), exact("butterfly")); }},
    {"lecture notes 000, modified butterfly", "C^1, at extraordinary vertices too", "",
     [] { return smooth("modified-butterfly", 1); }},
    {"lecture notes 000, Kobbelt", "C^1, and C^1 at extraordinary vertices", "for tension 1, with virtual points",
     [] { return smooth("kobbelt", 1); }},
    {"lecture notes 000, Kobbelt", "both ways of making a face point agree",
     "on regular nets and around a lone extraordinary vertex; between several they differ",
     [] {
       return kobbelt_ways({1, 9});
     }},
    {"in circulation, Kobbelt", "virtual points have diagonals with r = g/(4 + g)",
     "r = g/(8 + g): else the two ways differ around every extraordinary vertex",
     [] {
       return same_rule(misread::kobbelt_one_way<Algebraic>(0, {1, 5}), misread::kobbelt_one_way<Algebraic>(1, {1, 5}),
                        few, 2);
     }},
    {"lecture notes 000, Kobbelt", "face points are made of the edge points (2i+1, j)", "of those with index 2j",
     [] { return face_point_uses_rows(1); }},

    // Steps, meshes, borders.
    {"lecture notes 000, mid-edge, Doo-Sabin, Catmull-Clark", "these are schemes for quadrilateral meshes",
     "they take any polygons",
     [] {
       return need_quads({"mid-edge", "doo-sabin", "catmull-clark"});
     }},
    {"lecture notes 003, Doo-Sabin", "the number of other polygons stays the same from the second step on",
     "from the first step on", [] { return polygons_stay_from("doo-sabin", 2); }},
    {"lecture notes 003, Doo-Sabin", "a V-face joins four new vertices",
     "as many as the valence of its old vertex has faces", [] { return vertex_faces_have_four_corners("doo-sabin"); }},
    {"lecture notes 000", "regular border vertices of quadrilateral meshes have valence 3", "corners excepted",
     [] { return border_vertices_have_edges(3); }},
    {"lecture notes 000", "B-splines describe objects with the topology of a sphere only",
     "planes, cylinders and tori; a sphere has no regular net", [] { return only_spheres_are_regular(); }},
    {"lecture notes 000, modified butterfly", "borders: three old vertices and a virtual one",
     "one of two usable rules: with the four-point rule the border curve does not depend on the inside",
     [] {
       Finding virtual_vertex = border_depends_on_inside("virtual-vertex");
       const Finding four_point = border_depends_on_inside("four-point");
       const bool differ = virtual_vertex.fate != four_point.fate;
       Finding f = both(std::move(virtual_vertex), four_point);
       if (differ) f.fate = Fate::depends;
       return f;
     }},
    {"texts on Catmull-Clark", "borders have a tangent plane whatever the number of faces at a vertex",
     "up to 4 faces for generic points (4: reached slowly)",
     [] {
       return has_border_planes(exact("catmull-clark"), {1, 2, 3, 4, 5, 6});
     }},
    {"texts on Loop", "borders have a tangent plane whatever the number of faces at a vertex",
     "up to 6 faces for generic points (6: reached slowly)",
     [] {
       return has_border_planes(exact("loop"), {2, 3, 4, 5, 6, 7, 8});
     }},
    {"lecture notes 004, Catmull-Clark", "interpolation has a formulation that is not singular",
     "with more control points; one for each vertex is singular on the cube",
     [] {
       return interpolation_is_solvable({{"cube", prism(4)}, {"torus", torus(6, 8)}}, "catmull-clark");
     }},

    // Curve schemes.
    {"lecture notes 000, four-point", "C^1 for tensions from 0 to 2 (sqrt(5) - 1) = 2.472", "",
     [] {
       return four_point_is_c1({{1, 4}, {1, 2}, {1, 1}, {3, 2}, {2, 1}, {247, 100}});
     }},
    {"lecture notes 000, four-point", "not C^1 for greater tensions", "C^1 up to 3.0837",
     [] {
       return denied(four_point_is_c1({{5, 2}, {27, 10}, {29, 10}}));
     }},
    {"lecture notes 000, Lane-Riesenfeld", "midpoints inserted, then n averagings: degree n + 1",
     "counted from doubled points, n averagings give degree n", [] { return averagings_give_degree(1); }},
    {"lecture notes 000, Hermite scheme", "the incentre scheme is G^1", "and its limit is a biarc on every leg",
     [] { return is_g1(hermite_incentre({})); }},

    // B-splines, Bezier curves, patches.
    {"lecture notes 001, splines", "a spline of degree n has pieces of degree n - 1", "of order n: degree n - 1",
     [] { return pieces_have_degree(-1); }},
    {"lecture notes 001, Cox-de Boor", "the first factor falls from 1 to 0, the second one rises",
     "the first rises, the second falls", [] { return first_factor(false); }},
    {"lecture notes 001, B-splines", "a basis function of degree n is given by n knots", "by n + 2",
     [] { return one_function_has_knots(0); }},
    {"lecture notes 001, B-splines", "basis functions sum to 1", "where degree + 1 of them are not zero",
     [] { return functions_sum_to_one(true); }},
    {"lecture notes 001 and 002, B-splines", "degree k is C^(k-1) everywhere",
     "at simple knots; C^(k-r) at a knot of multiplicity r",
     [] {
       return continuous_at_knots({1, 2, 3});
     }},
    {"lecture notes 001, Coons cubic", "a name from Coons patches, which go through their border",
     "the segment of the uniform cubic B-spline", [] { return coons_cubic_interpolates(); }},
    {"lecture notes 001, G^n", "a factor of tangents other than zero is enough", "a positive factor: else it is a cusp",
     [] {
       Finding ahead = joint_is_g2(.5);
       const Finding back = joint_is_g2(-1);
       const bool differ = ahead.fate != back.fate;
       Finding f = both(std::move(ahead), back);
       if (differ) f.fate = Fate::depends;
       return f;
     }},
    {"lecture notes 001, Bezier", "G^0: tangent vectors at the joint are dependent",
     "that is G^1; G^0 is a common point", [] { return continuity_needs_dependent_tangents(); }},
    {"lecture notes 001, invariance", "what curves are invariant to are linear maps",
     "affine ones, and projective ones if rational", [] { return only_linear_maps_commute(); }},
    {"lecture notes 001, Lagrange patch", "P(u_k, u_l) = P_kl", "P(u_k, v_l) = P_kl: each direction has its nodes",
     [] { return lagrange_patch_interpolates(true); }},
    {"lecture notes 002, Hermite patch", "approximates", "interpolates its corners",
     [] { return hermite_patch_approximates(); }},
    {"lecture notes 002, Hermite patch", "four twist vectors at each corner", "one at each corner, four in all",
     [] { return twists_at_a_corner(4); }},
};

#undef SUBLIMIT_MISREAD

}  // namespace

std::span<const Statement> all_statements() { return sentences; }

}  // namespace sublimit::report
