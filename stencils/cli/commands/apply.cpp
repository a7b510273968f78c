// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/stencils/bake/detail/applied_points.h"
#include "sublimit/stencils/bake/detail/table_info.h"
#include "sublimit/stencils/bake/detail/table_mesh.h"
#include "sublimit/stencils/files/frames.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/npy.h"
#include "support/common.h"
#include "support/free_form.h"
#include "support/table_applier.h"

namespace sublimit::cli {
namespace {

struct ApplyOptions {
  Common common;
  std::string table, points, output;
  bool any_cage = false, gpu = false;
  std::optional<int> device;
};

std::string cage_of(const TableInfo& info, std::int64_t points) {
  return fmt::format("{} of a cage of {} points", info.scheme.empty() ? "a table" : info.scheme + " table", points);
}

/// That the points are those of the table's cage, as far as the file tells.
void check_cage(const ApplyOptions& options, const TableInfo& info, std::int64_t points, const FrameReader& frames) {
  if (frames.num_points() != points)
    throw InvalidMesh(fmt::format("{}: {} points, and {} is a {}; give the points of that cage, in its order",
                                  options.points, frames.num_points(), options.table, cage_of(info, points)));
  if (options.any_cage || !frames.mesh() || info.topology_hash == 0) return;
  if (frames.mesh()->num_faces() == 0) return;  // points alone
  if (!baked_cage(*frames.mesh(), info))
    throw InvalidMesh(
        fmt::format("{}: its faces are others than those of the cage that {} was baked from ({}); bake a table of this "
                    "mesh, or, if its points are the same in the same order, give --any-cage",
                    options.points, options.table, cage_of(info, points)));
}

/// Points of a table's control points: of a table of patches, columns of a file's free-form surfaces.
FrameReader frames_of(const ApplyOptions& options, const TableInfo& info) {
  const bool is_shapes = all_formats().reads(options.points, contents::free_form) ||
                         all_formats().reads(options.points, contents::recipes);
  if (info.scheme != free_form_scheme || !is_shapes) return FrameReader(options.points);
  Common common = options.common;
  common.mesh = options.points;
  LoadedPatches found = load_patches(load_source(common, {"apply", {SourceKind::patches}}));
  if (!options.any_cage && info.topology_hash != 0 && found.patches.hash() != info.topology_hash)
    throw InvalidMesh(
        fmt::format("{}: its surfaces have other knots, degrees or control points than those that {} was baked from; "
                    "bake a table of this file, or, if its points are the same in the same order, give --any-cage",
                    options.points, options.table));
  std::vector<std::string> names{"x", "y", "z"};
  if (found.columns.cols() == 4) names.emplace_back("w");
  return FrameReader(options.points, std::move(found.columns), std::move(names));
}

/// That there are weights to divide by.
void check_columns(const ApplyOptions& options, const TableInfo& info, const FrameReader& frames) {
  if (info.rational && frames.num_channels() != 4)
    throw InvalidOption(fmt::format("{}: {} channels; {} is rational: give columns w x, w y, w z, w, or the .obj",
                                    options.points, frames.num_channels(), options.table));
}

/// The one frame of a mesh or CSV.
void check_one_frame(const ApplyOptions& options, const FrameReader& frames) {
  if (frames.num_frames() != 1)
    throw InvalidOption(fmt::format("{} holds {} frames and {} one; write an .npy", options.points, frames.num_frames(),
                                    options.output));
}

/// A frame of homogeneous columns as an evaluation.
template <class Real>
Evaluation<Real> rational_evaluation(std::span<const Real> columns, std::int64_t num_control_points) {
  Evaluation<Real> e;
  e.channels = 4;
  e.points = columns;
  e.rational = true;
  e.least_weight = noise_of_weights(e, num_control_points);
  return e;
}

/// What applies the table where the options say.
template <class Real>
std::unique_ptr<TableApplier<Real>> applier_of(const ApplyOptions& options, const PatternTable<Real>& table) {
  if (!options.gpu) return cpu_applier(table);
  if constexpr (std::is_same_v<Real, float>)
    return gpu_applier(table, options.device.value_or(0));
  else
    throw InvalidOption(
        fmt::format("{} is in double, and GPUs apply tables in float; bake one with --precision float, "
                    "or leave out --gpu to apply this one on the CPU",
                    options.table));
}

/// Points, quotients of columns if the table is rational.
template <class Real>
void apply_frame(const TableApplier<Real>& applier, bool rational, std::span<const Real> points, int channels,
                 std::span<Real> values) {
  if (!rational) return applier.apply(points, channels, values);
  Evaluation<Real> e = rational_evaluation(points, applier.table().num_control_points());
  const size_t quantity = values.size() / size_t(applier.table().quantities());
  for (size_t q = 0; q < size_t(applier.table().quantities()); ++q)
    e.quantities[q] = values.subspan(q * quantity, quantity);
  applier.apply(e);
}

/// @throws InvalidMesh  a value is larger than numbers of this type are
/// @param values  of one frame, quantity after quantity
template <class Real>
void check_range(const ApplyOptions& options, std::int64_t frame, std::span<const Real> values, std::int64_t points,
                 int channels) {
  bool finite = true;  // to the end: a loop without a way out takes several numbers at once
  for (const Real x : values) finite &= x - x == 0;
  if (finite) return;
  const auto bad = std::ranges::find_if(values, [](Real x) { return !std::isfinite(x); });
  const std::int64_t row = (bad - values.begin()) / channels;
  throw InvalidMesh(fmt::format(
      "{}: frame {}: {} of point {} of the table is larger than numbers in {} are; give points in another unit{}",
      options.points, frame, row < points ? "the position" : "a derivative", row % points,
      std::is_same_v<Real, float> ? "float" : "double",
      std::is_same_v<Real, float> ? ", or bake a table in double" : ""));
}

/// Where the weight is zero within rounding.
template <class Real>
std::vector<std::uint8_t> poles_of(const TableApplier<Real>& applier, std::span<const Real> columns) {
  const PatternTable<Real>& table = applier.table();
  const Real noise = rational_evaluation(columns, table.num_control_points()).least_weight;
  std::vector<Real> weights(size_t(table.num_points()));
  Evaluation<Real> e;
  e.channels = 1;
  e.points = columns.subspan(3);
  e.point_layout = PointLayout::interleaved(4);
  e.quantities[0] = weights;
  applier.apply(e);
  std::vector<std::uint8_t> poles(weights.size());
  for (size_t i = 0; i < poles.size(); ++i) poles[i] = !(std::abs(weights[i]) > noise);
  return poles;
}

template <class Real>
void write_one(const ApplyOptions& options, const BakedTable<Real>& table, const TableApplier<Real>& applier,
               const FrameReader& frames, std::vector<std::uint8_t> poles, std::span<const Real> values,
               Progress& progress) {
  AppliedPoints applied(table);
  std::vector<std::string> names = frames.columns();
  if (table.info.rational) names.pop_back();
  if (std::ranges::any_of(poles, [](std::uint8_t p) { return p != 0; })) applied.set_poles(std::move(poles));
  if (all_formats().writes(options.output, contents::rows)) {
    applied.write_csv(options.output, names, values, progress.bytes_written());
    return;
  }
  Mesh mesh = applied.mesh(faces_of(table), values);
  if (mesh.normals.rows() > 0 &&
      all_formats().holds(options.output, MeshField::corner_normals))  // which leaves out those that do not exist
    for (const Index v : mesh.face_vertices) mesh.face_normals.push_back(mesh.normals.row(v).isZero(0) ? -1 : v);
  if (all_formats().holds(options.output, MeshField::face_varying)) add_channels(mesh, table);
  if (frames.mesh() && !table.info.rational)
    carry_attributes<Real>(
        table, *frames.mesh(),
        [&](std::span<const Real> points, int channels, std::span<Real> sums) {
          applier.apply(points, channels, sums);
        },
        mesh);
  write_mesh(options.output, mesh, progress.bytes_written());
  progress.step("");
  tell_left_out(options.common, options.output, mesh, {});
  if (frames.mesh() && carries_face_attributes(*frames.mesh()) && !carries_face_attributes(mesh) &&
      !options.common.quiet)
    fmt::print(stderr,
               "sublimit: note: {}: names and values of faces are left out: {} does not know which faces of the "
               "cage its faces come from; `sublimit refine` and `limit` keep them\n",
               options.output, options.table);
}

/// Frames x quantities x points x channels, dimensions of one frame and of one quantity left out.
std::vector<std::int64_t> shape_of(const FrameReader& frames, int channels, int quantities, std::int64_t points) {
  std::vector<std::int64_t> shape;
  if (frames.has_frames()) shape.push_back(frames.num_frames());
  if (quantities > 1) shape.push_back(quantities);
  shape.push_back(points);
  shape.push_back(channels);
  return shape;
}

struct Applied {
  std::int64_t frames = 0;
  std::string device;  ///< empty: the CPU
};

template <class Real>
Applied apply_table(const ApplyOptions& options, const BakedTable<Real>& table, Progress& progress) {
  FrameReader frames = frames_of(options, table.info);
  const PatternTable<Real>& t = table.table;
  const bool rational = table.info.rational;
  const int channels = frames.num_channels() - (rational ? 1 : 0);  // of results
  check_columns(options, table.info, frames);
  check_cage(options, table.info, t.num_control_points(), frames);
  const bool to_array = all_formats().writes(options.output, contents::arrays);
  if (!to_array) check_one_frame(options, frames);
  if (!to_array && !all_formats().writes(options.output, contents::rows) && channels != 3)
    throw InvalidOption(fmt::format("{} has {} channels and a mesh has x, y, z; write an .npy or .csv", options.points,
                                    frames.num_channels()));
  const double numbers = double(t.quantities()) * double(t.num_points()) * channels;
  check_memory(fmt::format("{} points of {} channels", t.num_points(), channels), numbers * sizeof(Real),
               "use a table of fewer points");
  check_disk(fmt::format("{} frames", frames.num_frames()), options.output,
             numbers * double(frames.num_frames()) * (to_array ? sizeof(Real) : 8), "use fewer frames");
  progress.step("preparing " + options.table);
  const std::unique_ptr<TableApplier<Real>> applier = applier_of(options, t);
  std::unique_ptr<NpyWriter> array;
  if (to_array)
    array = std::make_unique<NpyWriter>(options.output, dtype_of<Real>(),
                                        shape_of(frames, channels, t.quantities(), t.num_points()));
  std::vector<double> read(size_t(frames.num_points()) * size_t(frames.num_channels()));
  std::vector<Real> points(read.size()), values(static_cast<size_t>(numbers));
  for (std::int64_t frame = 0; frame < frames.num_frames(); ++frame) {
    progress.note(fmt::format("applying: frame {} of {}", frame + 1, frames.num_frames()));
    frames.next(read);
    std::copy(read.begin(), read.end(), points.begin());
    if (const auto bad = std::find_if(points.begin(), points.end(), [](Real x) { return !std::isfinite(x); });
        bad != points.end())
      throw InvalidMesh(fmt::format("{}: frame {}, point {}: {} is too large for a table in float; bake one in double",
                                    options.points, frame, (bad - points.begin()) / frames.num_channels(),
                                    format_number(read[size_t(bad - points.begin())])));
    apply_frame<Real>(*applier, rational, points, frames.num_channels(), values);
    if (!rational) check_range<Real>(options, frame, values, t.num_points(), channels);  // there poles have no point
    if (array) array->write<Real>(values);
  }
  progress.step("writing " + options.output);
  if (array)
    array->commit();
  else
    write_one<Real>(options, table, *applier, frames,
                    rational ? poles_of<Real>(*applier, points) : std::vector<std::uint8_t>{}, values, progress);
  return {frames.num_frames(), applier->device()};
}

int run(const ApplyOptions& options) {
  check_output_path(options.output, all_formats().writers({contents::meshes, contents::arrays, contents::rows}));
  if (options.device && !options.gpu)
    throw InvalidOption(
        fmt::format("--device {} is for --gpu; give both, or neither to apply the table on the CPU", *options.device));
  limit_threads(options.common);
  Progress progress(options.common.quiet);
  progress.step("reading " + options.table);
  const auto start = std::chrono::steady_clock::now();
  const AnyTable table = load_table(options.table);
  const Applied applied = std::visit([&](const auto& found) { return apply_table(options, found, progress); }, table);
  progress.step("");
  if (options.common.quiet) return 0;
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const auto [points, quantities] = std::visit(
      [](const auto& found) { return std::pair(found.table.num_points(), found.table.quantities()); }, table);
  fmt::print("{}: {} points{}{}; {:.3f} s{}\n", options.output, points,
             quantities == 1   ? ""
             : quantities == 3 ? " with first derivatives"
                               : " with first and second derivatives",
             applied.frames == 1 ? "" : fmt::format(", {} frames", applied.frames), time.count(),
             applied.device.empty() ? "" : " on " + applied.device);
  return 0;
}

}  // namespace

Command add_apply(CLI::App& app) {
  auto* command = app.add_subcommand("apply", "Compute new points from a table and the points of its cage");
  auto options = std::make_shared<ApplyOptions>();
  command->add_option("TABLE", options->table, "What `sublimit bake` made")->required();
  command
      ->add_option(
          "POINTS", options->points,
          "Points of the cage: the vertices of an .obj, .ply, .off or .stl; the lines of a .csv; an .npy of vertices "
          "x channels or frames x vertices x channels. Of rational free-form surfaces columns w x, w y, w z, w")
      ->required();
  command
      ->add_option(
          "-o,--output", options->output,
          "OUT.obj or OUT.ply: a mesh, with normals if the table has derivatives; an .obj has the table's texture "
          "coordinates and tags; OUT.csv; OUT.npy")
      ->required();
  command->add_flag("--any-cage", options->any_cage, "Take a mesh with other faces than those of the table's cage");
  command->add_flag("--gpu", options->gpu, "On a GPU, by Vulkan or CUDA; of tables in float");
  command->add_option("--device", options->device, "With --gpu: its number (default 0), see `sublimit devices`");
  add_run(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit apply level3.safetensors cage.obj -o level3.obj\n"
      "  sublimit apply limit.safetensors pose.csv -o surface.csv\n"
      "  sublimit apply level3.safetensors animation.npy -o refined.npy\n"
      "  sublimit apply level3.safetensors animation.npy --gpu -o refined.npy\n"
      "  sublimit apply teapot.safetensors teapot.obj -o points.csv               free-form surfaces\n"
      "\nFrames of an .npy are read, applied and written one by one, so that any number of them takes the memory of one.\n"
      "OUT.npy is in the table's precision: [frames x] [quantities x] points x channels; quantities, if there are\n"
      "derivatives, are position, u, v[, uu, uv, vv]. Columns of OUT.csv: face,u,v and status where the table knows\n"
      "them, then x,y,z[,xu,...][,nx,ny,nz] as `sample` has them, or the channels' own names. Where creases meet, and in\n"
      "tables by rows, two tangents of the surface stand for first derivatives that do not exist. Tables of rational\n"
      "surfaces divide by the weight; where it is zero the status is `pole` and nothing else is there.\n"
      "\n--gpu makes the same points to the rounding of floats. Where there is no GPU, or the table is in double, it is an\n"
      "error: the CPU never takes over.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
