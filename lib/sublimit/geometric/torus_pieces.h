// SPDX-License-Identifier: Apache-2.0
#pragma once
// The scheme of torus pieces: triangles whose vertices have normals, principal curvatures and directions. After Valasek
// 2008 (diploma thesis, ELTE), of which only slides were published: a local surface for each point with all its data; a
// carrier along each edge; from it a new point with new data; new triangles. Old data stay. The slides leave open
// nearly all of how; the choices here, and why:
//
// Local surfaces (torus_piece.h). A torus with given k1, k2 at a point has one more parameter, the geodesic curvature g
// of its circle around; the slides take equators (g = 0) or the top circle. Here g is what suits the other end of the
// edge best, by linear least squares, so that the data of one torus give that torus, at any latitude. Either principal
// circle may be the tube. From both ends there are twelve candidates an edge: tube, which of the other end's directions
// is the one around, and g = 0.
//
// Carriers (torus_carrier.h). Each candidate is bent to the data of the other end; a carrier has the data of second
// order of both ends.
//
// Weights. All carriers are averaged with weights 1/misfit^2 of the torus piece before it is bent: data of one torus,
// sphere, cylinder or plane leave weight only for that surface, and no threshold decides. The misfit is that of the
// other end times that of the opposite corners: two ends alone may lie on two tori, as those on an equator do, which is
// the tube of another. Further factors (torus_edge.cpp) prefer what is tame: pieces that wind little between the ends.
//
// New points. The slides evaluate a rational biquadratic patch at (1/2, 1/2). A patch between the ends' parameters
// depends, on a sphere, on the arbitrary directions, and degenerates along principal circles. Here it is the place of
// the torus piece nearest to the middle of the edge, seen as two arcs with the ends' angles, with the normal and second
// form that the piece has there, plus those of the bend: what the patch around that place would give at its middle,
// which the tests build and compare; the scheme itself needs none. Averages are
// taken of points, of normals and of second forms as tensors of space; principal data are their eigenvectors, k1 >= k2.
//
// Topology. With the new points a triangle is a hexagon. Two corners are cut off; the quadrilateral left at the third,
// corner P with edge points A, M, B, is cut along the diagonal for which the perimeters of both parts differ least: AB,
// which gives four similar triangles in the plane, or PM. Option cut=perimeter compares AB and the three PM.
// cut=regular (default) always takes AB and leaves valences alone: measured, PM leaves long edges in triangles that are
// nearly isosceles, and normals of triangles then do not approach the data's.
//
// Fall-back: the middle of the chord, flat (curvatures 0), with the mean normal or, where the ends' normals cancel,
// that of the opposite corners across the chord. It is for ends that coincide or whose normals cancel, and where no
// candidate fits better than to a slope of ten (the edge runs along a normal) or their normals cancel. Notes count such
// edges.
//
// Edges of one triangle are refined by the same rule, with one opposite corner.
//
// Rounding. What a torus piece misses by less than 1e-12 of the edge is taken for rounding and not bent to: it would
// grow with every level. Where k1 = k2 within rounding, directions are arbitrary, and where the data are not of one
// sphere so are effects of the size of the misfit.
//
// Nothing is known of continuity. Measured (fit/deviation.h) on z = x y, sin x cos y and an ellipsoid: with data twice
// as dense, positions are 10 to 45 times nearer, normals 5 to 17 times, curvatures 3 to 6 times; from level to level
// positions and normals settle, normals of triangles and of data approach each other like the edges' length, and
// deviations of curvatures grow slowly, faster in slender triangles and where the data are coarse.
#include "sublimit/geometric/curvature_mesh.h"
#include "sublimit/geometric/geometric_scheme.h"

namespace sublimit {

using GeometricSurfaceScheme = GeometricScheme<CurvatureMesh>;

/// Refined vertices: old ones in order, bitwise as they were, then one for each edge, in the order of Topology.
GeometricSurfaceScheme torus_pieces(const SchemeOptions& options);

}  // namespace sublimit
