// SPDX-License-Identifier: Apache-2.0
#pragma once
// The reference: OpenSubdiv, run live on a Mesh, in double (sharpness stays float, as it is there).
//
// Edges have no numbers here, since two libraries need not number them alike. Values at edges are given per
// corner: corner i (in the order of faces and their corners) stands for the edge that starts there, as a
// half-edge of Topology. Corners have the same child vertex exactly if they belong to the same edge of
// OpenSubdiv.
#include <optional>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

struct ReferenceOptions {
  std::string scheme = "catmull-clark";  ///< or "loop", "bilinear"
  Boundary boundary = Boundary::edge_and_corner;
  Creasing creasing = Creasing::uniform;
  Triangles triangles = Triangles::catmark;
  int levels = 1;         ///< 0 to 15, OpenSubdiv's four bits
  bool tangents = false;  ///< compute tangents; reference_limit only
  /// Interpolation of the first face-varying channel of the mesh, if it is to be refined; reference_refine
  /// only.
  std::optional<FaceVaryingInterpolation> face_varying;
};

/// Returns the options that the mesh's tags select, with defaults for the others.
ReferenceOptions reference_options(const Mesh& mesh, const std::string& scheme, int levels);

struct ReferenceLevel {
  std::vector<Index> face_sizes, face_vertices;
  Points positions;
  std::vector<Index> face_parent;  ///< empty on level 0
  std::vector<char> face_hole;
  std::vector<float> vertex_sharpness;
  std::vector<float> corner_edge_sharpness;  ///< sharpness of the edge of each corner
  std::vector<Index> corner_value;           ///< per corner, if there is a face-varying channel: row of `values`
  Points values;

  // Children on the next level; empty on the last one.
  std::vector<Index> vertex_child;        ///< child vertex of each vertex
  std::vector<Index> corner_edge_child;   ///< per corner: child vertex of its edge
  std::vector<Index> face_child;          ///< child vertex of each face; empty for Loop
  std::vector<Index> child_faces;         ///< faces' child faces, one face after the other
  std::vector<Index> child_face_offsets;  ///< #F + 1

  Index num_vertices() const { return static_cast<Index>(positions.rows()); }
  Index num_faces() const { return static_cast<Index>(face_sizes.size()); }
};

/// Returns levels 0 to `options.levels`.
///
/// @throws std::runtime_error  with OpenSubdiv's message if it refuses the mesh (Loop: a face that is not a
///                             triangle; a
///         valence above 65535); also for meshes for which it would read out of bounds: no face, an index out
///         of range
/// @note  OpenSubdiv's warnings are ignored; there is only one, for a crease between vertices that share no
///        edge.
std::vector<ReferenceLevel> reference_refine(const Mesh& mesh, const ReferenceOptions& options);

/// Properties that determine whether a limit mask is exact at a vertex.
struct ReferenceVertex {
  enum class Rule : char { smooth, dart, crease, corner };
  Rule rule = Rule::smooth;
  bool boundary = false;
  bool nonmanifold = false;
  bool semisharp = false;       ///< sharpness of the vertex or an edge still decays: its rule is not the final one
  bool irregular_face = false;  ///< in a face that is not a quad (Loop: not a triangle); level 0 only
  Index faces = 0, edges = 0;
  /// For a manifold crease: the corner where the side of the tangents begins (its edge is the leading crease
  /// edge, the side is to its left), and the faces of that side. The other side of an interior crease has no
  /// tangents.
  Index side_corner = -1;
  Index side_faces = 0;
};

struct ReferenceLimit {
  Points position;
  /// Directions of any length with tangent1 x tangent2 along the normal; empty if `options.tangents` is false.
  /// They have no meaning at non-manifold vertices, and are zero at isolated ones.
  Points tangent1, tangent2;
  std::vector<ReferenceVertex> vertex;
};

/// Applies OpenSubdiv's limit masks at the vertices of level `options.levels`. `ReferenceVertex` says where
/// they are exact.
/// @throws std::runtime_error  as reference_refine
ReferenceLimit reference_limit(const Mesh& mesh, const ReferenceOptions& options);

}  // namespace sublimit::testing
