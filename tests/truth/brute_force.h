// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits without eigenvectors, by repeated refinement of the faces around a vertex in 256-bit floats.
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "truth/precise_schemes.h"

namespace sublimit::testing {

using PrecisePoints = Eigen::Matrix<Precise, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The ring around a vertex after many steps: part of the refined mesh and its points.
struct RefinedRing {
  Level level;           ///< topology of the part; the vertex is `vertex`
  PrecisePoints points;  ///< offsets from `position`
  Eigen::Matrix<Precise, 1, 3> position = Eigen::Matrix<Precise, 1, 3>::Zero();  ///< position of the vertex
  Vertex vertex{0};
  std::vector<HalfEdge> corners;  ///< corners at the vertex, fan by fan, in the order of the control mesh
};

/// Refines the faces around `v` of `level`. Masks come from the scheme in 256-bit floats; the topology of
/// each step is a subset of the mesh, so nothing is unfolded and nothing analysed.
/// @param depths  ascending numbers of levels; the result has a ring for each
std::vector<RefinedRing> brute_force(const Scheme<Precise>& scheme, const Level& level, const Points& points, Vertex v,
                                     const std::vector<int>& depths);

}  // namespace sublimit::testing
