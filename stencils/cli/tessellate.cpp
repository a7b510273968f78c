// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/tessellate.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "common.h"
#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/io/file_extension.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit::cli {
namespace {

struct TessellateOptions {
  Common common;
  std::string chord, angle, most, output, places;  // numbers as given
  bool normals = false;
};

/// A positive length, or so many per cent of the diagonal of the control mesh's box.
double length(const std::string& text, double diagonal) {
  const bool relative = text.ends_with('%');
  const Parsed<double> parsed = parse_number<double>(relative ? text.substr(0, text.size() - 1) : text);
  if (!parsed || !(parsed.value > 0) || !std::isfinite(parsed.value))
    throw InvalidOption(
        fmt::format("--chord {}: it should be a distance above 0, such as 0.01, or 0.1% of the mesh's "
                    "diagonal",
                    text));
  return relative ? parsed.value / 100 * diagonal : parsed.value;
}

double radians(const std::string& text) {
  if (text.empty()) return 0;
  const Parsed<double> parsed = parse_number<double>(text);
  if (!parsed || !(parsed.value > 0) || parsed.value > 180)
    throw InvalidOption(fmt::format("--angle {}: it should be degrees, above 0 and up to 180", text));
  return parsed.value * std::numbers::pi / 180;
}

std::int64_t most_triangles(const std::string& text) {
  if (text.empty()) return TessellationOptions{}.max_triangles;
  const Parsed<std::int64_t> parsed = parse_number<std::int64_t>(text);
  if (!parsed || parsed.value < 1 || parsed.value > std::numeric_limits<Index>::max())
    throw InvalidOption(fmt::format("--max-triangles {}: it should be a whole number from 1 to 2^31 - 1", text));
  return parsed.value;
}

/// Normals: of each face's own side at its corners, or one for a vertex.
void add_normals(MeshOutput& out, const Tessellation& made, const LimitSurface& surface, const Points& control,
                 bool per_corner) {
  std::vector<Sample> at = made.places;
  if (per_corner) {
    at.clear();
    for (const Tessellation::Triangle& t : made.triangles)
      for (const auto& [u, v] : t.uv) at.push_back({t.face, u, v});
  }
  out.normals = surface.evaluate(control, at, 1).normal;
  if (!per_corner) return;
  for (Index i = 0; i < out.normals.rows(); ++i) out.face_normals.push_back(out.normals.row(i).isZero(0) ? -1 : i);
}

void write_places(const std::string& path, const std::vector<Sample>& places) {
  AtomicFile file(path);
  std::string text = "face,u,v\n";
  for (const Sample& s : places) {
    text += fmt::format("{},{},{}\n", s.face, format_number(s.u), format_number(s.v));
    if (text.size() > (size_t{1} << 20)) {
      file.write(text);
      text.clear();
    }
  }
  file.write(text);
  file.commit();
}

int run(const TessellateOptions& options) {
  TessellationOptions wanted{.angle = radians(options.angle), .max_triangles = most_triangles(options.most)};
  length(options.chord, 1);  // a wrong number is told before the mesh is read
  check_output_path(options.output, {".obj", ".ply"});
  if (!options.places.empty()) check_output_path(options.places, {".csv"});
  Progress progress(options.common.quiet);
  const Loaded loaded = load(options.common, progress);
  const Points& control = loaded.mesh.positions;
  if (control.rows() > 0)
    wanted.chord = length(options.chord, (control.colwise().maxCoeff() - control.colwise().minCoeff()).norm());
  if (!(wanted.chord > 0)) throw InvalidMesh(options.common.mesh + ": no extent that --chord could be a part of");
  if (!options.common.quiet && !loaded.mesh.face_varying.empty())
    fmt::print(stderr, "sublimit: {}: texture coordinates are left out\n", options.common.mesh);
  Tessellation made;
  MeshOutput out;
  naming_mesh(options.common, [&] {
    const LimitSurface surface(*loaded.scheme, loaded.mesh, loaded.rules);
    progress.step("tessellating");
    made = tessellate(surface, control, wanted);
    if (options.normals) add_normals(out, made, surface, control, file_extension(options.output) == ".obj");
  });
  out.positions = made.points;
  out.face_sizes.assign(made.triangles.size(), 3);
  for (const Tessellation::Triangle& t : made.triangles)
    out.face_vertices.insert(out.face_vertices.end(), t.vertices.begin(), t.vertices.end());
  progress.step("writing " + options.output);
  write_mesh(options.output, out, progress.bytes_written());
  if (!options.places.empty()) write_places(options.places, made.places);
  progress.step("");
  if (!options.common.quiet)
    fmt::print("{}: {} triangles, {} points in {} cells, at most {} from the limit\n", options.output,
               made.triangles.size(), made.places.size(), made.cells, format_number(made.bound));
  return 0;
}

}  // namespace

Command add_tessellate(CLI::App& app) {
  auto* command =
      app.add_subcommand("tessellate", "Triangles near the limit: by less than a distance, proved, and without cracks");
  auto options = std::make_shared<TessellateOptions>();
  add_mesh(*command, options->common, true);
  command
      ->add_option("--chord", options->chord,
                   "Largest distance of triangles from the limit: in the mesh's unit, or as 0.1% of its diagonal")
      ->required();
  command->add_option("--angle", options->angle,
                      "Largest angle between normals in the cell of a triangle, in degrees (default: any)");
  command->add_option("--max-triangles", options->most, "Stop if more are needed (default 16777216)");
  command->add_flag("--normals", options->normals,
                    "Limit normals too: per corner in .obj (one for each side of a crease), per vertex in .ply");
  command->add_option("--places", options->places,
                      "Write the places of the points, face,u,v, for `bake --at`: a table that follows a moving mesh");
  command->add_option("-o,--output", options->output, "OUT.obj or OUT.ply; faces that are holes are left out")
      ->required();
  command->footer(
      "Examples:\n"
      "  sublimit tessellate cage.obj -s catmull-clark --chord 0.1% -o surface.obj\n"
      "  sublimit tessellate cage.obj -s loop --chord 0.005 --angle 10 --normals -o surface.ply\n"
      "  sublimit tessellate cage.obj -s catmull-clark --chord 0.1% --places places.csv -o surface.obj\n"
      "  sublimit bake cage.obj -s catmull-clark --at places.csv -o surface.safetensors    its points, every frame\n"
      "The distance is that of points with the same parameters, bounded by second derivatives; towards extraordinary\n"
      "vertices by the size of what is left. Schemes without polynomials (butterfly, kobbelt, sqrt3) have no such bounds:\n"
      "`refine` or `limit -l N` serve them.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
