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
  std::vector<std::vector<int>> faces;        ///< indices that exist, at least three
};

/// {"net": [{"at": [X, Y]}], "faces": [...]}; no points if one is missing.
MapNet map_net(const Json& characteristic_map);

/// The heights of an eigenfunction, one per point of the net; none if they do not fit.
std::vector<double> heights_of(const Json& eigenfunction, const MapNet& net);

/// Heights turned by one sector of n, as another symmetric choice of the first sector would have them; none if the net
/// is not symmetric.
std::vector<double> turned_by_a_sector(const std::vector<double>& heights, const MapNet& net, int n);

/// Normals of vertices, means over their faces.
Points soft_normals(const PictureMesh& mesh);

}  // namespace sublimit::page
