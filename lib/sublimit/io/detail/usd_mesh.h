// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes of a scene of USD (UsdGeomMesh): faces, tags, primvars, subsets of faces, materials, transforms, samples in
// time.
//
//   UsdStage stage("scene.usda");
//   for (const UsdMesh& one : usd_meshes(stage, warnings)) refine(one.mesh, ...);
//
// Source: OpenUSD, "UsdGeomMesh", "UsdGeomPrimvar", "UsdGeomSubset", "UsdGeomXformable" (2024).
#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/usd_stage.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Values of a mesh under a name.
struct UsdPrimvar {
  enum class Interpolation { constant, uniform, varying, vertex, face_varying };
  std::string name;  ///< without `primvars:`
  UsdType type;
  Interpolation interpolation = Interpolation::constant;
  Points values;               ///< #values x width
  std::vector<Index> indices;  ///< value of each vertex, face or corner; one for each

  /// Returns the values of all vertices, faces or corners, #elements x width.
  Points expanded() const;
};

/// Faces of a mesh under a name.
struct UsdSubset {
  std::string name = {}, family = {};
  std::string path = {};
  std::vector<Index> faces = {};
  std::string material = {};  ///< path; empty: none
};

/// A mesh of a scene. Positions are those of the first time, in the space of the prim.
struct UsdMesh {
  std::string path;   ///< of the prim
  std::string name;   ///< its path with the names that are shown, without the first slash
  std::string place;  ///< "scene.usda:12: /World/Cage: "
  /// Faces are counter-clockwise; creases, corners, holes and rules; `scheme` is that of the prim, empty for `none`.
  Mesh mesh;
  std::vector<UsdPrimvar> primvars;
  std::vector<std::string> left_out;  ///< names of primvars that are not read, as `primvars` has them
  std::vector<UsdSubset> subsets;
  std::vector<UsdPrim::Opinion> opinions;  ///< what layers say of the prim
  std::string material;                    ///< path of the material of all faces without a subset's; empty: none
  Eigen::Matrix4d to_world = Eigen::Matrix4d::Identity();  ///< for columns (x, y, z, 1)
  bool left_handed = false;                                ///< faces of the file are clockwise
  std::vector<double> times;              ///< of samples of the points, of one at least if points move; else none
  const UsdLayer* layer = nullptr;        ///< that the points are of
  std::vector<std::string_view> samples;  ///< the points at these times, as text
  std::vector<double> transform_times;    ///< of samples of transforms, its own and those above it
};

/// Returns the meshes of a scene, in its order. Prims that are not seen (invisible, guides, proxies) are left out.
/// @param warnings  gets what is left out, with its place
/// @param time      of positions and transforms, interpolated between samples; absent: the first one of each
/// @throws FormatError, InvalidMesh  values that cannot be read, faces and tags that do not fit; with their place
std::vector<UsdMesh> usd_meshes(UsdStage& stage, std::vector<std::string>& warnings, std::optional<double> time = {});

/// Turns the faces of a mesh, with what is of their corners: channels, normals. First corners stay the first.
void turn_faces(Mesh& mesh);

/// Returns the points of a sample in time.
/// @throws InvalidMesh  another number of points
Points usd_points(const UsdMesh& mesh, std::size_t sample);

/// Returns a mesh with its primvars as values and channels, its subsets and materials as names, in its own space.
/// @param name_of  name of the material of a path
Mesh mesh_of(const UsdMesh& one, const std::function<std::string(const std::string&)>& name_of);

/// Returns all meshes of a scene as one in the space of the world: prims are its objects, materials and subsets names
/// of faces, primvars values and channels.
/// @param instead  returns the mesh that stands for one, with paths for names of materials and normals at corners;
/// null:
///                 the one itself
/// @throws InvalidMesh  prims with other rules: one mesh has one of each
Mesh merged(const std::vector<UsdMesh>& meshes, UsdStage& stage, std::vector<std::string> warnings,
            const std::function<const Mesh*(const UsdMesh&)>& instead = {});

/// Positions in the space of the world, of all meshes of a scene one behind the other.
struct UsdFrames {
  std::int64_t count = 1;
  std::function<Points(std::int64_t)> positions;  ///< of a frame, #V x 3
};
/// Reads a scene's frames: the times at which something of its meshes has a sample. Points and transforms are linear
/// between their samples.
UsdFrames read_usd_frames(const std::filesystem::path& path);

/// Returns the name of values of a primvar: its own, or for one with several numbers that with the number, `v_0`.
std::string component_name(const UsdPrimvar& primvar, int component);

}  // namespace sublimit
