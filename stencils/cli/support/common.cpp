// SPDX-License-Identifier: Apache-2.0
#include "support/common.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "sublimit/base/detail/followed_links.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/loop_progress.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/source/limit_status.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/rule_of_word.h"
#include "sublimit/stencils/formats/sidecar.h"
#include "support/curves.h"

namespace sublimit::cli {
namespace {

void list(const std::vector<std::string>& messages, const char* kind, size_t most) {
  for (size_t i = 0; i < std::min(messages.size(), most); ++i)
    fmt::print(stderr, "sublimit: {}: {}\n", kind, in_words_of_the_program(messages[i]));
  if (messages.size() > most) fmt::print(stderr, "sublimit: {}: and {} more\n", kind, messages.size() - most);
}

}  // namespace

void add_run(CLI::App& command, Common& common) {
  command.add_option("--threads", common.threads, "Threads (default: all)")->check(CLI::Range(1, 4096));
  command.add_flag("--quiet", common.quiet, "No warnings, no progress");
}

SchemeOptions given_options(const Common& common) {
  SchemeOptions options = scheme_options(common.options);
  if (!common.triangles.empty()) options["triangles"] = common.triangles;
  return options;
}

void limit_threads(const Common& common) {
  if (common.threads > 0) limit_threads(common.threads);
}

void add_mesh(CLI::App& command, Common& common, bool scheme_required) {
  add_mesh_options(command,
                   {common.mesh, common.scheme, common.boundary, common.creasing, common.triangles,
                    &common.face_varying, common.options, common.triangulate, common.no_creases},
                   all_formats().readers_in_words({contents::meshes}, "or") +
                       ", or without -s free-form shapes (.obj) or recipes (.json)",
                   scheme_required);
  command.add_flag("--orient", common.orient, "First turn faces so that winding is consistent, and tell which");
  command
      .add_option("--crease-angle", common.crease_angle,
                  "First make edges sharp where the faces beside them bend by more degrees than this")
      ->check(CLI::Range(0.0, 180.0));
  command.add_flag("--crease-smoothing-groups", common.crease_smoothing_groups,
                   "First make edges between smoothing groups (s of an .obj) sharp");
  command.add_option("--sidecar", common.sidecar,
                     "Tags as JSON (default: MESH.json, if it has a key of tags); none: only those of the file");
  add_run(command, common);
  command.add_flag("--strict", common.strict, "Reject meshes that are accepted with a warning, naming each place");
}

void write_output(const Common& common, const std::string& path, const Mesh& out, const Mesh& control,
                  Progress& progress) {
  write_mesh(path, out, progress.bytes_written());
  progress.step("");
  tell_left_out(common, path, out, control);
}

void tell_left_out(const Common& common, const std::string& path, const Mesh& out, const Mesh& control) {
  using enum MeshField;
  const FileFormat* const format = all_formats().find(path);
  if (!common.quiet && format->changes)
    for (const std::string& change : format->changes(out)) fmt::print(stderr, "sublimit: note: {}: {}\n", path, change);
  std::vector<MeshField> fields = left_out(*format, out);
  // Rules and comments are not in the file that was given: refinement adds them.
  std::erase_if(fields, [](MeshField field) { return field == rules || field == comments; });
  if (out.face_varying.empty() && out.texture.rows() == 0 && !control.face_varying.empty() &&
      !all_formats().holds(path, face_varying))
    fields.push_back(face_varying);
  if (!common.quiet && !out.face_ids.empty() && !out.groups.of_face.empty() && all_formats().holds(path, groups))
    fmt::print(stderr, "sublimit: note: {}: its groups are the numbers of faces (--face-ids), not those of the mesh\n",
               path);
  if (common.quiet || fields.empty()) return;
  std::vector<std::string> names, keepers = all_formats().holders(fields.front());
  std::erase_if(keepers, [&](const std::string& extension) { return all_formats().find("x" + extension) == format; });
  for (const MeshField field : fields) {
    names.emplace_back(name_of(field));
    std::erase_if(keepers, [&](const std::string& extension) { return !all_formats().holds("x" + extension, field); });
  }
  const std::string advice =
      keepers.empty() ? "" : fmt::format("; written as {} the mesh keeps them", listed(keepers, "or"));
  fmt::print(stderr, "sublimit: note: {}: {} has no place for {}{}\n", path, format->name, listed(names, "and"),
             advice);
}

void add_attributes(CLI::App& command, Common& common) {
  command
      .add_option("--attributes", common.attributes,
                  "Colours and other values at vertices (default: smooth, refined as positions are); drop leaves out "
                  "names and values of faces, too")
      ->check(one_of(attributes_words));
}

MeshRequest request_of(const Common& common) {
  MeshRequest request;
  request.scheme = common.scheme;
  request.options = given_options(common);
  request.boundary = common.boundary, request.creasing = common.creasing, request.triangles = common.triangles;
  request.face_varying = common.face_varying, request.attributes = common.attributes;
  request.orient = common.orient, request.crease_angle = common.crease_angle;
  request.crease_smoothing_groups = common.crease_smoothing_groups;
  request.triangulate = common.triangulate, request.no_creases = common.no_creases, request.strict = common.strict;
  return request;
}

Loaded load(const Common& common, Progress& progress) {
  limit_threads(common);
  const MeshRequest request = request_of(common);
  scheme_job(request);  // a misspelt name is told before a large file is read
  progress.step("reading " + common.mesh);
  Mesh mesh;
  try {
    mesh = read_mesh(common.mesh);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::io_error) refuse_polygon(common);
    throw;
  }
  if (!common.sidecar.empty() && common.sidecar != "none")
    apply_sidecar(mesh, common.sidecar);
  else if (const auto sidecar = common.sidecar.empty() ? find_sidecar(common.mesh) : std::nullopt)
    apply_sidecar(mesh, *sidecar);
  Loaded loaded = mesh_job(request, std::move(mesh), common.mesh);
  if (common.quiet) return loaded;
  std::vector<std::string> found = faults(loaded.mesh, common.orient);
  progress.step("");
  list(loaded.mesh.warnings, "warning", 5);
  for (std::string& fault : found) fault = common.mesh + ": " + fault;
  list(found, "warning", 5);
  list(loaded.notes, "note", 5);
  return loaded;
}

std::function<void(int)> telling_levels(Progress& progress, int count) {
  return [&progress, count](int level) { progress.step(fmt::format("level {} of {}", level, count)); };
}

std::vector<Level> refined_levels(const Loaded& loaded, int count, Progress& progress) {
  return refine(*loaded.scheme, loaded.mesh, count, loaded.rules, telling_levels(progress, count));
}

Points refined_points(const std::vector<Level>& levels, const Points& control) {
  Points points = control;
  for (size_t k = 1; k < levels.size(); ++k) points = apply(levels[k].S, points);
  return points;
}

double distance_option(const std::string& option, const std::string& text, double diagonal) {
  const bool relative = text.ends_with('%');
  const Parsed<double> parsed = parse_number<double>(relative ? text.substr(0, text.size() - 1) : text);
  if (!parsed || !(parsed.value > 0) || !std::isfinite(parsed.value))
    throw InvalidOption(fmt::format(
        "{} {}: it should be a distance above 0, such as 0.01, or 0.1% of the mesh's diagonal", option, text));
  if (relative && !std::isfinite(diagonal))
    throw InvalidMesh(fmt::format(
        "{} {}: the diagonal of the mesh is no number, as its coordinates are too large; another unit of length is "
        "right",
        option, text));
  return relative ? parsed.value / 100 * diagonal : parsed.value;
}

bool has_channel(const Loaded& loaded, const std::string& output) {
  return !loaded.mesh.face_varying.empty() && all_formats().holds(output, MeshField::face_varying);
}
std::vector<FaceVaryingLevel> refined_channel(const Common& common, const Loaded& loaded,
                                              const std::vector<Level>& levels, const std::string& output) {
  if (!has_channel(loaded, output)) return {};
  std::string why_not;
  std::vector<FaceVaryingLevel> channel = refined_channel(loaded, levels, why_not);
  if (!why_not.empty() && !common.quiet)
    fmt::print(stderr, "sublimit: warning: {}: texture coordinates are left out: {}\n", common.mesh, why_not);
  return channel;
}

void naming_mesh(const Common& common, const std::function<void()>& body) {
  const std::string place = common.mesh + ": " + (common.scheme.empty() ? "" : common.scheme + ": ");
  try {
    body();
  } catch (const InvalidMesh& error) {
    throw InvalidMesh(place + error.what());
  } catch (const UnsupportedTopology& error) {
    throw UnsupportedTopology(place + error.what());
  } catch (const NoLimit& error) {
    throw Error(error.code(), place + error.what());
  } catch (const AnalysisError& error) {
    throw AnalysisError(place + error.what());
  }
}

namespace {

/// The same of a standard stream.
void check_output_stream(const StandardFile& stream, const std::vector<std::string>& extensions) {
  if (extensions.empty() || std::ranges::find(extensions, stream.extension) != extensions.end()) return;
  std::vector<std::string> words;
  for (const std::string& known : extensions) words.push_back(known.substr(1));
  throw InvalidOption(fmt::format("cannot write {} {}; {} {} right", stream.device,
                                  stream.extension.empty() ? "without --format" : "as " + stream.extension.substr(1),
                                  listed(words, "and"), words.size() == 1 ? "is" : "are"));
}

}  // namespace

void check_output_path(const std::string& path, const std::vector<std::string>& extensions) {
  if (const auto stream = standard_file(path)) return check_output_stream(*stream, extensions);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))  // whatever its name ends in
    throw IoError("cannot write " + path + ": it is a directory; name a file in it");
  const std::string extension = file_extension(path);
  std::string names;
  for (const std::string& known : extensions) names += (names.empty() ? "" : " or ") + known;
  if (!extensions.empty() && std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw InvalidOption("cannot write " + path + ": its name must end in " + names +
                        (extension.ends_with(".gz") ? "; compressed files are read, not written" : ""));
  const bool exists = std::filesystem::exists(path, ignored);
  if (exists && ::access(path.c_str(), W_OK) != 0)
    throw IoError("cannot write " + path + ": the file that is there is not writable");
  if (exists && !std::filesystem::is_regular_file(path, ignored)) return;  // written in place
  const std::filesystem::path end = exists ? std::filesystem::canonical(path, ignored) : followed_links(path);
  const std::filesystem::path directory = directory_of(end);
  const std::string link =
      std::filesystem::is_symlink(path, ignored) ? "it is a link to " + end.string() + ", and " : "";
  if (!std::filesystem::is_directory(directory, ignored))
    throw IoError("cannot write " + path + ": " + link + directory.string() + " is not a directory");
  if (::access(directory.c_str(), W_OK) != 0)
    throw IoError("cannot write " + path + ": " + (link.empty() ? "its directory" : link + directory.string()) +
                  " is not writable");
}

void check_not_sidecar(const std::string& option, const std::string& path, const std::string& mesh) {
  const auto sidecar = find_sidecar(mesh);
  if (std::error_code ignored; sidecar && std::filesystem::equivalent(*sidecar, path, ignored))
    throw InvalidOption(fmt::format("{} {}: this file holds tags of {}; choose another name", option, path, mesh));
}

void check_disk(const std::string& what, const std::string& path, double bytes, const std::string& advice) {
  std::error_code failed;
  if (standard_file(path)) return;
  if (std::filesystem::exists(path, failed) && !std::filesystem::is_regular_file(path, failed)) return;
  const std::filesystem::path directory = directory_of(followed_links(path));
  const auto room = static_cast<double>(std::filesystem::space(directory, failed).available);
  if (!failed && bytes > room)
    throw ResourceError(what + " take about " + bytes_in_words(bytes) + " of disk; " + path + " has room for " +
                        bytes_in_words(room) + "; " + advice);
}

void make_output_directory(const std::string& path) {
  std::error_code failed;
  std::filesystem::create_directories(followed_links(path), failed);
  if (failed) throw IoError("cannot make the directory " + path + ": " + failed.message());
}

namespace {

LoopProgress loop_progress;  // of the process

}  // namespace

Progress::Progress(bool quiet) : is_terminal_(::isatty(STDERR_FILENO) != 0) {
  const char* const wanted = std::getenv("SUBLIMIT_PROGRESS");
  always_ = wanted && std::string_view(wanted) == "always";
  if (quiet || !(is_terminal_ || always_)) return;
  watch_loops(&loop_progress);
  watcher_ = std::thread([this] { watch(); });
}

Progress::~Progress() {
  if (!watcher_.joinable()) return;
  watch_loops(nullptr);
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
    clear();
  }
  woken_.notify_one();
  watcher_.join();
}

void Progress::step(const std::string& what) {
  const std::lock_guard lock(mutex_);
  clear();
  what_ = what;
  bytes_ = 0;
  start_ = std::chrono::steady_clock::now();
  if (always_ && watcher_.joinable() && !what_.empty()) show(start_);
}

void Progress::note(const std::string& what) {
  const std::lock_guard lock(mutex_);
  what_ = what;
}

void Progress::watch() {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  while (!woken_.wait_for(lock, 250ms, [this] { return done_; })) {
    const auto now = std::chrono::steady_clock::now();
    if (loops_ != loop_progress.loops) {
      loops_ = loop_progress.loops;
      loop_start_ = now;
    }
    if (what_.empty() || now - start_ < 1s) continue;
    if (is_terminal_ || now - shown_ >= 10s) show(now);
  }
}

void Progress::show(std::chrono::steady_clock::time_point now) {
  using namespace std::chrono_literals;
  const std::chrono::duration<double> time = now - start_;
  const std::int64_t done = loop_progress.done, blocks = loop_progress.blocks;
  const bool is_long = loops_ == loop_progress.loops && done > 0 && done < blocks && now - loop_start_ >= 1s;
  const std::string part = is_long ? fmt::format(": {:.0f} %", 100 * double(done) / double(blocks)) : "";
  const std::string size = bytes_ > 0 ? ": " + bytes_in_words(double(bytes_)) : "";
  if (is_terminal_)
    fmt::print(stderr, "\r\033[K{}{}{} ... {:.0f} s", what_, part, size, time.count());
  else
    fmt::print(stderr, "sublimit: {}{}{} ... {:.0f} s\n", what_, part, size, time.count());
  std::fflush(stderr);
  visible_ = is_terminal_;
  shown_ = now;
}

void Progress::clear() {
  if (!visible_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  visible_ = false;
}

}  // namespace sublimit::cli
