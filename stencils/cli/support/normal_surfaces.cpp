// SPDX-License-Identifier: Apache-2.0
#include "support/normal_surfaces.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "support/free_form.h"
#include "support/recipes.h"
#include "support/facts.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj_normals.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

GeometricNormalScheme normal_scheme(const Common& common) {
  return geometric_scheme<NormalMesh>(common.scheme, given_options(common));
}

/// The normals of the mesh, unless they are to be estimated; no rows where there are none.
Points given_normals(const Common& common) {
  const SchemeOptions options = given_options(common);
  const auto found = options.find("normals");
  if ((found != options.end() && found->second == "estimated") ||
      !all_formats().reads(common.mesh, contents::vertex_normals))
    return {};
  return read_obj_normals(common.mesh);
}

NormalMesh checked_data(const Common& common, const GeometricNormalScheme& scheme, const Mesh& mesh) {
  NormalMesh data = normal_mesh(mesh, {});  // other faces than triangles are told before normals are read
  data.normals = given_normals(common);
  return scheme.checked(std::move(data));
}

void tell_notes(const NormalSurface& surface, std::vector<std::string> more) {
  if (surface.common.quiet) return;
  std::vector<std::string> notes = surface.scheme.notes(surface.data);
  notes.insert(notes.end(), more.begin(), more.end());
  for (const std::string& note : notes) fmt::print(stderr, "sublimit: note: {}: {}\n", surface.common.mesh, note);
}

NormalSurface of_mesh(const Common& common, Progress& progress) {
  NormalSurface result{common, normal_scheme(common), {}};
  Common without = common;  // as a mesh, without a scheme that is linear
  without.scheme.clear();
  without.options.clear();
  const Loaded loaded = load(without, progress);
  progress.step("normals");
  naming_mesh(common, [&] { result.data = checked_data(common, result.scheme, loaded.mesh); });
  progress.step("");
  std::vector<std::string> notes;
  if (!loaded.mesh.creases.empty() || !loaded.mesh.corners.empty())
    notes.push_back(common.scheme + " has no creases: sharp edges and vertices of the mesh are smooth");
  tell_notes(result, std::move(notes));
  return result;
}

/// Points of a level of all surfaces, one after the other.
NormalMesh level_of_all(const std::vector<NormalSurface>& surfaces, int levels) {
  std::vector<NormalMesh> parts;
  Eigen::Index points = 0;
  std::size_t corners = 0;
  for (const NormalSurface& surface : surfaces) {
    naming_mesh(surface.common, [&] { parts.push_back(surface.scheme.limit(surface.data, levels)); });
    points += parts.back().positions.rows();
    corners += parts.back().triangles.size();
  }
  if (parts.size() == 1) return std::move(parts[0]);
  if (points > std::numeric_limits<Index>::max())
    throw ResourceError(format_number(points) + " points of a level are more than 32-bit indices count");
  NormalMesh all{{}, Points(points, 3), Points(points, 3)};
  all.triangles.reserve(corners);
  Index at = 0;
  for (const NormalMesh& part : parts) {
    for (const Index v : part.triangles) all.triangles.push_back(at + v);
    all.positions.middleRows(at, part.num_vertices()) = part.positions;
    all.normals.middleRows(at, part.num_vertices()) = part.normals;
    at += part.num_vertices();
  }
  return all;
}

}  // namespace

NormalSurface load_normal_surface(const Common& common, const Recipe& recipe, Progress& progress) {
  const NormalTriangles& triangles = *recipe.normal_triangles();
  Common own = common;
  own.scheme = recipe.kind;
  own.mesh = recipe.place;
  if (triangles.mesh.empty()) {
    NormalSurface result{own, normal_scheme(own), {{0, 1, 2}, triangles.points, triangles.normals}};
    try {
      result.data = result.scheme.checked(std::move(result.data));
    } catch (const InvalidMesh& error) {
      throw InvalidMesh(recipe.place + ": " + error.what());
    }
    tell_notes(result, {});
    return result;
  }
  own.mesh = (directory_of_names_in(common.mesh) / triangles.mesh).string();
  if (triangles.estimated) own.options = {"normals=estimated"};
  try {
    return of_mesh(own, progress);
  } catch (const Error& error) {
    throw Error(error.code(), recipe.place + ": mesh: " + error.what());
  }
}

std::vector<NormalSurface> load_normal_surfaces(const Source& source, Progress& progress) {
  std::vector<NormalSurface> result;
  if (!source.recipes) {
    result.push_back(of_mesh(source.common, progress));
    return result;
  }
  limit_threads(source.common);
  tell_warnings(source);
  for (const Recipe& recipe : *source.recipes)
    if (recipe.normal_triangles()) result.push_back(load_normal_surface(source.common, recipe, progress));
  tell_left_out(source, Sampled::normal_triangles);
  return result;
}

std::string why_no_normal_surface(const Common& common, const Mesh& mesh) {
  try {
    static_cast<void>(checked_data(common, normal_scheme(common), mesh));
  } catch (const UnsupportedTopology& error) {
    return error.what();
  } catch (const InvalidMesh& error) {
    return error.what();
  }
  return {};
}

int write_normal_surface(const NormalJob& job) {
  check_output_path(job.output, all_formats().writers({contents::meshes}));
  const Common& common = job.source->common;
  if (!job.matrix.empty())
    throw InvalidOption(fmt::format("cannot write {}: {}: it is not linear: there is no matrix", job.matrix,
                                    job.source->recipes ? common.mesh : common.scheme));
  Progress progress(common.quiet);
  const std::vector<NormalSurface> surfaces = load_normal_surfaces(*job.source, progress);
  progress.step("points");
  NormalMesh level = level_of_all(surfaces, job.levels);
  Index patches = 0;
  for (const NormalSurface& surface : surfaces) patches += surface.data.num_faces();
  progress.step("writing " + job.output);
  Mesh out;
  out.face_sizes.assign(size_t(level.num_faces()), 3);
  out.face_vertices = std::move(level.triangles);
  out.positions = std::move(level.positions);
  if (job.normals) out.normals = std::move(level.normals);
  write_mesh(job.output, out, progress.bytes_written());
  progress.step("");
  Facts facts(job.verb);
  facts.say("{output}: {points} points of level {level}, {patches} patches\n",
            {{"output", job.output}, {"points", out.positions.rows()}, {"level", job.levels}, {"patches", patches}});
  facts.print(common);
  return 0;
}

}  // namespace sublimit::cli
