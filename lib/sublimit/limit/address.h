// SPDX-License-Identifier: Apache-2.0
#pragma once
// Addresses on a limit surface, numbered as Ptex does: a quad is one square, any other polygon one square for each
// corner; under schemes for triangles every triangle is one.
//
// Quad: (0,0) at corner 0, (1,0) at corner 1, (0,1) at corner 3. Square i of a polygon: (0,0) at corner i, u towards
// the middle of edge (i, i+1), v towards the middle of edge (i-1, i), (1,1) in the centre. Triangle: (0,0), (1,0),
// (0,1) at corners 0, 1, 2.
#include <vector>

#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// A place: a square or triangle, and where in it.
struct Sample {
  Index face = 0;  ///< number of the square or triangle, see `Addresses`
  double u = 0, v = 0;
};

/// How many faces places can be on, and what shape all of them have.
struct FaceCount {
  Index size = 0;
  bool triangles = false;
};

/// Whether a place is on one of these faces, its sides included.
inline bool is_inside(const FaceCount& faces, const Sample& s) {
  return s.face >= 0 && s.face < faces.size && s.u >= 0 && s.v >= 0 &&
         (faces.triangles ? s.u + s.v <= 1 : s.u <= 1 && s.v <= 1);
}
/// @throws InvalidParameter  naming what is wrong with a place that is not
void check_inside(const FaceCount& faces, const Sample& sample);

/// How long a face is in the surface's natural parameters: derivatives per unit of them are those per unit of the face
/// divided by it.
struct FaceLengths {
  double u = 1, v = 1;
};

/// Numbers of the squares (triangles) of a mesh.
class Addresses {
 public:
  /// @param triangles  whether triangles are whole: of schemes that split them as such
  Addresses(const Topology& topology, bool triangles);

  /// What is whole: a face, or one corner of it.
  struct Place {
    Face face{0};
    Index corner = -1;  ///< -1: the whole face
  };

  Index size() const { return size_; }
  Place place(Index address) const;
  /// First address of a face; those of its other corners follow.
  Index first(Face f) const { return first_.empty() ? index(f) : first_[index(f)]; }
  bool triangles() const { return triangles_; }
  operator FaceCount() const { return {size_, triangles_}; }

 private:
  bool triangles_ = false;
  Index size_ = 0;
  std::vector<Index> first_;  // by face, and the end; empty if every face is whole
};

/// A polygon seen as Bfr sees it (OpenSubdiv 3.5's QUAD_SUBFACES): square i lies at
/// [i % w, i % w + 1/2] x [i / w, i / w + 1/2] of one plane, w = floor(sqrt(n - 1)) + 1 squares in a row.
struct BfrParameter {
  double u = 0, v = 0;
};
/// @param corners  of the polygon, not 4
BfrParameter to_bfr(Index corners, Index corner, double u, double v);
/// @throws InvalidParameter  outside every square
Sample from_bfr(Index corners, const BfrParameter& parameter);

}  // namespace sublimit
