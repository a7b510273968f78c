// SPDX-License-Identifier: Apache-2.0
// Finer nets of free-form surfaces, and their points moved to the surface.
#include <fmt/core.h>

#include <Eigen/Geometry>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/patches/detail/patch_levels.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/matrix_market.h"
#include "support/free_form.h"

namespace sublimit::cli {
namespace {

/// Patches with finer nets, their columns, and how these come from the file's.
struct FineNets {
  PatchSet patches;
  Points columns;
  std::optional<SparseMatrix> P;  ///< none of level 0
};

FineNets refined_nets(LoadedPatches found, int levels, bool matrix, Progress& progress) {
  check_levels(found.patches, levels, matrix);
  FineNets nets{std::move(found.patches), std::move(found.columns), std::nullopt};
  for (int k = 1; k <= levels; ++k) {
    progress.step(fmt::format("refining to level {}", k));
    auto [fine, S] = nets.patches.refined();
    nets.columns = S * nets.columns;
    if (matrix) nets.P = nets.P ? product(S, *nets.P) : std::move(S);
    nets.patches = std::move(fine);
  }
  return nets;
}

/// Points of homogeneous columns.
Points euclidean(const PatchSet& patches, const Points& columns) {
  if (patches.coordinates() == Coordinates::plain) return columns;
  Points points(columns.rows(), 3);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    if (columns(i, 3) == 0)
      throw InvalidMesh("point " + format_number(i) +
                        " of the net has the weight 0: a direction, which a mesh cannot hold; write an " +
                        all_formats().writers_in_words({contents::free_form}, "or"));
    points.row(i) = columns.row(i).head(3) / columns(i, 3);
  }
  return points;
}

}  // namespace

void refine_free_form(const Source& source, int levels, const std::string& output, const std::string& matrix) {
  const Common& common = source.common;
  check_output_path(output, all_formats().writers({contents::free_form, contents::meshes}));
  if (!matrix.empty()) check_output_path(matrix, all_formats().writers({contents::matrices}));
  if (levels < 1 || levels > 20) throw InvalidOption(fmt::format("-l {}: 1 to 20 levels are right", levels));
  limit_threads(common);
  Progress progress(common.quiet);
  LoadedPatches loaded = load_patches(source);
  naming_mesh(common, [&] {
    const FineNets nets = refined_nets(std::move(loaded), levels, !matrix.empty(), progress);
    if (nets.P) {
      progress.step("writing " + matrix);
      write_matrix_market(matrix, *nets.P);
    }
    progress.step("writing " + output);
    if (all_formats().writes(output, contents::free_form)) {
      write_free_form(output, to_free_form(nets.patches, nets.columns));
    } else {
      PatchSet::Net net = nets.patches.net();
      Mesh mesh;
      mesh.positions = euclidean(nets.patches, nets.columns);
      mesh.face_sizes = std::move(net.sizes);
      mesh.face_vertices = std::move(net.vertices);
      write_mesh(output, mesh, progress.bytes_written());
    }
  });
}

void limit_free_form(const Source& source, int levels, const std::string& output, bool normals) {
  const Common& common = source.common;
  check_output_path(output, all_formats().writers({contents::meshes}));
  if (levels < 0 || levels > 20) throw InvalidOption(fmt::format("-l {}: 0 to 20 levels are right", levels));
  limit_threads(common);
  Progress progress(common.quiet);
  LoadedPatches loaded = load_patches(source);
  naming_mesh(common, [&] {
    const FineNets nets = refined_nets(std::move(loaded), levels, false, progress);
    progress.step("limits");
    PatchSet::Net net = nets.patches.net();
    const LimitSamples at = nets.patches.evaluate(nets.columns, net.places, normals ? 1 : 0);
    for (size_t i = 0; i < at.status.size(); ++i)
      if (!has_position(at.status[i]))
        throw InvalidMesh("point " + format_number(i) + " of the net tends to a pole: its weight is 0");
    Mesh mesh;
    mesh.positions = at.position;
    mesh.face_sizes = std::move(net.sizes);
    mesh.face_vertices = std::move(net.vertices);
    if (normals) mesh.normals = at.normal;
    if (normals && all_formats().holds(output, MeshField::corner_normals))
      for (const Index v : mesh.face_vertices) mesh.face_normals.push_back(at.normal.row(v).isZero(0) ? -1 : v);
    progress.step("writing " + output);
    write_mesh(output, mesh, progress.bytes_written());
  });
}

}  // namespace sublimit::cli
