// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recognising input files by their first bytes, and checking that each is in the right place on a command line.
#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {

/// What a file is by its first bytes.
struct FileKind {
  enum class State {
    unknown,  ///< a missing file, text that no format begins with, a pipe or device: those can be read only once
    directory,
    empty,
    known
  };
  State state = State::unknown;
  const FileFormat* format = nullptr;  ///< if known
};

/// Returns the kind of a regular file or a directory.
FileKind file_kind(const std::string& path);

/// Returns a kind as words for messages: "an OBJ file".
std::string name_of(const FileKind& kind);

/// Returns the kind of file that an argument or option takes: "a control mesh, .obj, .ply, .off or .stl"; empty if it
/// does not name a file to read.
std::string input_meaning(const CLI::App& command, const CLI::Option& option);

/// Extensions of the files that an argument or option takes, without the dot; empty for any, or if it names none.
std::vector<std::string> input_extensions(const CLI::App& command, const CLI::Option& option);

/// Returns the extension of a format that an argument or option takes and whose files begin with these bytes; else of
/// any format whose files begin so; else the one extension that it takes, if it takes one alone, and "" if it takes any
/// file. Absent if none of these is there.
std::optional<std::string> input_extension(const CLI::App& command, const CLI::Option& option,
                                           std::string_view first_bytes);

/// Checks that files have the kinds that a subcommand expects: finds a table in the place of a mesh, a mesh in
/// the place of a CSV, swapped arguments, directories, empty files. Arguments and options are recognised by
/// their names.
/// @throws FormatError, IoError  a file of another kind; the message has the file, its kind and the expected
///                               one
void check_input_files(const CLI::App& command);

}  // namespace sublimit::cli
