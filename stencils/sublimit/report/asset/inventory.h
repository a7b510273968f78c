// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kinds of the points of a mesh after all finite sharpness has decayed, with their counts.
#include "sublimit/report/asset/point_verdicts.h"

namespace sublimit::asset {

/// Kind of a vertex, by its faces and by the edges that stay sharp.
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
  bool at_border = false;    ///< true for corners and darts on the border
  Index n = 0;               ///< number of faces
  std::vector<Index> sides;  ///< faces of each side of sharp edges, descending; empty if there are none
  PlaneVerdict plane = PlaneVerdict::unknown;
};

/// @param level  control level
VertexKind vertex_kind(const Scheme<double>& scheme, const Level& level, Vertex v);
PointVerdict verdict_of(const VertexKind& kind, PointVerdicts& verdicts);

/// Regular size of a scheme's faces, and valence of its vertices.
inline Index regular_size(const Scheme<double>& scheme) { return scheme.face_size() == 3 ? 3 : 4; }

struct Inventory {
  std::vector<VertexKind> vertices;
  std::vector<AssetKind> kinds;
  std::int64_t unbounded = 0;  ///< interior points with divergent or logarithmic curvature
};
/// Returns the kinds of all points.
/// @param listed  most examples of each kind
Inventory inventory(const Scheme<double>& scheme, const Level& level, PointVerdicts& verdicts, Index listed);

}  // namespace sublimit::asset
