// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/sector_mesh.h"

#include <algorithm>

namespace sublimit {

SectorMesh sector_mesh(Centre::Kind kind, int n, int face_size, int rings, bool open) {
  SectorMesh result;
  Mesh& mesh = result.mesh;
  // Corner (x, y) of sector s in units of half steps; x = 0 is the spoke of the sector after.
  const auto vertex = [&](int s, int x2, int y2) {
    SectorLabel label{s, x2, y2};
    if (x2 == 0 && y2 == 0) label.sector = 0;
    if (x2 == 0 && y2 > 0) label = {s + 1, y2, 0};
    if (x2 < 0) label = {s + 1, y2, -x2};  // dual: across the border of two sectors
    if (!open) label.sector %= n;
    const auto [at, is_new] = result.find.try_emplace(label, static_cast<Index>(result.labels.size()));
    if (is_new) result.labels.push_back(label);
    return at->second;
  };
  const auto add = [&](std::vector<Index> corners, int ring) {
    mesh.face_sizes.push_back(static_cast<Index>(corners.size()));
    mesh.face_vertices.insert(mesh.face_vertices.end(), corners.begin(), corners.end());
    result.ring.push_back(ring);
  };
  if (kind == Centre::Kind::face) {
    std::vector<Index> corners;
    for (int s = 0; s < n; ++s) corners.push_back(vertex(s, 1, 1));
    add(corners, 0);
    for (int s = 0; s < n; ++s)
      for (int y = 1; y < 2 * rings; y += 2)  // quadrilaterals across the border to sector s + 1, then those inside
        for (int x = -1; x < 2 * rings; x += 2)
          add({vertex(s, x, y), vertex(s, x + 2, y), vertex(s, x + 2, y + 2), vertex(s, x, y + 2)},
              (std::max(x, y) + 1) / 2);
  } else {
    for (int s = 0; s < n; ++s)
      for (int y = 0; y < rings; ++y)
        for (int x = 0; x < rings; ++x) {
          const int a = 2 * x, b = 2 * y;
          if (face_size == 4) {
            add({vertex(s, a, b), vertex(s, a + 2, b), vertex(s, a + 2, b + 2), vertex(s, a, b + 2)}, std::max(x, y));
            continue;
          }
          if (x + y < rings) add({vertex(s, a, b), vertex(s, a + 2, b), vertex(s, a, b + 2)}, x + y);
          if (x + y + 1 < rings) add({vertex(s, a + 2, b), vertex(s, a + 2, b + 2), vertex(s, a, b + 2)}, x + y + 1);
        }
  }
  mesh.positions = Points::Zero(static_cast<Eigen::Index>(result.labels.size()), 3);
  return result;
}

}  // namespace sublimit
