// SPDX-License-Identifier: Apache-2.0
#pragma once
// Experiments on refined meshes: what steps make of faces and vertices, borders, interpolation.
#include "sublimit/report/statements/finding.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit::report {

/// "These schemes take meshes of quadrilaterals only."
Finding need_quads(const std::vector<std::string>& schemes);

/// "The number of faces that are no quads stays the same from step `step` on, not before."
Finding polygons_stay_from(const std::string& scheme, int step);

/// "The new face of an old vertex has four corners." Of Doo-Sabin splits.
Finding vertex_faces_have_four_corners(const std::string& scheme);

/// "Vertices of a regular border have `edges` edges", on an open grid of quads.
Finding border_vertices_have_edges(int edges);

/// "Of closed surfaces only spheres have regular nets": a torus and a cube, counted.
Finding only_spheres_are_regular();

/// "The border curve depends on points inside", one finding for each rule of the modified butterfly.
Finding border_depends_on_inside(const std::string& rule);

/// "Any control mesh's points are the limit points of some control points of the same mesh."
Finding interpolation_is_solvable(const std::vector<std::pair<std::string, ControlMesh>>& meshes,
                                  const std::string& scheme);

/// "Both rules make the same points of a mesh that has been refined once." The second decides where they do not.
Finding same_points(const Scheme<double>& a, const Scheme<double>& b, const ControlMesh& mesh);

}  // namespace sublimit::report
