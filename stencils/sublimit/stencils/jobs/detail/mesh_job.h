// SPDX-License-Identifier: Apache-2.0
#pragma once
// A mesh and the scheme that is to refine it, requested in words: by options of the program, by arguments in Python.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {

/// A request. Rules are words (`rule_of_word.h`), of `boundary` also "fixed": border vertices stay; empty: the mesh's
/// own.
struct MeshRequest {
  std::string scheme = {};     ///< name of the scheme; empty: none is needed
  SchemeOptions options = {};  ///< options of the scheme
  std::string boundary = {}, creasing = {}, triangles = {}, face_varying = {}, attributes = {};
  bool orient = false;                                    ///< winding is made consistent first
  std::optional<double> crease_angle = {};                ///< degrees: edges that bend by more become sharp
  bool crease_smoothing_groups = false;                   ///< edges between smoothing groups become sharp
  bool triangulate = false;                               ///< every face is cut into triangles first
  bool no_creases = false;                                ///< crease and corner tags are dropped first
  bool strict = false;                                    ///< a mesh that is no clean manifold is refused
  std::shared_ptr<const Scheme<double>> own_scheme = {};  ///< a scheme of the caller, instead of a name
};

/// A mesh with its scheme, ready to be refined.
struct MeshJob {
  Mesh mesh;
  std::optional<Scheme<double>> scheme;
  SchemeOptions options;  ///< options of the scheme, with those that tags of the mesh select
  SubdivisionOptions rules;
  FaceVaryingInterpolation face_varying = FaceVaryingInterpolation::all;
  std::vector<std::string> notes;   ///< what was done to the mesh as the request asked
  bool face_varying_asked = false;  ///< true if the request asks for it, not a tag: it must be possible
};

/// Returns the scheme of a name.
/// @throws InvalidOption  no such scheme, or it is one for curves or for points with normals; the message has
///                        the nearest names
Scheme<double> scheme_or_throw(const std::string& name, const SchemeOptions& options = {});

/// Returns scheme and rules of a request before a mesh is read, so that misspelt names are reported at once.
/// @throws InvalidOption  as `scheme_or_throw`; an unknown word for a rule, an option that `own_scheme` does
///                        not have
MeshJob scheme_job(const MeshRequest& request);

/// Returns scheme, rules and mesh of a request.
/// @param name  of the mesh, in messages
/// @throws InvalidMesh  connectivity that no scheme takes; with `strict`, every fault of it
/// @note  Warnings about accepted faults are added to those of the mesh.
MeshJob mesh_job(const MeshRequest& request, Mesh mesh, const std::string& name);

/// Returns the reasons why a mesh is not a manifold, as words; empty if it is one.
/// @param turned  `orient_faces` has done what it can: advice is not to turn faces
std::vector<std::string> faults(const Mesh& mesh, bool turned = false);

}  // namespace sublimit
