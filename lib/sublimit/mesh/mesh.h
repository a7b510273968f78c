// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes as plain data: positions, faces of any size, tags, values.
//
//   Mesh mesh = read_mesh("cube.obj");  // or make_mesh(points, faces)
//   mesh.creases.push_back({.tail = 0, .head = 1, .sharpness = 2.5F});
//   mesh.boundary = Boundary::edge_only;
//   write_mesh("tagged.obj", mesh);
#include <optional>
#include <string>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Rule for the boundary (the names of OpenSubdiv's VtxBoundaryInterpolation).
enum class Boundary {
  none,             ///< faces that touch the boundary are holes
  edge_only,        ///< boundary edges are sharp
  edge_and_corner,  ///< boundary edges are sharp, vertices of a single face are corners
};
/// Decay of the sharpness of a crease from level to level.
enum class Creasing { uniform, chaikin };
/// Weights of Catmull-Clark edge points next to triangles (the names of OpenSubdiv's TriangleSubdivision).
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

/// A mesh: a control mesh, a refined mesh, or triangles near a surface. All but positions and faces may be absent.
/// `make_mesh` makes one from arrays, `read_mesh` from a file; `write_mesh` writes one. Plain data.
struct [[nodiscard]] Mesh {
  Points positions = {};                  ///< #V x 3
  std::vector<Index> face_sizes = {};     ///< corners of each face, >= 3
  std::vector<Index> face_vertices = {};  ///< vertices of all faces, one after the other, counter-clockwise

  /// A sharp edge, given by its vertices in either order.
  struct Crease {
    Index tail = 0, head = 0;
    float sharpness = 0;  ///< levels; >= 10 is infinite
  };
  /// A sharp vertex.
  struct Corner {
    Index vertex = 0;
    float sharpness = 0;  ///< levels; >= 10 is infinite
  };
  std::vector<Crease> creases = {};  ///< the last entry for an edge wins
  std::vector<Corner> corners = {};
  /// Knot interval of an edge and of its strip: the edges opposite to it in quadrilaterals, those opposite to them, ...
  struct KnotInterval {
    Index tail = 0, head = 0;
    double length = 1;
  };
  std::vector<KnotInterval> knot_intervals = {};  ///< 1 for edges whose strip has none
  std::vector<Index> holes = {};                  ///< faces that are refined but are not part of the limit

  /// Rules of refinement; if absent, edge_and_corner, uniform and catmark.
  std::optional<Boundary> boundary = {};
  std::optional<Creasing> creasing = {};
  std::optional<Triangles> triangles = {};

  /// Values per corner of a face, such as texture coordinates: a vertex has one or, where the channel has a seam,
  /// several.
  struct FaceVarying {
    std::string name = {};
    Points values = {};               ///< #values x channels
    std::vector<Index> indices = {};  ///< value of every corner, in the order of face_vertices
  };
  std::vector<FaceVarying> face_varying = {};
  std::optional<FaceVaryingInterpolation> face_varying_interpolation = {};  ///< if absent, `all`: linear everywhere

  /// Names of faces in files: their group, or their object if they are in no group.
  struct FaceNames {
    std::vector<std::string> names = {};  ///< different names
    std::vector<Index> of_face = {};      ///< number in `names` for each face, -1 for none; empty: no face has one
  };
  FaceNames face_names = {};

  Points normals = {};  ///< #normals x 3; no rows: none
  /// Row in `normals` for each corner, -1 for none; empty: normals are per vertex.
  std::vector<Index> face_normals = {};
  Points texture = {};               ///< #V x 2 texture coordinates per vertex, for PLY (`s`, `t`); no rows: none
  std::vector<Index> face_ids = {};  ///< a number for each face: PLY's `face_id`, OBJ's groups `g face_ID`; empty: none
  /// A named number for each vertex.
  struct VertexValues {
    std::string name = {};
    std::vector<double> values = {};  ///< #V
    bool whole = false;               ///< written as integers of 32 bits
  };
  std::vector<VertexValues> vertex_values = {};  ///< further properties of vertices in PLY; OBJ has no place for them
  std::vector<std::string> comments = {};        ///< comment lines at the top of the file

  std::vector<std::string> warnings = {};  ///< reservations of the reader, each with file:line

  /// Returns the mesh with other positions, as in another frame.
  /// @param points  #V x 3
  /// @throws InvalidParameter  another number of rows or columns
  Mesh with_points(Points points) const;

  Index num_vertices() const { return static_cast<Index>(positions.rows()); }
  Index num_faces() const { return static_cast<Index>(face_sizes.size()); }
};

}  // namespace sublimit
