// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kinds of the points of a mesh after all finite sharpness has decayed, with their counts.
#include "sublimit/report/asset/point_verdicts.h"

namespace sublimit::asset {

/// A vertex by its faces and by the edges that stay sharp.
struct VertexKind {
  enum class What : std::uint8_t {
    regular,
    extraordinary,
    border,
    crease,
    corner,
    dart,
    non_manifold,
    isolated,
    in_hole  ///< none of its faces is part of the limit
  };
  What what = What::regular;
  bool at_border = false;    ///< a corner or dart on the border
  Index n = 0;               ///< faces
  std::vector<Index> sides;  ///< faces of each side, the most crowded first; empty where nothing is cut
  PlaneVerdict plane = PlaneVerdict::unknown;
};

/// @param level  of control points
VertexKind vertex_kind(const Scheme<double>& scheme, const Level& level, Vertex v);
PointVerdict verdict_of(const VertexKind& kind, PointVerdicts& verdicts);

/// Regular size of a scheme's faces, and valence of its vertices.
inline Index regular_size(const Scheme<double>& scheme) { return scheme.face_size() == 3 ? 3 : 4; }

struct Inventory {
  std::vector<VertexKind> vertices;
  std::vector<AssetKind> kinds;
  std::int64_t unbounded = 0;  ///< points inside with divergent or logarithmic curvature
};
/// @param listed  examples of each kind
Inventory inventory(const Scheme<double>& scheme, const Level& level, PointVerdicts& verdicts, Index listed);

}  // namespace sublimit::asset
