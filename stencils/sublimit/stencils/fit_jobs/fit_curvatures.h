// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fits by nonlinear schemes, which refine points with normals and curvatures to more such points.
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/stencils/fit_jobs/fit_job.h"

namespace sublimit {

struct [[nodiscard]] CurvatureFit {
  CurvatureMesh given, refined;  ///< the first vertices of `refined` are those of `given`
  FitReport report;
};

/// Refines a mesh whose targets give the data of all vertices.
/// @throws FormatError  as `check_vertices`; a vertex without all its data
/// @throws InvalidMesh, UnsupportedTopology  as `curvature_mesh`: faces of five corners, edges of three faces
CurvatureFit fit_curvatures(const GeometricSurfaceScheme& scheme, const Mesh& mesh, const FitTargets& targets,
                            const FitSettings& settings);

/// Returns a mesh of triangles with a normal at each vertex.
Mesh output(const CurvatureMesh& mesh);

}  // namespace sublimit
