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

/// Returns the kind of a regular file or a directory. Unknown are missing files, text that no known format
/// begins with, and pipes and devices, which are not read because their bytes can be read only once.
FileKind file_kind(const std::string& path);

/// Returns a kind as words for messages: "an OBJ file".
const char* name_of(FileKind kind);

/// Returns the kind of file that an argument or option takes: "a control mesh, .obj, .ply or .off"; empty if it does
/// not name a file to read.
std::string input_meaning(const CLI::App& command, const CLI::Option& option);

/// Extensions of the files that an argument or option takes, without the dot; empty for any, or if it names none.
std::vector<std::string> input_extensions(const CLI::App& command, const CLI::Option& option);

/// Checks that files have the kinds that a subcommand expects: finds a table in the place of a mesh, a mesh in
/// the place of a CSV, swapped arguments, directories, empty files. Arguments and options are recognised by
/// their names.
/// @throws FormatError, IoError  a file of another kind; the message has the file, its kind and the expected
///                               one
void check_input_files(const CLI::App& command);

}  // namespace sublimit::cli
