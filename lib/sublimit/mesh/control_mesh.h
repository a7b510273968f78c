// SPDX-License-Identifier: Apache-2.0
#pragma once
// A control mesh as a file or a caller gives it: positions, faces of any size, tags. Plain data; nothing derived.
#include <optional>
#include <string>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// What happens at the boundary (the names of OpenSubdiv's VtxBoundaryInterpolation).
enum class Boundary {
  none,             ///< faces that touch the boundary are holes
  edge_only,        ///< boundary edges are sharp
  edge_and_corner,  ///< boundary edges are sharp, vertices of a single face are corners
};
/// How the sharpness of a crease decays from level to level.
enum class Creasing { uniform, chaikin };
/// Weights of Catmull-Clark edge points next to triangles.
enum class Triangles { catmark, smooth };
/// Where a face-varying channel is interpolated linearly (the names of OpenSubdiv's FVarLinearInterpolation). Each rule
/// includes the ones before it.
enum class FaceVaryingInterpolation {
  none,           ///< nowhere: seams are as smooth as boundaries
  corners_only,   ///< values in a single face of their vertex stay
  corners_plus1,  ///< three or more values of a vertex stay; of two, both while a crease meets the seam
  corners_plus2,  ///< of two, both if one is in a single face; and the end of a seam inside
  boundaries,     ///< along seams and boundaries
  all,            ///< everywhere: bilinear
};

struct [[nodiscard]] ControlMesh {
  Points positions;                  ///< #V x 3
  std::vector<Index> face_sizes;     ///< corners of each face, >= 3
  std::vector<Index> face_vertices;  ///< vertices of all faces, one after the other, counter-clockwise

  struct Crease {
    Index tail = 0, head = 0;
    float sharpness = 0;  ///< levels; >= 10 is infinite
  };
  struct Corner {
    Index vertex = 0;
    float sharpness = 0;
  };
  std::vector<Crease> creases;  ///< the last entry for an edge wins
  std::vector<Corner> corners;
  /// Knot interval of an edge, shared by its strip: the edges that are opposite to it in quadrilaterals, and so on.
  struct KnotInterval {
    Index tail = 0, head = 0;
    double length = 1;
  };
  std::vector<KnotInterval> knot_intervals;  ///< 1 for edges whose strip has none
  std::vector<Index> holes;                  ///< faces that are refined but are not part of the limit

  /// Rules. Absent ones have their defaults: edge_and_corner, uniform, catmark.
  std::optional<Boundary> boundary;
  std::optional<Creasing> creasing;
  std::optional<Triangles> triangles;

  /// Values per corner of a face, such as texture coordinates: a vertex has one or, where the channel has a seam,
  /// several.
  struct FaceVarying {
    std::string name;
    Points values;               ///< #values x channels
    std::vector<Index> indices;  ///< value of every corner, in the order of face_vertices
  };
  std::vector<FaceVarying> face_varying;
  std::optional<FaceVaryingInterpolation> face_varying_interpolation;  ///< absent: all

  /// Names of faces in files: their group, or their object if they are in no group.
  struct FaceNames {
    std::vector<std::string> names;  ///< each once
    std::vector<Index> of_face;      ///< one of `names`, -1 none; empty: no face has one
  };
  FaceNames face_names;

  std::vector<std::string> warnings;  ///< what a reader accepted with a reservation, each with file:line

  Index num_vertices() const { return static_cast<Index>(positions.rows()); }
  Index num_faces() const { return static_cast<Index>(face_sizes.size()); }
};

}  // namespace sublimit
