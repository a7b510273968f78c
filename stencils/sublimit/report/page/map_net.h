// SPDX-License-Identifier: Apache-2.0
#pragma once
// The net of a characteristic map as points and faces.
#include <vector>

#include "sublimit/report/page/plane.h"
#include "sublimit/report/picture.h"

namespace sublimit::page {

struct MapNet {
  std::vector<Point> points;
  std::vector<std::vector<int>> faces;  ///< indices that exist, at least three
};

/// {"net": [{"at": [X, Y]}], "faces": [...]}; no points if one is missing.
MapNet map_net(const Json& characteristic_map);

/// The heights of an eigenfunction, one per point of the net; none if they do not fit.
std::vector<double> heights_of(const Json& eigenfunction, const MapNet& net);

/// Normals of vertices, means over their faces.
Points soft_normals(const PictureMesh& mesh);

}  // namespace sublimit::page
