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

#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/jobs/detail/refined_job.h"

namespace sublimit::cli {

/// Options that every subcommand with a mesh and a scheme has.
struct Common {
  std::string mesh, scheme;
  std::string boundary, creasing, triangles, face_varying;  ///< empty: the file's tags
  std::vector<std::string> options;                         ///< name=value
  int threads = 0;                                          ///< 0: all
  bool quiet = false, strict = false;
  bool triangulate = false, no_creases = false;
};

using Loaded = MeshJob;

/// A line on stderr while a step takes longer than a second, if a person is looking.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  /// A step begins; an empty one is nothing to tell.
  void step(const std::string& what);
  /// Other words for a step that goes on.
  void note(const std::string& what);
  /// Returns a function for writers, which reports the number of bytes of this step written so far.
  std::function<void(std::int64_t)> bytes_written() {
    return [this](std::int64_t bytes) { bytes_ = bytes; };
  }

 private:
  void watch();
  void clear();

  std::mutex mutex_;
  std::condition_variable woken_;
  std::string what_;
  std::chrono::steady_clock::time_point start_;
  std::atomic<std::int64_t> bytes_ = 0;  // written by this step
  bool done_ = false, visible_ = false;
  std::thread watcher_;  // only where the line may be shown
};

/// Adds --threads and --quiet, then the rest, to a subcommand.
void add_run(CLI::App& command, Common& common);
void add_mesh(CLI::App& command, Common& common, bool scheme_required);

/// The scheme's options on the command line, by name.
SchemeOptions given_options(const Common& common);

/// Holds the rest of the run to --threads.
void limit_threads(const Common& common);

/// Reads the mesh and its sidecar, prints warnings, and finds the scheme if one was named.
Loaded load(const Common& common, Progress& progress);

/// Returns a function for `refine`, which reports each of `count` levels.
std::function<void(int)> telling_levels(Progress& progress, int count);

/// Levels 0 to `count` of the mesh.
std::vector<Level> refined_levels(const Loaded& loaded, int count, Progress& progress);

/// Points of the last level, from those of the first.
Points refined_points(const std::vector<Level>& levels, const Points& control);

/// An option's distance above 0, or so many per cent of the diagonal of the control mesh's box.
/// @throws InvalidOption  no such number, naming the option
double distance_option(const std::string& option, const std::string& text, double diagonal);

/// Returns true if the mesh has texture coordinates that the output format can hold.
bool has_channel(const Loaded& loaded, const std::string& output);

/// Levels of the mesh's texture coordinates, if it has any and the output has room for them. Where the scheme cannot
/// refine them they are dropped with a warning, unless --face-varying asks for them.
std::vector<FaceVaryingLevel> refined_channel(const Common& common, const Loaded& loaded,
                                              const std::vector<Level>& levels, const std::string& output);

/// Calls `body`, and adds the names of mesh and scheme to its errors about the mesh.
void naming_mesh(const Common& common, const std::function<void()>& body);

/// A message of the library with the options that would help, behind what they would do, and verbs as they are typed.
std::string in_words_of_the_program(std::string message);

/// Fails before any work if an output cannot be written: its extension, its directory, a file in its place that must
/// not be touched. An empty list takes any extension.
void check_output_path(const std::string& path, const std::vector<std::string>& extensions);
/// Fails if an output would overwrite the tags that lie beside a mesh.
/// @param option  that names the output
void check_not_sidecar(const std::string& option, const std::string& path, const std::string& mesh);

/// Fails before any work if a file of about so many bytes has no room beside `path`. Devices and pipes take any.
/// @param what    the job, in the plural
/// @param advice  what would need less
/// @throws ResourceError
void check_disk(const std::string& what, const std::string& path, double bytes, const std::string& advice);

/// Makes the directory of outputs, and those above it, where they are missing.
void make_output_directory(const std::string& path);

/// A subcommand: its options on an app, and what runs once they are parsed; returns the exit status.
using Command = std::function<int()>;
Command add_schemes(CLI::App& app);
Command add_info(CLI::App& app);
Command add_refine(CLI::App& app);
Command add_limit(CLI::App& app);
Command add_sample(CLI::App& app);
Command add_closest(CLI::App& app);
Command add_intersect(CLI::App& app);
Command add_tessellate(CLI::App& app);
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
