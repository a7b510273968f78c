// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recognising input files by their first bytes, and checking that each is in the right place on a command line.
#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace sublimit::cli {

enum class FileKind {
  unknown,
  directory,
  empty,
  obj,
  ply,
  off,
  csv,
  json,
  npy,
  safetensors,
  zip,
  matrix_market,
  xml,
  step,
  brep,
  gltf
};

/// The kind of a regular file or a directory. Pipes and devices are unknown: what is read from them is gone. So are
/// files that are not there and text that begins like no format that we know.
FileKind file_kind(const std::string& path);

/// "an OBJ file"; for use in messages.
const char* name_of(FileKind kind);

/// Returns the kind of file that an argument or option takes: "a control mesh, .obj, .ply or .off"; empty if it does
/// not name a file to read.
std::string input_meaning(const CLI::App& command, const CLI::Option& option);

/// Extensions of the files that an argument or option takes, without the dot; empty for any, or if it names none.
std::vector<std::string> input_extensions(const CLI::App& command, const CLI::Option& option);

/// Fails if a file stands where a subcommand takes another kind: a table for a mesh, a mesh for a CSV, swapped
/// arguments, a directory, an empty file. Arguments and options are known by their names.
/// @throws FormatError, IoError  naming the file, what it is, and what belongs in its place
void check_input_files(const CLI::App& command);

}  // namespace sublimit::cli
