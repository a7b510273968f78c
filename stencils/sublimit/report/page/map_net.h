// SPDX-License-Identifier: Apache-2.0
#pragma once
// The net of a characteristic map as points and faces.
#include <array>
#include <vector>

#include "sublimit/report/page/plane.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {

struct MapNet {
  std::vector<Point> points;
  std::vector<std::array<double, 3>> labels;  ///< sector, x, y
  std::vector<std::vector<int>> faces;        ///< valid indices, at least three for each face
};

/// Reads {"net": [{"at": [X, Y]}], "faces": [...]}. The result has no points if an entry is missing.
MapNet map_net(const Json& characteristic_map);

/// Returns the heights of an eigenfunction at the points of the net; empty if their number differs.
std::vector<double> heights_of(const Json& eigenfunction, const MapNet& net);

/// Returns heights rotated by one of n sectors; empty if the net does not have this symmetry.
std::vector<double> turned_by_a_sector(const std::vector<double>& heights, const MapNet& net, int n);

/// Returns normals at vertices, averaged over their faces.
Points soft_normals(const PictureMesh& mesh);

}  // namespace sublimit::page
