// SPDX-License-Identifier: Apache-2.0
#pragma once
// Face-varying channels (texture coordinates and the like). A channel is a mesh of its own: its vertices are values, a
// vertex of the mesh has one value or several, and edges across which the values differ, its seams, are boundaries. It
// has a sharpness of its own too, which says where a value moves with its vertex, along its seam, or not at all. So a
// channel becomes a Level, is refined by the masks of the scheme, and has the limit of that Level.
//
//     y_{k+1} = S_k y_k      over values: where the faces around a value are those around its vertex, the rows are the
//     vertex's
//
// Source of the rules: OpenSubdiv's Sdc::Options::FVarLinearInterpolation, as its Vtr levels of version 3.5 apply them.
#include <span>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Rule that determines the sharpness of a value.
enum class ValueRule : std::uint8_t {
  vertex,     ///< its vertex: all faces there have this value, and no seam ends there
  border,     ///< that of a boundary vertex, sharper while its vertex or an edge between its own faces is
  dependent,  ///< a border value that is a corner for as long as the other value of its vertex is
  corner,     ///< it stays
};

/// A channel at one level of a mesh.
/// @note  Sharpness of `level` decays as that of the mesh does, with two exceptions, which concern only what
///        refines `level` by itself, limits among them: under Chaikin creasing a semi-sharp edge that meets a seam
///        decays with the edges on its own side alone; and the sharpness of a dependent value, where several edges
///        of the other side get smooth in the same level, is a mean rounded to float.
struct FaceVaryingLevel {
  /// Corner h of its topology is corner h of the mesh's level, its vertices are the values. S is over the values of the
  /// level before. Its limit surface is the channel's, at the same (face, u, v).
  Level level;
  std::vector<Index> vertices;   ///< of the mesh, for each value
  std::vector<ValueRule> rules;  ///< for each value
  std::vector<Index> given;      ///< level 0: which of the values given each is; -1 for an isolated vertex
};

/// The scheme that moves the values of a channel: `scheme`, or under FaceVaryingInterpolation::all the linear one on
/// its split. What analyses or evaluates `FaceVaryingLevel::level` needs this one.
/// @throws InvalidOption  all, or boundaries, where the split does not keep vertices and edges
Scheme<double> face_varying_scheme(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation);

/// A channel at level 0.
///
/// A value that several vertices use counts once for each of them. Values are ordered as given.
/// @param control  level 0 of the mesh
/// @throws InvalidMesh          another number of indices than corners, an index out of range
/// @throws InvalidOption        as face_varying_scheme
/// @throws UnsupportedTopology  a seam, where the split does not keep vertices and edges
/// @note  At non-manifold vertices values stay, unless all faces around them agree.
FaceVaryingLevel control_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                      const Mesh::FaceVarying& channel, const Level& control);

/// The level after `parent`, beside the mesh's own levels.
/// @param mesh_parent, mesh_child  levels of the mesh that `parent` and the result belong to
FaceVaryingLevel next_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                   const FaceVaryingLevel& parent, const Level& mesh_parent, const Level& mesh_child);

/// A channel at all levels of a mesh.
/// @param mesh  levels 0 to k under `scheme`
/// @throws InvalidParameter  no levels; and what control_face_varying throws
std::vector<FaceVaryingLevel> refine_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                                  const Mesh::FaceVarying& channel, std::span<const Level> mesh);

/// Values of the last level from the values given: #values_k x `num_given`. Rows sum to 1, but those of isolated
/// vertices to 0.
SparseMatrix refinement_matrix(std::span<const FaceVaryingLevel> levels, Index num_given);

/// Values of level 0, and of the last level, as a row for each, from those given.
Points control_values(const FaceVaryingLevel& control, const Points& given);
Points refined_values(std::span<const FaceVaryingLevel> levels, const Points& given);

}  // namespace sublimit
