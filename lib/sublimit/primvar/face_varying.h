// SPDX-License-Identifier: Apache-2.0
#pragma once
// Face-varying channels, such as texture coordinates. A channel is represented as a separate mesh whose
// vertices are values. A vertex of the mesh has one or several values; edges across which values differ, the
// seams, are boundaries of the channel. Its own sharpness determines whether a value moves with its vertex,
// along its seam, or not at all. A channel is thus a Level, refined by the masks of the scheme, with the limit
// of that Level.
//
//     y_{k+1} = S_k y_k
//
// over values. If the faces around a value are those around its vertex, its row is that of the vertex.
//
// Source of the rules: OpenSubdiv's Sdc::Options::FVarLinearInterpolation, as its Vtr levels of version 3.5 apply them.
#include <span>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Rule that determines the sharpness of a value.
enum class ValueRule : std::uint8_t {
  vertex,     ///< as its vertex: all faces there have this value, and no seam ends there
  border,     ///< as a boundary vertex; sharper while its vertex, or an edge between its faces, is sharp
  dependent,  ///< a border value that is a corner as long as the other value of its vertex is
  corner,     ///< interpolated
};

/// A channel at one level of a mesh.
/// @note  Sharpness of `level` decays like that of the mesh, with two exceptions that only affect code which
///        refines `level` by itself, such as limits: with Chaikin creasing a semi-sharp edge at a seam decays
///        with the edges on its own side only; and the sharpness of a dependent value is a mean rounded to
///        float if several edges of the other side become smooth on the same level.
struct FaceVaryingLevel {
  /// The channel as a level: its vertices are the values, and half-edge h is corner h of the mesh's level. S is
  /// over the values of the previous level. Its limit surface is that of the channel, at the same (face, u, v).
  Level level;
  std::vector<Index> vertices;   ///< vertex of the mesh, for each value
  std::vector<ValueRule> rules;  ///< rule of each value
  std::vector<Index> given;      ///< level 0: index of each value among the given ones; -1 for an isolated vertex
};

/// Returns the scheme that refines a channel: `scheme`, or with FaceVaryingInterpolation::all the linear scheme
/// on its split. Use it to analyse or evaluate `FaceVaryingLevel::level`.
/// @throws InvalidOption  `all` or `boundaries` with a split that does not keep vertices and edges
Scheme<double> face_varying_scheme(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation);

/// Returns a channel at level 0.
///
/// A value used by several vertices becomes one value per vertex. Values are in the given order.
/// @param control  level 0 of the mesh
/// @throws InvalidMesh          another number of indices than corners, an index out of range
/// @throws InvalidOption        see face_varying_scheme
/// @throws UnsupportedTopology  a seam with a split that does not keep vertices and edges
/// @note  Values at non-manifold vertices are interpolated, unless all faces around the vertex have the same
///        value.
FaceVaryingLevel control_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                      const Mesh::FaceVarying& channel, const Level& control);

/// Returns the level after `parent`.
/// @param mesh_parent, mesh_child  levels of the mesh that `parent` and the result belong to
FaceVaryingLevel next_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                   const FaceVaryingLevel& parent, const Level& mesh_parent, const Level& mesh_child);

/// Returns a channel at all levels of a mesh.
/// @param mesh  levels 0 to k, refined by `scheme`
/// @throws InvalidParameter  no levels; see also control_face_varying
std::vector<FaceVaryingLevel> refine_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                                  const Mesh::FaceVarying& channel, std::span<const Level> mesh);

/// Returns the matrix from the given values to those of the last level: #values_k x `num_given`. Rows sum to 1;
/// those of isolated vertices are 0.
SparseMatrix refinement_matrix(std::span<const FaceVaryingLevel> levels, Index num_given);

/// Returns the values of level 0, or of the last level, a row each, from the given ones.
Points control_values(const FaceVaryingLevel& control, const Points& given);
Points refined_values(std::span<const FaceVaryingLevel> levels, const Points& given);

}  // namespace sublimit
