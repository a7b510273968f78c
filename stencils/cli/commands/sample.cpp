// SPDX-License-Identifier: Apache-2.0
#include "commands/sample.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "commands/explain.h"
#include "support/curves.h"
#include "support/free_form.h"
#include "support/memory_limit.h"
#include "support/normal_surfaces.h"
#include "support/facts.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/stencils/files/random_samples.h"
#include "sublimit/stencils/files/sample_files.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

struct SampleOptions {
  SampleJob job;
  std::string grid, random_count, seed, memory_limit, explain;  // as given
};

/// A whole number on the command line. A larger one than any machine can count is the largest: it will be refused for
/// what it takes.
template <class T>
T whole(const char* option, const std::string& text, T least, const char* valid) {
  const Parsed<T> parsed = parse_number<T>(text);
  const bool huge = parsed.status == ParseStatus::too_large && text[0] != '-';
  if (huge && std::is_signed_v<T>) return std::numeric_limits<T>::max();
  if (!parsed || parsed.value < least) throw InvalidOption(fmt::format("{} {}: it should be {}", option, text, valid));
  return parsed.value;
}

SampleJob checked(const SampleOptions& options) {
  SampleJob job = options.job;
  const int places = !job.at.empty() + !options.grid.empty() + !options.random_count.empty();
  if (places != 1)
    throw InvalidOption(fmt::format("{} --at IN.csv, --grid N and --random N; one of them says where to sample",
                                    places == 0 ? "none of" : "more than one of"));
  if (!options.grid.empty())
    job.grid = whole<std::int64_t>("--grid", options.grid, 2, "a whole number of samples a side, 2 or more");
  if (!options.random_count.empty())
    job.random_count = whole<std::int64_t>("--random", options.random_count, 0, "a whole number of samples, 0 or more");
  if (!options.seed.empty()) {
    if (!job.random_count) throw InvalidOption("--seed is for --random N");
    job.seed = whole<std::uint64_t>("--seed", options.seed, 0, "a whole number from 0 to 2^64 - 1");
  }
  if (job.output.empty()) throw InvalidOption("-o OUT.csv says where the samples go; it is missing");
  if (job.clamp && job.at.empty())
    throw InvalidOption("--clamp is for --at IN.csv; no other places are outside the domain");
  if (job.curvature && job.derivatives < 2) throw InvalidOption("--curvature needs --derivatives 2");
  return job;
}

/// Samples whose number is known, before any is made.
void check_size(const SampleJob& job, const std::string& what, double count, double bytes_of_memory,
                SampleColumns columns) {
  check_memory(what, bytes_of_memory, "use fewer");
  check_disk(what, job.output, predicted_bytes(count, columns), "use fewer");
}

/// N x N samples a square, or N (N + 1) / 2 a triangle.
SampleSource grid_source(const SampleJob& job, FaceCount face_count, SampleColumns columns) {
  const double N = double(*job.grid), faces = face_count.size;
  const double count = faces * (face_count.triangles ? N * (N + 1) / 2 : N * N);
  check_size(job, fmt::format("--grid {}: samples of {} faces", *job.grid, faces), count, count * sizeof(Place),
             columns);
  auto samples = std::make_shared<std::vector<Place>>(grid_places(face_count, static_cast<int>(*job.grid)));
  return [samples, next = size_t{0}](std::vector<Place>& batch, size_t most) mutable {
    const size_t end = std::min(samples->size(), next + most);
    batch.assign(samples->begin() + std::ptrdiff_t(next), samples->begin() + std::ptrdiff_t(end));
    next = end;
  };
}

SampleSource random_source(const SampleJob& job, FaceCount faces, SampleColumns columns) {
  check_size(job, fmt::format("--random {}: samples", *job.random_count), double(*job.random_count), 0, columns);
  return [samples = RandomSamples(faces, *job.random_count, job.seed)](std::vector<Place>& batch, size_t most) mutable {
    samples.read(batch, most);
  };
}

/// `write_samples` of some source: from places with columns, telling how many are done.
using WriteSamples =
    std::function<SampleSummary(const SampleSource&, SampleColumns, const std::function<void(std::int64_t)>&)>;

/// Samples of a surface, of any kind, into the file.
SampleSummary sample_faces(const SampleJob& job, FaceCount faces, const WriteSamples& write, SampleReader* reader,
                           Progress& progress, const SampleSource& given = {}) {
  const SampleColumns columns{job.derivatives, job.curvature};
  progress.step("sampling");
  SampleSource places;
  if (given) {
    places = given;
  } else if (reader) {
    places = [&](std::vector<Place>& batch, size_t most) { reader->read(batch, most, faces); };
  } else {
    places = job.grid ? grid_source(job, faces, columns) : random_source(job, faces, columns);
  }
  SampleSummary summary =
      write(places, columns, [&](std::int64_t done) { progress.note(fmt::format("sampling: {} done", done)); });
  progress.step("");
  return summary;
}

SampleSummary sample_source(const SampleJob& job, const LinearSource& surface, const Points& points,
                            SampleReader* reader, Progress& progress, const SampleSource& given = {},
                            const OwnPlaces* own = nullptr) {
  const auto write = [&](const auto&... what) { return write_samples(job.output, surface, points, what..., own); };
  return sample_faces(job, surface.faces(), write, reader, progress, given);
}

/// @param of  what was sampled, a sentence about `source_facts`
void print_summary(const SampleJob& job, const SampleSummary& summary, const char* of,
                   std::initializer_list<Fact> source_facts, const SampleReader* reader) {
  Facts facts("sample");
  facts.say("{output}: {samples} samples", {{"output", job.output}, {"samples", summary.num_samples}});
  nlohmann::ordered_json by_status = nlohmann::ordered_json::object();
  for (size_t i = 0; i < summary.by_status.size(); ++i)
    if (summary.by_status[i] > 0) by_status[name(LimitStatus(i))] = summary.by_status[i];
  if (summary.num_samples > 0) {
    facts.say(" ({status}), ", {{"status", by_status, summary.text()}});
    facts.say(of, source_facts);
  }
  if (reader && reader->num_clamped() > 0)
    facts.say(", {clamped} moved to the rim of their face", {{"clamped", reader->num_clamped()}});
  facts.say("\n");
  facts.print(job.common);
}

/// Curves or surfaces without a scheme. A file with both has its surfaces sampled, unless curves are asked for.
void sample_patches(const SampleJob& job, const Source& source, SampleReader* reader, Progress& progress) {
  limit_threads(job.common);
  const LoadedPatches found = load_patches(source);
  SampleSource own_source;
  OwnPlaces own;
  std::unique_ptr<OwnPlaceReader> own_reader;
  if (!reader && !job.at.empty()) {
    own_reader = std::make_unique<OwnPlaceReader>(job.at);
    own_source = [&](std::vector<Place>& batch, size_t most) { own_reader->read(batch, own, most, found.patches); };
  }
  const SampleSummary summary =
      sample_source(job, found.patches, found.columns, reader, progress, own_source, own_reader ? &own : nullptr);
  print_summary(job, summary, "{faces} faces of {surfaces} surfaces",
                {{"faces", found.patches.faces().size}, {"surfaces", found.patches.members().size()}}, reader);
}

/// Surfaces through points and normals, which are not linear.
void sample_normal_surfaces(const SampleJob& job, const Source& source, SampleReader* reader, Progress& progress) {
  const std::vector<NormalSurface> loaded = load_normal_surfaces(source, progress);
  std::vector<std::shared_ptr<const PlacedSurface>> parts;
  for (const NormalSurface& part : loaded) parts.push_back(part.scheme.surface(part.data));
  const std::shared_ptr<const PlacedSurface> surface = placed_together(std::move(parts));
  const auto write = [&](const auto&... what) { return write_samples(job.output, *surface, what...); };
  const SampleSummary summary = sample_faces(job, surface->faces(), write, reader, progress);
  print_summary(job, summary, "{patches} patches", {{"patches", surface->faces().size}}, reader);
}

void sample_mesh(const SampleJob& job, const Source&, SampleReader* reader, Progress& progress) {
  const Loaded loaded = load(job.common, progress);
  check_mesh_memory(job.common.mesh, loaded.mesh);
  const auto types = std::make_shared<LimitCache>(*loaded.scheme);
  SampleSummary summary;
  naming_mesh(job.common, [&] {
    const LimitMap surface(*loaded.scheme, loaded.mesh, loaded.rules, types);
    summary = sample_source(job, surface, loaded.mesh.positions, reader, progress);
  });
  print_summary(job, summary, "{types} types of pieces", {{"types", types->pieces().size()}}, reader);
}

/// Prints the way to the limit at one place of a mesh.
int explain(const SampleOptions& options) {
  const SampleJob& job = options.job;
  if (!job.output.empty() || !job.at.empty() || !options.grid.empty() || !options.random_count.empty() ||
      !options.seed.empty() || job.derivatives > 0 || job.curvature || job.clamp || job.curves)
    throw InvalidOption(
        "--explain prints how the point at one place comes about; leave out --at, --grid, --random, --seed, "
        "--derivatives, --curvature, --clamp, --curves and -o");
  limit_memory(options.memory_limit);
  const Place place = explained_place(options.explain);
  (void)load_source(job.common, {"sample --explain", {SourceKind::mesh}});
  Progress progress(job.common.quiet);
  const Loaded loaded = load(job.common, progress);
  naming_mesh(job.common, [&] {
    const LimitMap surface(*loaded.scheme, loaded.mesh, loaded.rules);
    fmt::print("{}", explanation(surface, loaded.mesh.positions, place));
  });
  return 0;
}

int run(const SampleOptions& options) {
  if (!options.explain.empty()) return explain(options);
  const SampleJob job = checked(options);
  limit_memory(options.memory_limit);
  const Source source = load_source(
      job.common, {"sample", {SourceKind::mesh, SourceKind::curves, SourceKind::normals, SourceKind::patches}});
  if (source.kind == SourceKind::curves) return sample_curves(job);
  if (job.curves && !source.has_shapes())
    throw InvalidOption("--curves is for free-form files and recipes, without -s SCHEME");
  if (job.curves || source.has_curves_alone()) return sample_patch_curves(job, source);
  check_output_path(job.output, all_formats().writers({contents::rows, contents::arrays}));
  std::unique_ptr<SampleReader> reader;  // a wrong header is told before a large mesh is read
  const bool own_places = source.kind == SourceKind::patches && !job.at.empty() && has_own_places(job.at, "patch");
  if (own_places && job.clamp) throw InvalidOption("--clamp is for places face,u,v; " + job.at + " has patch,u,v");
  if (!job.at.empty() && !own_places) reader = std::make_unique<SampleReader>(job.at, job.clamp);
  Progress progress(job.common.quiet);
  const auto sample = source.kind == SourceKind::normals   ? sample_normal_surfaces
                      : source.kind == SourceKind::patches ? sample_patches
                                                           : sample_mesh;
  sample(job, source, reader.get(), progress);
  return 0;
}

}  // namespace

Command add_sample(CLI::App& app) {
  auto* command =
      app.add_subcommand("sample", "Evaluate the exact limit anywhere: points, derivatives, normals, curvature");
  auto options = std::make_shared<SampleOptions>();
  SampleJob& job = options->job;
  add_mesh(*command, job.common, false);
  command->add_option(
      "--at", job.at,
      "Places from a CSV with the header face,u,v (curves segment,t), or an .npy with these columns; of free-form files and recipes also "
      "patch,u,v[,side] (curve,t[,side]), their own parameters, which derivatives are then per unit of");
  command->add_option("--grid", options->grid,
                      "N x N places a face, ends included, u fastest; triangles N (N + 1) / 2");
  command->add_option("--random", options->random_count, "N places, uniform over faces and parameters");
  command->add_option("--seed", options->seed, "Of --random: the same places for a seed everywhere (default 0)");
  command->add_option("--derivatives", job.derivatives, "0, 1: with columns xu,..., 2: with xuu,... too (default 0)")
      ->check(CLI::Range(0, 2));
  command->add_flag("--curvature", job.curvature,
                    "Columns k1,k2,gauss,mean: principal curvatures k1 >= k2, Gauss and mean; needs --derivatives 2");
  command->add_flag("--clamp", job.clamp,
                    "Places of --at outside their face are moved to its rim (default: an error that names the row)");
  command->add_option("--explain", options->explain,
                      "FACE,U,V: print the way to the limit at one place: pieces, blocks, polynomial or eigenvector, "
                      "weights; nothing is written");
  command->add_option("-o,--output", job.output,
                      "OUT.csv: face,u,v,status,x,y,z[,derivatives],nx,ny,nz, or OUT.npy with these fields (required "
                      "unless --explain)");
  add_closed(*command, job.common);
  add_json(*command, job.common);
  command->add_flag("--curves", job.curves, "Of files that have both: the curves (default: the surfaces)");
  add_memory_limit(*command, options->memory_limit);
  command->footer(
      "Examples:\n"
      "  sublimit sample cage.obj -s catmull-clark --grid 5 -o points.csv\n"
      "  sublimit sample cage.obj -s loop --random 1000000 --seed 7 --derivatives 1 -o points.csv\n"
      "  sublimit sample cage.obj -s catmull-clark --at places.csv --derivatives 2 --curvature -o points.csv\n"
      "  sublimit sample cage.obj -s loop --random 1000000 -o points.npy         numpy.load(\"points.npy\")[\"x\"]\n"
      "  sublimit sample cage.obj -s loop --explain 0,0.25,0.5                   how this point comes about\n"
      "  sublimit sample teapot.obj --grid 9 --derivatives 1 -o points.csv       free-form surfaces: without a scheme\n"
      "  sublimit sample sphere.json --grid 9 --derivatives 1 -o points.csv      recipes: see `sublimit construct --help`\n"
      "\nFaces are numbered from 0 as Ptex does. A quad is one face: (0,0) at its first corner, u towards the second, v\n"
      "towards the last one. Any other polygon of n corners is n faces, one a corner: (0,0) at the corner, u towards the\n"
      "middle of the edge to the next corner, v towards the middle of the edge before, (1,1) in the centre. Under schemes\n"
      "for triangles a triangle is one face: (0,0), (1,0), (0,1) at its corners. `sublimit info MESH -s SCHEME` counts\n"
      "them. Derivatives are per unit of u and v.\n"
      "\nFree-form surfaces of an .obj (cstype bezier, bspline, rat): a face is a span of both knots that is not empty, u\n"
      "fastest, surface after surface; u and v go from 0 to 1 in it. Places of --at can be patch,u,v[,side] too: surface\n"
      "and parameters of its knots; side, of u and v each + (right of a knot) or -, like +-.\n"
      "\nnielson and piper: surfaces through the vertices and normals (vn) of a mesh of triangles, one patch each:\n"
      "  sublimit sample triangles.obj -s nielson --grid 9 --derivatives 1 -o points.csv\n"
      "Recipes of these kinds are the same surfaces without -s, their triangles recipe after recipe.\n"
      "\nCurves: MESH is a .csv of points or an .obj with lines, places are segment,t: from point segment (t = 0) to the\n"
      "next; derivatives are columns xt,..., xtt,...:\n"
      "  sublimit sample polygon.csv -s four-point --grid 9 --derivatives 2 -o curve.csv\n"
      "\nCurves of a free-form .obj (curv) or of recipes: places are segment,t, by the spans of their knots, or\n"
      "curve,t[,side]: number of the curve and parameter of its knots; side + (right of a knot) or -:\n"
      "  sublimit sample arcs.json --at places.csv --derivatives 1 -o curve.csv\n"
      "\nStatus: regular; extraordinary (a smooth corner of another valence: no derivatives, but a normal); unbounded-second\n"
      "(no second derivatives); crease (derivatives and normal of this face's side); hole; undefined-normal. What does not\n"
      "exist is an empty field.\n"
      "\nOUT.npy is an array of records with the columns of OUT.csv as fields: face, segment, ... int64, status and side\n"
      "texts, all others float64; what does not exist is not-a-number. IN.npy has records with the fields of IN.csv, any\n"
      "others are left out, or rows x columns of numbers.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
