// SPDX-License-Identifier: Apache-2.0
#pragma once
// Code that subcommands share: options, loading a mesh with its tags, progress.
#include <CLI/CLI.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "support/mesh_options.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/jobs/detail/refined_job.h"

namespace sublimit::cli {

/// Options that every subcommand with a mesh and a scheme has.
struct Common {
  std::string mesh, scheme;
  std::string boundary, creasing, triangles, face_varying;  ///< empty: the file's tags
  std::string attributes;                                   ///< empty: smooth
  std::vector<std::string> options;                         ///< name=value
  int threads = 0;                                          ///< 0: all
  bool quiet = false, strict = false;
  bool json = false;  ///< facts as JSON
  bool triangulate = false, no_creases = false, orient = false, crease_smoothing_groups = false;
  std::optional<double> crease_angle;  ///< degrees
  std::string sidecar;                 ///< a path; empty: MESH.json if it is one; none: no sidecar
  bool closed = false;                 ///< curves of a CSV are closed
};

using Loaded = MeshJob;
class Progress;

/// Writes a mesh that was made of another one and tells what the format has no place for.
void write_output(const Common& common, const std::string& path, const Mesh& out, const Mesh& control,
                  Progress& progress);
/// Tells what the format of a path has no place for.
/// @param control  the mesh that `out` was made of: it may have texture coordinates that `out` has not
void tell_left_out(const Common& common, const std::string& path, const Mesh& out, const Mesh& control);

/// Progress: a line on stderr while a step takes longer than a second, if stderr is a terminal. It has the part of the
/// parallel loop that runs if that takes longer than a second, too.
///
/// With SUBLIMIT_PROGRESS=always in the environment each step is told at once, and where stderr is no terminal, such as
/// in the log of a batch job, in lines of their own: one when a step begins, then one every ten seconds.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  /// Starts a step with this description; an empty one ends the last step.
  void step(const std::string& what);
  /// Changes the description of the current step.
  void note(const std::string& what);
  /// Returns a function for writers, or readers, which reports the number of bytes of this step done so far.
  std::function<void(std::int64_t)> bytes_written() {
    return [this](std::int64_t bytes) { bytes_ = bytes; };
  }

 private:
  void watch();
  void clear();
  void show(std::chrono::steady_clock::time_point now);

  std::mutex mutex_;
  std::condition_variable woken_;
  std::string what_;
  std::chrono::steady_clock::time_point start_;
  std::atomic<std::int64_t> bytes_ = 0;  // bytes that this step has written
  std::int64_t loops_ = 0;               // number of the parallel loop that runs
  std::chrono::steady_clock::time_point loop_start_, shown_;
  bool is_terminal_ = false, always_ = false;
  bool done_ = false, visible_ = false;
  std::thread watcher_;  // runs only if the line may be shown
};

/// Adds options to a subcommand: `add_run` --threads and --quiet, `add_mesh` the options of mesh and scheme.
void add_run(CLI::App& command, Common& common);
void add_mesh(CLI::App& command, Common& common, bool scheme_required);
/// Adds --attributes, for subcommands that write meshes.
void add_attributes(CLI::App& command, Common& common);

/// Returns the request that the options make.
MeshRequest request_of(const Common& common);
/// Returns the scheme's options that the command line gives, by name.
SchemeOptions given_options(const Common& common);

/// Limits the rest of the run to the number of --threads.
void limit_threads(const Common& common);

/// Reads the mesh and its sidecar, prints warnings, and finds the scheme if one was named.
Loaded load(const Common& common, Progress& progress);

/// Returns a function for `refine`, which reports each of `count` levels.
std::function<void(int)> telling_levels(Progress& progress, int count);

/// Returns levels 0 to `count` of the mesh.
std::vector<Level> refined_levels(const Loaded& loaded, int count, Progress& progress);

/// Returns the points of the last level from those of the first.
Points refined_points(const std::vector<Level>& levels, const Points& control);

/// Reads an option that is a distance above 0, or a percentage of a length: "0.01", "0.1%".
/// @param diagonal  diagonal of the control mesh's bounding box, to which percentages refer
/// @throws InvalidOption  another text; the message names the option
double distance_option(const std::string& option, const std::string& text, double diagonal);

/// Returns true if the mesh has texture coordinates that the output format can hold.
bool has_channel(const Loaded& loaded, const std::string& output);

/// Returns the levels of the mesh's texture coordinates; empty if it has none or the output format cannot hold
/// them. If the scheme cannot refine them they are dropped with a warning, unless --face-varying asks for them.
std::vector<FaceVaryingLevel> refined_channel(const Common& common, const Loaded& loaded,
                                              const std::vector<Level>& levels, const std::string& output);

/// Calls `body`, and adds the names of mesh and scheme to its errors about the mesh.
void naming_mesh(const Common& common, const std::function<void()>& body);

/// Checks before any work that an output can be written: its extension, its directory, the permissions of an
/// existing file. An empty list accepts any extension.
void check_output_path(const std::string& path, const std::vector<std::string>& extensions);
/// Checks that an output does not overwrite the file with tags beside a mesh.
/// @param option  option that gives the output
void check_not_sidecar(const std::string& option, const std::string& path, const std::string& mesh);

/// Checks before any work that the disk of `path` has room for about so many bytes. Devices and pipes are not
/// checked.
/// @param what    the job, in the plural, for the message
/// @param advice  a remedy, for the message: "use fewer points"
/// @throws ResourceError  not enough room
void check_disk(const std::string& what, const std::string& path, double bytes, const std::string& advice);

/// Makes a directory for outputs, and its parents, unless they exist.
void make_output_directory(const std::string& path);

/// Function that runs a subcommand after its options are parsed. Returns the exit status.
using Command = std::function<int()>;
Command add_schemes(CLI::App& app);
Command add_info(CLI::App& app);
Command add_refine(CLI::App& app);
Command add_limit(CLI::App& app);
Command add_sample(CLI::App& app);
Command add_closest(CLI::App& app);
Command add_intersect(CLI::App& app);
Command add_tessellate(CLI::App& app);
Command add_flatten(CLI::App& app);
Command add_step(CLI::App& app);
Command add_construct(CLI::App& app);
Command add_implicit(CLI::App& app);
Command add_bake(CLI::App& app);
Command add_apply(CLI::App& app);
Command add_devices(CLI::App& app);
Command add_verify(CLI::App& app);
Command add_export(CLI::App& app);
Command add_analyze(CLI::App& app);
Command add_fit(CLI::App& app);
Command add_demo(CLI::App& app);

}  // namespace sublimit::cli
