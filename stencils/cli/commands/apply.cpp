// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

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
#include "support/facts.h"

namespace sublimit::cli {
namespace {

struct ApplyOptions {
  Common common;
  std::string table, points, output;
  bool any_cage = false, gpu = false;
  std::optional<int> device;
  std::string frames;
};

/// Where the results of frames go, if each has a file.
struct FrameOutputs {
  std::optional<FramePattern> pattern;  ///< none: one file
  std::vector<std::int64_t> numbers;    ///< of frames that have one
  std::string file(const ApplyOptions& options, std::int64_t frame) const {
    return pattern ? pattern->file(numbers[size_t(frame)]).string() : options.output;
  }
};

std::string cage_of(const TableInfo& info, std::int64_t points) {
  return fmt::format("{} of a cage of {} points", info.scheme.empty() ? "a table" : info.scheme + " table", points);
}

/// That the points are those of the table's cage, as far as the file tells.
void check_cage(const ApplyOptions& options, const TableInfo& info, std::int64_t points, const FrameReader& frames) {
  if (frames.num_points() != points)
    throw InvalidMesh(fmt::format("{}: {} points, and {} is a {}; give the points of that cage, in its order",
                                  frames.path().string(), frames.num_points(), options.table, cage_of(info, points)));
  if (options.any_cage || !frames.mesh() || info.topology_hash == 0) return;
  if (frames.mesh()->num_faces() == 0) return;  // points alone
  if (!baked_cage(*frames.mesh(), info))
    throw InvalidMesh(
        fmt::format("{}: its faces are others than those of the cage that {} was baked from ({}); bake a table of this "
                    "mesh, or, if its points are the same in the same order, give --any-cage",
                    frames.path().string(), options.table, cage_of(info, points)));
}

/// Columns of the control points of a file's free-form surfaces.
PointFile shape_columns(const ApplyOptions& options, const TableInfo& info, const std::string& path) {
  Common common = options.common;
  common.mesh = path;
  LoadedPatches found = load_patches(load_source(common, {"apply", {SourceKind::patches}}));
  if (!options.any_cage && info.topology_hash != 0 && found.patches.hash() != info.topology_hash)
    throw InvalidMesh(
        fmt::format("{}: its surfaces have other knots, degrees or control points than those that {} was baked from; "
                    "bake a table of this file, or, if its points are the same in the same order, give --any-cage",
                    path, options.table));
  std::vector<std::string> names{"x", "y", "z"};
  if (found.columns.cols() == 4) names.emplace_back("w");
  return {std::move(found.columns), std::move(names), {}};
}

/// Numbers of the frames of a sequence that are asked for. Those that are missing are told.
std::vector<std::int64_t> numbers_of(const ApplyOptions& options, const FramePattern& pattern) {
  std::vector<std::int64_t> numbers = pattern.frames();
  std::optional<FrameRange> range;
  if (!options.frames.empty()) range = parse_frame_range(options.frames);
  const std::string all = numbers.empty() ? "" : fmt::format(" of {} to {}", numbers.front(), numbers.back());
  if (range) std::erase_if(numbers, [&](std::int64_t frame) { return frame < range->first || frame > range->last; });
  if (numbers.empty())
    throw IoError(fmt::format("{}: there is no such file{}", options.points,
                              all.empty() ? "; # stands for the digits of a frame's number"
                                          : fmt::format(" for frames {}, but{}", options.frames, all)));
  if (const std::string missing = missing_frames(numbers, range); !missing.empty() && !options.common.quiet)
    fmt::print(stderr, "sublimit: note: {}: no file for frames {}; they are left out\n", options.points, missing);
  return numbers;
}

/// Points of a table's control points: of a table of patches, columns of a file's free-form surfaces.
/// @param outputs  gets the numbers of frames
FrameReader frames_of(const ApplyOptions& options, const TableInfo& info, FrameOutputs& outputs) {
  const bool is_shapes = info.scheme == free_form_scheme && (all_formats().reads(options.points, contents::free_form) ||
                                                             all_formats().reads(options.points, contents::recipes));
  const auto columns = [&](const std::filesystem::path& path) { return shape_columns(options, info, path.string()); };
  if (const std::optional<FramePattern> pattern = FramePattern::find(options.points)) {
    outputs.numbers = numbers_of(options, *pattern);
    std::vector<std::filesystem::path> files;
    for (const std::int64_t number : outputs.numbers) files.push_back(pattern->file(number));
    return is_shapes ? FrameReader(std::move(files), columns) : FrameReader(std::move(files));
  }
  if (is_shapes) {
    if (!options.frames.empty())
      throw InvalidOption("--frames: " + options.points + " holds one frame, without a number");
    PointFile file = columns(options.points);
    return FrameReader(options.points, std::move(file.points), std::move(file.columns));
  }
  FrameReader frames(options.points);
  if (!options.frames.empty()) {
    const FrameRange range = parse_frame_range(options.frames);
    frames.choose(range.first, range.last);
    outputs.numbers.resize(size_t(frames.num_frames()));
    std::iota(outputs.numbers.begin(), outputs.numbers.end(), range.first);
  } else if (frames.has_frames()) {
    outputs.numbers.resize(size_t(frames.num_frames()));
    std::iota(outputs.numbers.begin(), outputs.numbers.end(), std::int64_t{0});
  }
  return frames;
}

/// That there are weights to divide by.
void check_columns(const ApplyOptions& options, const TableInfo& info, const FrameReader& frames) {
  if (info.rational && frames.num_channels() != 4)
    throw InvalidOption(fmt::format("{}: {} channels; {} is rational: give columns w x, w y, w z, w, or the .obj",
                                    options.points, frames.num_channels(), options.table));
}

/// One frame for a file that holds one, and frames for a sequence of files.
void check_frames(const ApplyOptions& options, const FrameReader& frames, const FrameOutputs& outputs) {
  if (outputs.pattern && !frames.has_frames())
    throw InvalidOption(
        fmt::format("{} is a sequence of files and {} has one frame, without a number; give a sequence "
                    "of files, or an .npy of frames",
                    options.output, options.points));
  const bool holds_many = outputs.pattern || all_formats().writes(options.output, contents::arrays);
  if (!holds_many && frames.num_frames() != 1)
    throw InvalidOption(
        fmt::format("{} holds {} frames and {} one; write an .npy, or a sequence of files, as "
                    "out.####.obj",
                    options.points, frames.num_frames(), options.output));
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
void check_range(const std::string& path, std::int64_t frame, std::span<const Real> values, std::int64_t points,
                 int channels) {
  bool finite = true;  // to the end: a loop without a way out takes several numbers at once
  for (const Real x : values) finite &= x - x == 0;
  if (finite) return;
  const auto bad = std::ranges::find_if(values, [](Real x) { return !std::isfinite(x); });
  const std::int64_t row = (bad - values.begin()) / channels;
  throw InvalidMesh(fmt::format(
      "{}: frame {}: {} of point {} of the table is larger than numbers in {} are; give points in another unit{}", path,
      frame, row < points ? "the position" : "a derivative", row % points,
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

/// @param is_first  tell what the file does not hold
template <class Real>
void write_one(const ApplyOptions& options, const std::string& output, bool is_first, const BakedTable<Real>& table,
               const TableApplier<Real>& applier, const FrameReader& frames, std::vector<std::uint8_t> poles,
               std::span<const Real> values, Progress& progress) {
  AppliedPoints applied(table);
  std::vector<std::string> names = frames.columns();
  if (table.info.rational) names.pop_back();
  if (std::ranges::any_of(poles, [](std::uint8_t p) { return p != 0; })) applied.set_poles(std::move(poles));
  if (all_formats().writes(output, contents::rows)) {
    applied.write_csv(output, names, values, progress.bytes_written());
    return;
  }
  Mesh mesh = applied.mesh(faces_of(table), values);
  if (mesh.normals.rows() > 0 &&
      all_formats().holds(output, MeshField::corner_normals))  // which leaves out those that do not exist
    for (const Index v : mesh.face_vertices) mesh.face_normals.push_back(mesh.normals.row(v).isZero(0) ? -1 : v);
  if (all_formats().holds(output, MeshField::face_varying)) add_channels(mesh, table);
  if (frames.mesh() && !table.info.rational)
    carry_attributes<Real>(
        table, *frames.mesh(),
        [&](std::span<const Real> points, int channels, std::span<Real> sums) {
          applier.apply(points, channels, sums);
        },
        mesh);
  write_mesh(output, mesh, progress.bytes_written());
  if (!is_first) return;
  progress.step("");
  tell_left_out(options.common, output, mesh, {});
  if (frames.mesh() && carries_face_attributes(*frames.mesh()) && !carries_face_attributes(mesh) &&
      !options.common.quiet)
    fmt::print(stderr,
               "sublimit: note: {}: names and values of faces are left out: {} does not know which faces of the "
               "cage its faces come from; `sublimit refine` and `limit` keep them\n",
               output, options.table);
}

/// Frames x quantities x points x channels, dimensions of one frame and of one quantity left out.
std::vector<std::int64_t> shape_of(bool has_frames, std::int64_t frames, int channels, int quantities,
                                   std::int64_t points) {
  std::vector<std::int64_t> shape;
  if (has_frames) shape.push_back(frames);
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
  FrameOutputs outputs{FramePattern::find(options.output), {}};
  FrameReader frames = frames_of(options, table.info, outputs);
  const PatternTable<Real>& t = table.table;
  const bool rational = table.info.rational;
  const int channels = frames.num_channels() - (rational ? 1 : 0);  // of results
  check_columns(options, table.info, frames);
  check_cage(options, table.info, t.num_control_points(), frames);
  const bool is_array = all_formats().writes(options.output, contents::arrays);
  const bool to_array = is_array && !outputs.pattern;  // of all frames
  check_frames(options, frames, outputs);
  if (outputs.pattern && frames.num_frames() > 0) check_output_path(outputs.file(options, 0), {});
  if (!is_array && !all_formats().writes(options.output, contents::rows) && channels != 3)
    throw InvalidOption(fmt::format("{} has {} channels and a mesh has x, y, z; write an .npy or .csv", options.points,
                                    frames.num_channels()));
  const double numbers = double(t.quantities()) * double(t.num_points()) * channels;
  check_memory(fmt::format("{} points of {} channels", t.num_points(), channels), numbers * sizeof(Real),
               "use a table of fewer points");
  check_disk(fmt::format("{} frames", frames.num_frames()), options.output,
             numbers * double(frames.num_frames()) * (is_array ? sizeof(Real) : 8), "use fewer frames");
  progress.step("preparing " + options.table);
  const std::unique_ptr<TableApplier<Real>> applier = applier_of(options, t);
  std::unique_ptr<NpyWriter> array;
  if (to_array)
    array = std::make_unique<NpyWriter>(
        options.output, dtype_of<Real>(),
        shape_of(frames.has_frames(), frames.num_frames(), channels, t.quantities(), t.num_points()));
  std::vector<double> read(size_t(frames.num_points()) * size_t(frames.num_channels()));
  std::vector<Real> points(read.size()), values(static_cast<size_t>(numbers));
  const auto write_frame = [&](std::int64_t frame) {
    const std::string output = outputs.file(options, frame);
    if (!outputs.pattern) progress.step("writing " + output);
    if (is_array) {
      NpyWriter one(output, dtype_of<Real>(), shape_of(false, 1, channels, t.quantities(), t.num_points()));
      one.write<Real>(values);
      return one.commit();
    }
    write_one<Real>(options, output, frame == 0, table, *applier, frames,
                    rational ? poles_of<Real>(*applier, points) : std::vector<std::uint8_t>{}, values, progress);
    if (frame == 0) progress.step("applying");
  };
  for (std::int64_t frame = 0; frame < frames.num_frames(); ++frame) {
    progress.note(fmt::format("applying: frame {} of {}", frame + 1, frames.num_frames()));
    frames.next(read);
    if (frame > 0 && frames.mesh()) check_cage(options, table.info, t.num_control_points(), frames);
    std::copy(read.begin(), read.end(), points.begin());
    if (const auto bad = std::find_if(points.begin(), points.end(), [](Real x) { return !std::isfinite(x); });
        bad != points.end())
      throw InvalidMesh(fmt::format("{}: frame {}, point {}: {} is too large for a table in float; bake one in double",
                                    frames.path().string(), frame, (bad - points.begin()) / frames.num_channels(),
                                    format_number(read[size_t(bad - points.begin())])));
    apply_frame<Real>(*applier, rational, points, frames.num_channels(), values);
    if (!rational)
      check_range<Real>(frames.path().string(), frame, values, t.num_points(), channels);  // there poles have no point
    if (array)
      array->write<Real>(values);
    else
      write_frame(frame);
  }
  if (array) {
    progress.step("writing " + options.output);
    array->commit();
  }
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
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const auto [points, quantities] = std::visit(
      [](const auto& found) { return std::pair(found.table.num_points(), found.table.quantities()); }, table);
  Facts facts("apply");
  const int derivatives = quantities == 1 ? 0 : quantities == 3 ? 1 : 2;
  const char* const with[] = {"", " with first derivatives", " with first and second derivatives"};
  facts.say("{output}: {points} points{derivatives}{frames}; {seconds}",
            {{"output", options.output},
             {"points", points},
             {"derivatives", derivatives, with[derivatives]},
             {"frames", applied.frames, applied.frames == 1 ? "" : fmt::format(", {} frames", applied.frames)},
             seconds_fact("seconds", time.count())});
  if (!applied.device.empty()) facts.say(" on {device}", {{"device", applied.device}});
  facts.say("\n");
  facts.print(options.common);
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
          "Points of the cage: the vertices of a mesh; the lines of a .csv; an .npy of vertices "
          "x channels or frames x vertices x channels; pose.####.ply: a sequence of such files, # for each digit of "
          "the frame. Of rational free-form surfaces columns w x, w y, w z, w")
      ->required();
  command
      ->add_option(
          "-o,--output", options->output,
          "OUT.obj or OUT.ply: a mesh, with normals if the table has derivatives; an .obj has the table's texture "
          "coordinates and tags; OUT.csv; OUT.npy; out.####.ply: a file for each frame, with its number")
      ->required();
  command->add_option("--frames", options->frames,
                      "A-B: only these frames of a sequence of files, or of an .npy, which counts from 0");
  command->add_flag("--any-cage", options->any_cage, "Take a mesh with other faces than those of the table's cage");
  command->add_flag("--gpu", options->gpu, "On a GPU, by Vulkan or CUDA; of tables in float");
  command->add_option("--device", options->device, "With --gpu: its number (default 0), see `sublimit devices`");
  add_json(*command, options->common);
  add_run(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit apply level3.safetensors cage.obj -o level3.obj\n"
      "  sublimit apply limit.safetensors pose.csv -o surface.csv\n"
      "  sublimit apply level3.safetensors animation.npy -o refined.npy\n"
      "  sublimit apply level3.safetensors 'pose.####.ply' --frames 1-24 -o 'out.####.ply'\n"
      "  sublimit apply level3.safetensors animation.npy --gpu -o refined.npy\n"
      "  sublimit apply teapot.safetensors teapot.obj -o points.csv               free-form surfaces\n"
      "\nFrames are read, applied and written one by one, so that any number of them takes the memory of one. In\n"
      "pose.####.ply # stand for the digits of a number, with zeros in front; larger numbers have more digits. Files are\n"
      "taken in the order of their numbers, which files of OUT keep; missing ones are told. OUT.npy has all frames.\n"
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
