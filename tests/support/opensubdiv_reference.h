// SPDX-License-Identifier: Apache-2.0
#pragma once
// The reference: OpenSubdiv, run live on a Mesh, in double (sharpness stays float, as it is there).
//
// Edges carry no numbers here, since those of two libraries need not agree. What belongs to an edge is given per
// corner: corner i (faces in order, corners in order) stands for the edge that starts there, as a half-edge does in
// Topology. Corners whose edges OpenSubdiv holds to be one edge have the same child vertex, and only those.
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
  bool tangents = false;  ///< reference_limit only
  /// With the first face-varying channel of the mesh; reference_refine only.
  std::optional<FaceVaryingInterpolation> face_varying;
};

/// What the mesh itself asks for, and the defaults where it is silent.
ReferenceOptions reference_options(const Mesh& mesh, const std::string& scheme, int levels);

struct ReferenceLevel {
  std::vector<Index> face_sizes, face_vertices;
  Points positions;
  std::vector<Index> face_parent;  ///< empty on level 0
  std::vector<char> face_hole;
  std::vector<float> vertex_sharpness;
  std::vector<float> corner_edge_sharpness;  ///< per corner
  std::vector<Index> corner_value;           ///< per corner, if there is a face-varying channel: row of `values`
  Points values;

  // The way to the next level; empty on the last one.
  std::vector<Index> vertex_child;        ///< child vertex of each vertex
  std::vector<Index> corner_edge_child;   ///< per corner: child vertex of its edge
  std::vector<Index> face_child;          ///< child vertex of each face; empty for Loop
  std::vector<Index> child_faces;         ///< faces' child faces, one face after the other
  std::vector<Index> child_face_offsets;  ///< #F + 1

  Index num_vertices() const { return static_cast<Index>(positions.rows()); }
  Index num_faces() const { return static_cast<Index>(face_sizes.size()); }
};

/// Levels 0 to `options.levels`.
///
/// @throws std::runtime_error  with OpenSubdiv's message if it refuses the mesh (Loop: a face that is no triangle; a
///         valence above 65535), and before it is asked where it would read out of bounds: no face, an index out of
///         range.
/// @note  OpenSubdiv's warnings are dropped; there is one only, for a crease on vertices that share no edge.
std::vector<ReferenceLevel> reference_refine(const Mesh& mesh, const ReferenceOptions& options);

/// What decides whether a limit mask is exact at a vertex.
struct ReferenceVertex {
  enum class Rule : char { smooth, dart, crease, corner };
  Rule rule = Rule::smooth;
  bool boundary = false;
  bool nonmanifold = false;
  bool semisharp = false;       ///< the vertex or an edge at it still decays: its limit rule is not its final one
  bool irregular_face = false;  ///< at a face that is no quad (Loop: no triangle); level 0 only
  Index faces = 0, edges = 0;
  /// A manifold crease: corner at which the side that the tangents belong to begins (its edge is the leading crease
  /// edge, the side is to its left), and the faces of that side. An interior crease has another side; no tangents
  /// there.
  Index side_corner = -1;
  Index side_faces = 0;
};

struct ReferenceLimit {
  Points position;
  /// Directions of any length with tangent1 x tangent2 along the normal; empty if not asked for. Without meaning at
  /// non-manifold vertices, and at isolated ones zero.
  Points tangent1, tangent2;
  std::vector<ReferenceVertex> vertex;
};

/// Limit masks of OpenSubdiv at the vertices of level `options.levels`. Where they are exact: `ReferenceVertex`.
/// @throws std::runtime_error  as reference_refine
ReferenceLimit reference_limit(const Mesh& mesh, const ReferenceOptions& options);

}  // namespace sublimit::testing
