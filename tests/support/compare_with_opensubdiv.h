// SPDX-License-Identifier: Apache-2.0
#pragma once
// Our levels against OpenSubdiv's, vertex by vertex through provenance (numbers of vertices and edges differ), face by
// face.
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/refine.h"
#include "support/opensubdiv_reference.h"

namespace sublimit::testing {

struct Comparison {
  std::string mismatch;           ///< what differs in connectivity or tags, empty if nothing does
  double error = 0;               ///< largest distance of positions, all levels, over the bounding box
  std::vector<Index> vertex_map;  ///< reference vertex of every vertex of the last level
};

/// Options of the mesh's own tags; scheme "loop-warren" has no reference.
Comparison compare_with_opensubdiv(const Mesh& mesh, const std::string& scheme, int levels);

/// The scheme with what the mesh's tags ask of it.
Scheme<double> scheme_for(const Mesh& mesh, const std::string& scheme);

}  // namespace sublimit::testing
