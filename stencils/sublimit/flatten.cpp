// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/split_mesh.h"
#include "sublimit/io/detail/usd_flat.h"
#include "sublimit/primvar/vertex_values.h"
#include "sublimit/source/place_stencils.h"
#include "sublimit/stencils/files/tessellation_mesh.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/jobs/detail/refined_job.h"
#include "sublimit/sublimit.h"

namespace sublimit {
namespace {

/// Why a mesh cannot become triangles; empty if it can.
std::string why_not(const UsdMesh& mesh) {
  const auto of_skeleton = [](const std::string& name) { return name.starts_with("skel:"); };
  const bool bound = std::ranges::any_of(mesh.left_out, of_skeleton) ||
                     std::ranges::any_of(mesh.primvars, of_skeleton, &UsdPrimvar::name);
  return bound ? "it is bound to a skeleton, whose weights are those of control points" : "";
}

/// The primvars of vertices with one interpolation.
UsdMesh with_values(const UsdMesh& mesh, UsdPrimvar::Interpolation interpolation) {
  UsdMesh some;
  some.mesh = mesh.mesh;
  for (const UsdPrimvar& primvar : mesh.primvars)
    if (primvar.interpolation == interpolation) some.primvars.push_back(primvar);
  return some;
}

class Flattener {
 public:
  Flattener(const UsdMesh& from, const FlattenOptions& options, std::vector<std::string>& warnings)
      : from_(from), options_(options), warnings_(warnings) {
    job_ =
        mesh_job({.scheme = from.mesh.scheme}, mesh_of(from, [](const std::string& path) { return path; }), from.place);
    // Values of vertices follow by their own interpolation.
    job_.mesh.vertex_values.clear();
    warnings_.insert(warnings_.end(), from.mesh.warnings.begin(), from.mesh.warnings.end());
    for (const std::string& fault : faults(job_.mesh)) warnings_.push_back(from.place + fault);
  }

  UsdFlat make(double& bound) {
    const LimitSurface surface(job_.mesh, *job_.scheme);
    Tessellation made = tessellate(surface, options());
    bound = made.bound;
    UsdFlat flat{.from = &from_, .mesh = tessellation_mesh(made, surface.map().addresses())};
    flat.faces = std::move(flat.mesh.face_ids);
    flat.mesh.face_ids.clear();
    Points normals = std::move(made.normals);
    add_normals(flat.mesh, made, normals, true);
    carry_attributes(*job_.scheme, job_.mesh, surface.map(), made, flat.mesh);
    add_values(surface, made, flat.mesh);
    add_channels(surface, made, flat.mesh);
    if (!from_.times.empty()) add_frames(surface, made, flat);
    return flat;
  }

 private:
  TessellationOptions options() const {
    const Points& points = from_.mesh.positions;
    if (points.rows() == 0) throw InvalidMesh(from_.place + "it has no points");
    double chord = 0;
    if (options_.chord > 0) {
      const Eigen::Matrix3d linear = from_.to_world.topLeftCorner<3, 3>();
      const double scale = linear.jacobiSvd().singularValues()[0];
      chord = scale > 0 ? options_.chord / scale : options_.chord;
    } else {
      chord = options_.relative_chord * (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
    }
    if (!(chord > 0)) throw InvalidMesh(from_.place + "its points have no extent");
    return {.chord = chord, .angle = options_.angle, .max_triangles = options_.max_triangles, .normals = true};
  }

  void add_values(const LimitSurface& surface, const Tessellation& made, Mesh& flat) const {
    for (const UsdPrimvar::Interpolation interpolation :
         {UsdPrimvar::Interpolation::vertex, UsdPrimvar::Interpolation::varying}) {
      Mesh values = mesh_of(with_values(from_, interpolation), {});
      if (values.vertex_values.empty()) continue;
      values.attributes = interpolation == UsdPrimvar::Interpolation::varying ? Attributes::linear : Attributes::smooth;
      Mesh out;
      set_vertex_values(out, values, limit_vertex_values(*job_.scheme, values, surface.map(), made.places));
      flat.vertex_values.insert(flat.vertex_values.end(), out.vertex_values.begin(), out.vertex_values.end());
    }
  }

  void add_channels(const LimitSurface& surface, const Tessellation& made, Mesh& flat) const {
    for (std::size_t c = 0; c < job_.mesh.face_varying.size(); ++c) try {
        add_channel(flat, made, *job_.scheme, job_.face_varying, job_.mesh.face_varying[c], surface.map().level());
      } catch (const Error& error) {
        warnings_.push_back(from_.place + left_out(job_.mesh.face_varying[c], c, error.what()));
      }
  }

  void add_frames(const LimitSurface& surface, const Tessellation& made, UsdFlat& flat) const {
    const SparseMatrix stencils = place_stencils(surface.map(), made.places).matrices[0];
    const std::vector<Place> corners = corner_places(made);
    for (std::size_t k = 0; k < from_.times.size(); ++k) {
      const Points control = usd_points(from_, k);
      flat.points.push_back(stencils * control);
      Tessellation frame = made;
      frame.points = flat.points.back();
      Mesh posed = tessellation_mesh(frame);
      add_normals(posed, frame, surface.map().evaluate(control, corners, 1).normal, true);
      flat.normals.push_back(std::move(posed.normals));
    }
  }

  const UsdMesh& from_;
  const FlattenOptions& options_;
  std::vector<std::string>& warnings_;
  MeshJob job_;
};

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace

FlattenedScene flatten(const std::filesystem::path& scene, const std::filesystem::path& path,
                       const FlattenOptions& options, const std::function<void(const std::string&)>& progress) {
  for (const double number : {options.chord, options.relative_chord, options.angle})
    if (!(number >= 0)) throw InvalidParameter("a chord or an angle is negative or not a number");
  UsdStage stage(scene);
  FlattenedScene result;
  const std::vector<UsdMesh> meshes = usd_meshes(stage, result.warnings);
  std::vector<UsdFlat> flats;
  for (const UsdMesh& mesh : meshes) {
    if (mesh.mesh.scheme.empty()) continue;
    FlattenedScene::FlatMesh& told = result.meshes.emplace_back();
    told.path = mesh.path;
    told.why_not = why_not(mesh);
    if (!told.why_not.empty()) continue;
    if (progress) progress(mesh.path);
    try {
      flats.push_back(Flattener(mesh, options, result.warnings).make(told.bound));
      told.triangles = flats.back().mesh.num_faces();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::invalid_mesh && error.code() != ErrorCode::unsupported_topology) throw;
      told.why_not = error.what();
    }
  }
  const FileFormat* const format = all_formats().writer(path, contents::scenes);
  if (!format) {
    const auto flat = [&](const UsdMesh& mesh) -> const Mesh* {
      const auto found = std::ranges::find(flats, &mesh, &UsdFlat::from);
      return found == flats.end() ? nullptr : &found->mesh;
    };
    Mesh all = merged(meshes, stage, {}, flat);
    result.warnings.insert(result.warnings.end(), all.warnings.begin(), all.warnings.end());
    if (!all_formats().holds(path, MeshField::corner_normals)) all = split_mesh(std::move(all)).mesh;
    write_mesh(path, all);
    return result;
  }
  const std::string layer = flattened_layer(stage, flats, result.warnings);
  if (progress) progress("");
  write_bytes(path, format->format_scene(stage, layer, path.string(), result.warnings));
  return result;
}

}  // namespace sublimit
