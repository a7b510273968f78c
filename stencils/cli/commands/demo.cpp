// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/table_info.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/files/random_samples.h"
#include "sublimit/stencils/files/sample_files.h"
#include "sublimit/stencils/patterns/demo_mesh.h"
#include "sublimit/stencils/picture/picture_mesh.h"
#include "sublimit/surface/limit_map.h"
#include "support/common.h"

namespace sublimit::cli {
namespace {

struct DemoOptions {
  Common common;
  std::string directory = "sublimit-demo";
};

/// The control mesh with dots at its extraordinary vertices.
PictureMesh control_picture(const Level& level, const Points& points) {
  const Topology& t = level.topology();
  PictureMesh picture = wire_picture(level, points);
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const HalfEdge h = t.outgoing(Vertex{v});
    if (exists(h) && t.num_faces(Vertex{v}) != (exists(t.twin(h)) ? 4 : 2)) picture.dots.push_back(v);
  }
  return picture;
}

int run(const DemoOptions& options) {
  const std::filesystem::path directory = options.directory;
  make_output_directory(options.directory);
  const auto path = [&](const char* name) { return (directory / name).string(); };
  check_output_path(path("picture.svg"), {});

  limit_threads(options.common);
  Progress progress(options.common.quiet);
  progress.step("refining and taking limits");
  const Mesh mesh = demo_mesh();
  const Scheme<double> scheme = scheme_or_throw("catmull-clark");
  const std::vector<Level> levels = refine(scheme, mesh, 3);
  std::vector<Points> points{mesh.positions};
  for (size_t k = 1; k < levels.size(); ++k) points.push_back(apply(levels[k].S, points.back()));
  LimitCache cache(scheme);
  const LimitMatrices limit = limit_matrices(levels[3], cache);
  const LimitPoints at_limit = limit_points(limit, levels[3].topology(), points[3]);
  const Mesh surface = limit_mesh(levels[3], limit, at_limit, Normals::per_corner);

  write_mesh(path("control.obj"), mesh);
  write_mesh(path("refined.obj"), level_output(levels[2], points[2], mesh, {}, true));
  write_mesh(path("limit.obj"), surface);
  AtomicFile targets(path("targets.csv"));  // for `sublimit fit`: the limit shall go through the control points
  targets.write("vertex,x,y,z\n");
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    std::string row = format_number(v);
    for (const double x : mesh.positions.row(v)) row += "," + format_number(x);
    targets.write(row + "\n");
  }
  targets.commit();
  const LimitMap anywhere(scheme, mesh);
  RandomSamples places(anywhere.addresses(), 1000, 0);
  const SampleSummary samples =
      write_samples(path("samples.csv"), anywhere, mesh.positions,
                    [&](std::vector<Place>& batch, size_t most) { places.read(batch, most); }, {.derivatives = 2});
  const std::string svg = svg_picture(
      {{{control_picture(levels[0], points[0])}, "control mesh", fmt::format("{} points", points[0].rows())},
       {{wire_picture(levels[1], points[1])},
        "one level",
        fmt::format("S is {} x {}", levels[1].S.rows(), levels[1].S.cols())},
       {{surface_picture(surface)}, "exact limit", fmt::format("{} points and normals", at_limit.position.rows())}});
  AtomicFile picture(path("picture.svg"));
  picture.write(svg);
  picture.commit();
  // The same level 2 from a table, which needs the points of the mesh and nothing else.
  Patterns patterns(scheme);
  const Baked baked = bake_level(patterns, mesh, 2);
  save_table(path("level2.safetensors"), in_float(baked.table));
  progress.step("");
  if (options.common.quiet) return 0;

  const Topology& t = levels[0].topology();
  const auto undefined = std::count(at_limit.status.begin(), at_limit.status.end(), LimitStatus::undefined_normal);
  fmt::print("A coffee pot: {} vertices, {} faces of 3 to {} corners, {} creases, {} corner.\n", t.num_vertices(),
             t.num_faces(), *std::max_element(mesh.face_sizes.begin(), mesh.face_sizes.end()), mesh.creases.size(),
             mesh.corners.size());
  fmt::print("Catmull-Clark's masks filled three matrices, one a level:\n");
  for (int k = 1; k <= 3; ++k)
    fmt::print("  x_{} = S_{} x_{}: S_{} is {} x {} with {} nonzeros\n", k, k - 1, k - 1, k - 1, levels[k].S.rows(),
               levels[k].S.cols(), levels[k].S.nonZeros());
  fmt::print("Eigenvectors of {} local matrices gave the exact limit of all {} points of level 3,\n", cache.num_types(),
             at_limit.position.rows());
  fmt::print("and {} normals, one for each side of a crease ({} have none).\n", limit.side_vertex.size(), undefined);
  fmt::print("Anywhere on the surface: {} random places with their derivatives ({}).\n", samples.num_samples,
             samples.text());
  fmt::print("Files: {}, refined.obj (level 2, with the tags that are left),\n", path("control.obj"));
  fmt::print(
      "  limit.obj (points and normals on the surface), targets.csv, samples.csv, level2.safetensors, and the picture of all three meshes:\n");
  fmt::print("  {}\n", std::filesystem::absolute(directory / "picture.svg").string());
  return 0;
}

}  // namespace

Command add_demo(CLI::App& app) {
  auto* command = app.add_subcommand("demo", "Run the whole chain on a mesh that the program carries");
  auto options = std::make_shared<DemoOptions>();
  command->add_option("DIR", options->directory, "Where the files go (default: sublimit-demo)");
  add_run(*command, options->common);
  command->footer("Examples:\n  sublimit demo\n  sublimit demo out/demo\n  sublimit demo --threads 1 --quiet");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
