// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on a limit surface, and how their faces are numbered: as in Ptex, a quad is one square, any other polygon one
// square for each corner; under schemes for triangles every triangle is one.
//
//   const Place centre = {.face = 0, .u = 0.5, .v = 0.5};
//   const bool exists = is_inside(surface.faces(), centre);
//   const Addresses addresses(Topology(view(mesh)), false);
//   const auto [face, corner] = addresses.place(centre.face);  // corner -1: the whole face
//
// Quad: (0,0) at corner 0, (1,0) at corner 1, (0,1) at corner 3. Square i of a polygon: (0,0) at corner i, u towards
// the middle of edge (i, i+1), v towards the middle of edge (i-1, i), (1,1) in the centre. Triangle: (0,0), (1,0),
// (0,1) at corners 0, 1, 2.
#include <vector>

#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// A place on a surface: a square or triangle, and parameters in it.
struct Place {
  Index face = 0;       ///< number of the square or triangle, see `Addresses`
  double u = 0, v = 0;  ///< in [0, 1]; u + v <= 1 in a triangle
};

/// The faces of a surface: squares, or triangles.
struct FaceCount {
  Index size = 0;          ///< number of faces
  bool triangles = false;  ///< all faces are triangles; else squares
};

/// True if a place is on one of these faces, their sides included.
inline bool is_inside(const FaceCount& faces, const Place& s) {
  return s.face >= 0 && s.face < faces.size && s.u >= 0 && s.v >= 0 &&
         (faces.triangles ? s.u + s.v <= 1 : s.u <= 1 && s.v <= 1);
}
/// Throws unless a place is on one of these faces, their sides included.
/// @throws InvalidParameter  a place that is not: names the face or the parameter
void check_inside(const FaceCount& faces, const Place& place);

/// Lengths of a face's sides in the surface's natural parameters. Derivatives by natural parameters are those per unit
/// of the face, divided by these lengths.
struct FaceLengths {
  double u = 1, v = 1;
};

/// Numbers of the squares (triangles) of a mesh. It never changes: threads may share it.
class Addresses {
 public:
  /// Numbers the faces of a mesh.
  /// @param triangles  true for schemes that split triangles into triangles: every triangle is one face
  Addresses(const Topology& topology, bool triangles);

  /// A face of the mesh, or one corner of it.
  struct FaceCorner {
    Face face{0};
    Index corner = -1;  ///< -1: the whole face
  };

  /// Returns the number of squares (triangles).
  Index size() const { return size_; }
  /// Returns the face, or the corner of a face, that a square (triangle) covers.
  FaceCorner place(Index address) const;
  /// Returns the first number of a face; those of its other corners follow.
  Index first(Face f) const { return first_.empty() ? index(f) : first_[index(f)]; }
  bool triangles() const { return triangles_; }
  operator FaceCount() const { return {size_, triangles_}; }

 private:
  bool triangles_ = false;
  Index size_ = 0;
  std::vector<Index> first_;  // by face, and the end; empty if every face is whole
};

/// Parameters of a polygon in OpenSubdiv's Bfr (3.5, QUAD_SUBFACES): square i lies at [i % w, i % w + 1/2] x [i / w,
/// i / w + 1/2] of one plane, w = floor(sqrt(n - 1)) + 1 squares in a row.
struct BfrParameter {
  double u = 0, v = 0;
};
/// Returns the Bfr parameters of a place on the square at a corner.
/// @param corners  number of corners of the polygon, not 4
BfrParameter to_bfr(Index corners, Index corner, double u, double v);
/// Returns the place of Bfr parameters; its `face` is the corner of the polygon.
/// @param corners  number of corners of the polygon, not 4
/// @throws InvalidParameter  parameters outside every square
Place from_bfr(Index corners, const BfrParameter& parameter);

}  // namespace sublimit
