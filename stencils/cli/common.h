// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the subcommands share: options, loading a mesh with its tags, progress.
#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/refine.h"
#include "sublimit/schemes.h"

namespace sublimit::cli {

/// Options that every subcommand with a mesh and a scheme has.
struct Common {
  std::string mesh, scheme;
  std::string boundary, creasing, triangles;  ///< empty: the file's tags
  std::vector<std::string> options;           ///< name=value
  int threads = 0;                            ///< 0: all
  bool quiet = false, strict = false;
};

struct Loaded {
  ControlMesh mesh;
  std::optional<Scheme<double>> scheme;
  SubdivisionOptions rules;
};

/// Adds them to a subcommand.
void add_mesh(CLI::App& command, Common& common, bool scheme_required);

/// Reads the mesh and its sidecar, prints warnings, and finds the scheme if one was named.
Loaded load(const Common& common);

/// The scheme of a name, or an InvalidOption that offers the nearest ones.
Scheme<double> scheme_or_throw(const std::string& name, const SchemeOptions& options = {});

/// Fails before any work if an output cannot be written: its extension, its directory. An empty list takes any extension.
void check_output_path(const std::string& path, const std::vector<std::string>& extensions);

/// Where outputs of this run go, as told to `check_output_path`.
std::vector<std::string> output_directories();

/// A line on stderr for steps that take longer than a second, if a person is looking.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  void step(const std::string& what);

 private:
  bool shown_, active_;
  std::chrono::steady_clock::time_point start_;
};

/// A subcommand: its options on an app, and what runs once they are parsed; returns the exit status.
using Command = std::function<int()>;
Command add_schemes(CLI::App& app);
Command add_info(CLI::App& app);
Command add_refine(CLI::App& app);
Command add_limit(CLI::App& app);
Command add_demo(CLI::App& app);

}  // namespace sublimit::cli
