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
/// What becomes of values at vertices when a mesh is refined.
enum class Attributes {
  smooth,  ///< they are refined by the scheme, as positions are
  linear,  ///< they are interpolated linearly in faces and along edges
  drop,    ///< they are left out, and so are names and values of faces
};
/// How a file keeps numbers (the types of PLY). In a mesh all are of type double.
enum class ValueType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

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

  /// Name of the scheme that the mesh is for, if a file says it, or that made it; empty: unknown.
  std::string scheme = {};
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

  /// Names of faces.
  struct FaceNames {
    std::vector<std::string> names = {};  ///< different names
    std::vector<Index> of_face = {};      ///< number in `names` for each face, -1 for none; empty: no face has one
  };
  FaceNames groups = {}, objects = {};              ///< lines `g` and `o` of an OBJ
  FaceNames materials = {}, smoothing_groups = {};  ///< lines `usemtl` and `s`
  std::vector<std::string> material_files = {};     ///< lines `mtllib`

  Points normals = {};  ///< #normals x 3; no rows: none
  /// Row in `normals` for each corner, -1 for none; empty: normals are per vertex.
  std::vector<Index> face_normals = {};
  Points texture = {};               ///< #V x 2 texture coordinates per vertex, for PLY (`s`, `t`); no rows: none
  std::vector<Index> face_ids = {};  ///< a number for each face: PLY's `face_id`, OBJ's groups `g face_ID`; empty: none
  /// A named number for each vertex or for each face.
  struct Values {
    std::string name = {};
    std::vector<double> values = {};
    ValueType type = ValueType::float64;  ///< in files; values of integer types are rounded when they are written
  };
  /// Properties of vertices and of faces in PLY. Colours are `red`, `green`, `blue` and `alpha`: 0 to 255 if their type
  /// is uint8, 0 to 65535 if it is uint16, 0 to 1 otherwise. OBJ has colours of vertices alone.
  std::vector<Values> vertex_values = {}, face_values = {};
  std::optional<Attributes> attributes = {};  ///< if absent, `smooth`

  std::vector<std::string> comments = {};  ///< comment lines at the top of the file

  std::vector<std::string> notes = {};     ///< what the reader did to make a mesh of the file
  std::vector<std::string> warnings = {};  ///< reservations of the reader, each with file:line

  /// Returns the mesh with other positions, as in another frame.
  /// @param points  #V x 3
  /// @throws InvalidParameter  another number of rows or columns
  Mesh with_points(Points points) const;

  /// Returns the name of each face: its group, or its object if it is in no group.
  FaceNames face_names() const;

  Index num_vertices() const { return static_cast<Index>(positions.rows()); }
  Index num_faces() const { return static_cast<Index>(face_sizes.size()); }
};

}  // namespace sublimit
