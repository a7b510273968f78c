// SPDX-License-Identifier: Apache-2.0
#pragma once
// Comparison of levels with OpenSubdiv's: faces in order, vertices matched by their parents, since the two
// libraries number vertices and edges differently.
#include <string>
#include <vector>

#include "peers/opensubdiv_reference.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/refine.h"

namespace sublimit::testing {

struct Comparison {
  std::string mismatch;           ///< what differs in connectivity or tags, empty if nothing does
  double error = 0;               ///< largest distance of positions on all levels, relative to the bounding box
  std::vector<Index> vertex_map;  ///< reference vertex of every vertex of the last level
};

/// Compares levels under the options of the mesh's tags. The scheme "loop-warren" has no reference.
Comparison compare_with_opensubdiv(const Mesh& mesh, const std::string& scheme, int levels);

/// Returns the scheme with the options that the mesh's tags select.
Scheme<double> scheme_for(const Mesh& mesh, const std::string& scheme);

}  // namespace sublimit::testing
