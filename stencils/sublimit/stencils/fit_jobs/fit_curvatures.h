// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fits by schemes without a matrix: points with normals and curvatures become more of the same.
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/stencils/fit_jobs/fit_job.h"

namespace sublimit {

struct [[nodiscard]] CurvatureFit {
  CurvatureMesh given, refined;  ///< the first vertices of `refined` are those of `given`
  FitReport report;
};

/// @throws FormatError  what `check_vertices` refuses; a vertex without all its data
/// @throws InvalidMesh, UnsupportedTopology  as `curvature_mesh`: faces of five corners, edges of three faces
CurvatureFit fit_curvatures(const GeometricSurfaceScheme& scheme, const Mesh& mesh, const FitTargets& targets,
                            const FitSettings& settings);

/// Triangles with a normal at each vertex.
Mesh output(const CurvatureMesh& mesh);

}  // namespace sublimit
