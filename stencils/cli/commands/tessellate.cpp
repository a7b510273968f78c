// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/files/place_files.h"
#include "sublimit/stencils/files/rate_files.h"
#include "sublimit/stencils/files/tessellation_mesh.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/io/detail/split_mesh.h"
#include "sublimit/stencils/formats/vtu.h"
#include "sublimit/stencils/jobs/detail/refined_job.h"
#include "sublimit/tessellation/detail/bezier_cells.h"
#include "sublimit/tessellation/detail/rated_tessellation.h"
#include "sublimit/tessellation/detail/triangle_shapes.h"
#include "support/free_form.h"
#include "support/source.h"
#include "support/facts.h"

namespace sublimit::cli {
namespace {

struct TessellateOptions {
  Common common;
  std::string chord, angle, rates, most, output, places;  // numbers as given
  bool normals = false, face_ids = false;
};

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

/// What only triangles have.
void check_triangle_options(const TessellateOptions& options) {
  const auto refuse = [&](const std::string& option) {
    throw InvalidOption(fmt::format("{} is for triangles; a .vtu has the surface's own polynomials", option));
  };
  if (options.normals) refuse("--normals");
  if (options.face_ids) refuse("--face-ids, which it always has,");
  if (!options.angle.empty()) refuse("--angle");
  if (!options.places.empty()) refuse("--places");
  if (!options.rates.empty()) refuse("--rates");
}

int write_cells(const TessellateOptions& options, const Loaded& loaded, const LimitMap& surface, const Points& control,
                const TessellationOptions& wanted, Progress& progress) {
  progress.step("finding polynomials");
  BezierCells cells;
  naming_mesh(options.common, [&] { cells = bezier_cells(surface, control, wanted.chord, wanted.max_triangles); });
  progress.step("writing " + options.output);
  write_vtu(options.output, cells, surface.addresses(), progress.bytes_written());
  progress.step("");
  Mesh carried = loaded.mesh;
  carried.creases.clear(), carried.corners.clear(), carried.knot_intervals.clear(), carried.holes.clear();
  if (carried.attributes != Attributes::drop) tell_left_out(options.common, options.output, carried, {});
  Facts facts("tessellate");
  facts.say(
      "{output}: {exact_cells} exact Bezier cells, {bilinear_cells} bilinear ones where the limit is no polynomial, at "
      "most {bound} from it\n",
      {{"output", options.output},
       {"exact_cells", cells.exact},
       {"bilinear_cells", std::ssize(cells.cells) - cells.exact},
       {"bound", cells.bound}});
  facts.print(options.common);
  return 0;
}

/// Texture coordinates, where the scheme has a limit of them.
void add_texture(const TessellateOptions& options, const Loaded& loaded, const LimitMap& surface,
                 const Tessellation& made, Mesh& out) {
  if (loaded.mesh.face_varying.empty()) return;
  try {
    add_channel(out, made, *loaded.scheme, loaded.face_varying, loaded.mesh.face_varying[0], surface.level());
  } catch (const Error& error) {
    if (!may_leave_out(loaded, error)) throw;
    if (!options.common.quiet)
      fmt::print(stderr, "sublimit: warning: {}: {}\n", options.common.mesh,
                 left_out(loaded.mesh.face_varying[0], 0, error.what()));
  }
}

/// @param surface  what triangles are near
void print_summary(const TessellateOptions& options, const Tessellation& made, const char* surface) {
  const TriangleShapes shapes = triangle_shapes(made);
  Facts facts("tessellate");
  facts.say("{output}: {triangles} triangles, {points} points",
            {{"output", options.output}, {"triangles", made.triangles.size()}, {"points", made.places.size()}});
  if (!options.chord.empty())
    facts.say(" in {cells} cells, at most {bound} from the {surface}\n",
              {{"cells", made.cells}, {"bound", made.bound}, {"surface", surface}});
  else
    facts.say(" by the rates of edges\n");
  if (!made.triangles.empty()) {
    facts.say(
        "aspect ratios (longest side over shortest height): median {median_aspect_ratio}, largest "
        "{largest_aspect_ratio}",
        {three_digits("median_aspect_ratio", shapes.median_aspect),
         three_digits("largest_aspect_ratio", shapes.largest_aspect)});
    if (shapes.without_area > 0)
      facts.say("; {triangles_without_area} triangles have no area", {{"triangles_without_area", shapes.without_area}});
    facts.say("\n");
  }
  facts.print(options.common);
}

/// Checks options that need no surface.
/// @throws InvalidOption  a wrong value, options that exclude each other, another format
TessellationOptions checked(const TessellateOptions& options, bool is_mesh) {
  TessellationOptions wanted{.angle = radians(options.angle), .max_triangles = most_triangles(options.most)};
  if (options.chord.empty() && options.rates.empty())
    throw InvalidOption("--chord D, a distance, or --rates RATES.csv, segments of edges, is needed");
  if (options.chord.empty() && !options.angle.empty()) throw InvalidOption("--angle goes with --chord");
  if (!options.chord.empty())
    distance_option("--chord", options.chord, 1);  // a wrong number is told before the mesh is read
  check_output_path(options.output, all_formats().writers({contents::meshes, contents::cells}));
  const bool are_cells = all_formats().writes(options.output, contents::cells);
  if (!is_mesh && !options.rates.empty())
    throw InvalidOption("--rates is for meshes: it has segments of their edges; --chord is for patches too");
  if (!is_mesh && are_cells)
    throw InvalidOption(fmt::format("{}: cells of patches are not written as {}; {} are right", options.output,
                                    listed(all_formats().writers({contents::cells}), "or"),
                                    all_formats().writers_in_words({contents::meshes}, "and")));
  if (are_cells) check_triangle_options(options);
  if (options.face_ids && !all_formats().holds(options.output, MeshField::face_ids))
    throw InvalidOption(fmt::format("--face-ids: {} has no {}; {} have", all_formats().find(options.output)->name,
                                    name_of(MeshField::face_ids),
                                    listed(all_formats().holders(MeshField::face_ids), "and")));
  if (!options.places.empty())
    check_output_path(options.places, all_formats().writers({contents::rows, contents::arrays}));
  wanted.normals = options.normals || all_formats().find(options.output)->needs_normals;
  return wanted;
}

/// True if triangles without an area get some normal.
bool fills_normals(const TessellateOptions& options) {
  return all_formats().find(options.output)->needs_normals ||
         !all_formats().holds(options.output, MeshField::corner_normals);
}

/// The chord as a length.
/// @param control  control points, #points x 3
double chord_of(const TessellateOptions& options, const Points& control) {
  if (control.rows() == 0) return 0;
  const double diagonal = (control.colwise().maxCoeff() - control.colwise().minCoeff()).norm();
  const double chord = distance_option("--chord", options.chord, diagonal);
  if (!(chord > 0)) throw InvalidMesh(options.common.mesh + ": no extent that --chord could be a part of");
  return chord;
}

/// The places of vertices in the order of a file whose writer splits vertices.
std::vector<Place> ordered_places(const FileFormat& format, const Mesh& out, const Tessellation& made) {
  const std::vector<Place> places = places_of(split_mesh(out), made);
  std::vector<Place> ordered;
  for (const Index v : format.vertex_order(out)) ordered.push_back(places[size_t(v)]);
  return ordered;
}

/// Writes the triangles, and their places if these are asked for.
/// @param surface  what they are near
void write_triangles(const TessellateOptions& options, const Tessellation& made, Mesh out, const Mesh& control,
                     const char* surface, Progress& progress) {
  progress.step("writing " + options.output);
  std::vector<Place> places = made.places;  // in the order of the file's vertices
  const FileFormat& format = *all_formats().find(options.output);
  if (format.vertex_order) {
    if (!options.places.empty()) places = ordered_places(format, out, made);
  } else if (!all_formats().holds(options.output, MeshField::corner_normals) &&
             !(out.face_varying.empty() && out.face_normals.empty())) {
    SplitMesh split = split_mesh(std::move(out));
    out = std::move(split.mesh);
    places = places_of(split, made);
  }
  if (all_formats().writes(options.output, contents::vertex_values)) add_places(out, places);
  write_mesh(options.output, out, progress.bytes_written());
  if (!options.places.empty()) write_places(options.places, places);
  progress.step("");
  tell_left_out(options.common, options.output, out, control);
  print_summary(options, made, surface);
}

int tessellate_patches(const TessellateOptions& options, TessellationOptions wanted, const Source& source) {
  limit_threads(options.common);
  Progress progress(options.common.quiet);
  LoadedPatches loaded = load_patches(source);
  const Patches patches(std::move(loaded.patches), std::move(loaded.columns));
  wanted.chord = chord_of(options, points_in_space(patches.points()));
  Tessellation made;
  Mesh out;
  naming_mesh(options.common, [&] {
    progress.step("tessellating");
    made = tessellate(patches, wanted);
    out = tessellation_mesh(made);
    if (options.face_ids)
      for (const Tessellation::Triangle& t : made.triangles) out.face_ids.push_back(t.face);
    if (wanted.normals) add_normals(out, made, std::move(made.normals), fills_normals(options));
  });
  write_triangles(options, made, std::move(out), {}, "patches", progress);
  return 0;
}

int run(const TessellateOptions& options) {
  const Source source = load_source(options.common, {"tessellate", {SourceKind::mesh, SourceKind::patches}});
  const bool is_mesh = source.kind == SourceKind::mesh;
  TessellationOptions wanted = checked(options, is_mesh);
  if (!is_mesh) return tessellate_patches(options, wanted, source);
  Progress progress(options.common.quiet);
  const Loaded loaded = load(options.common, progress);
  const Points& control = loaded.mesh.positions;
  const bool by_rates = options.chord.empty();
  if (!by_rates) wanted.chord = chord_of(options, control);
  std::optional<LimitMap> surface;
  naming_mesh(options.common, [&] { surface.emplace(*loaded.scheme, loaded.mesh, loaded.rules); });
  if (all_formats().writes(options.output, contents::cells))
    return write_cells(options, loaded, *surface, control, wanted, progress);
  if (!options.rates.empty()) wanted.rates = read_edge_rates(options.rates, surface->level().topology());
  Tessellation made;
  Mesh out;
  naming_mesh(options.common, [&] {
    progress.step("tessellating");
    made = by_rates ? tessellate_by_rates(*surface, control, wanted.rates, wanted.max_triangles)
                    : tessellate(*surface, control, wanted);
    out = options.face_ids ? tessellation_mesh(made, surface->addresses()) : tessellation_mesh(made);
    carry_attributes(*loaded.scheme, loaded.mesh, *surface, made, out);
    add_texture(options, loaded, *surface, made, out);
    if (wanted.normals && by_rates) made.normals = surface->evaluate(control, corner_places(made), 1).normal;
    if (wanted.normals) add_normals(out, made, std::move(made.normals), fills_normals(options));
  });
  write_triangles(options, made, std::move(out), loaded.mesh, "limit", progress);
  return 0;
}

}  // namespace

Command add_tessellate(CLI::App& app) {
  auto* command =
      app.add_subcommand("tessellate", "Make triangles within a proved distance of the limit, or of patches");
  auto options = std::make_shared<TessellateOptions>();
  add_mesh(*command, options->common, false);
  add_attributes(*command, options->common);
  add_json(*command, options->common);
  command->add_option(
      "--chord", options->chord,
      "Largest distance of triangles from the surface: in the unit of MESH, or as 0.1% of its diagonal");
  command->add_option(
      "--rates", options->rates,
      "RATES.csv: v0,v1,rate, segments of edges of the control mesh, 1 without a row; with --chord the least they have");
  command->add_option("--angle", options->angle,
                      "Largest angle between normals in the cell of a triangle, in degrees (default: any)");
  command->add_option("--max-triangles", options->most, "Stop if more are needed (default 16777216)");
  command->add_flag("--normals", options->normals,
                    "Limit normals too, one for each side of a crease; a .glb always has them");
  command->add_flag("--face-ids", options->face_ids,
                    "The face of MESH that each triangle is on: face_id of a .ply, groups face_N of an .obj; a .vtu "
                    "always has them");
  command->add_option(
      "--places", options->places,
      "Write the places of the points too, face,u,v, as `bake --at` and `sample --at` read them; a .ply has "
      "them in itself, for `bake --tessellation`");
  command
      ->add_option(
          "-o,--output", options->output,
          "OUT.obj, OUT.ply or OUT.glb: triangles; OUT.vtu, of meshes: Bezier cells for ParaView; holes are left out")
      ->required();
  command->footer(
      "Examples:\n"
      "  sublimit tessellate cage.obj -s catmull-clark --chord 0.1% -o surface.obj\n"
      "  sublimit tessellate cage.obj -s loop --chord 0.005 --angle 10 --normals -o surface.ply\n"
      "  sublimit tessellate cage.obj -s catmull-clark --chord 0.1% -o surface.ply\n"
      "  sublimit bake cage.obj -s catmull-clark --tessellation surface.ply -o surface.safetensors    for every frame\n"
      "  sublimit tessellate cage.obj -s catmull-clark --chord 0.1% -o surface.glb     normals, texture coordinates\n"
      "  sublimit tessellate cage.obj -s catmull-clark --chord 0.01% -o surface.vtu    exact polynomials, curved\n"
      "  sublimit tessellate cage.obj -s catmull-clark --rates rates.csv -o surface.obj\n"
      "  sublimit tessellate cage.obj -s catmull-clark --chord 1% --rates rates.csv -o surface.obj\n"
      "  sublimit tessellate nurbs.obj --chord 0.1% -o surface.glb\n"
      "\nRates are kept by quadrilaterals and triangles; edges of other polygons have the next even number of segments.\n"
      "No distance is proved with them alone, and every scheme is taken. With --chord edges have at least so many.\n"
      "\nPatches need no scheme: free-form .obj files and recipes. Their sides are joined where they are the same curve in\n"
      "the same parameter, up to a thousandth of the distance; where a side lies on a part of another there may be a crack\n"
      "of up to twice the distance.\n"
      "\nThe distance is that of points with the same parameters, bounded by second derivatives; towards extraordinary\n"
      "vertices by how far the limit is from an affine map of its parameters. Schemes without polynomials (butterfly,\n"
      "kobbelt, sqrt3), and those whose hulls are estimates (mid-edge-habib-warren), have no such bounds: `refine` or\n"
      "`limit -l N` serve them.\n"
      "\nTexture coordinates are carried along: `vt` of an .obj; in .ply (s, t) and .glb points on seams are written once\n"
      "for each side, with normals those on creases too, so a mesh is open there. Cells of a .vtu are each on their own.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
