// SPDX-License-Identifier: Apache-2.0
#pragma once
// `-` in the place of a file: standard input and standard output as files of a format (base/detail/standard_files.h),
// for every subcommand that reads or writes files.
//
//   sublimit refine - -s loop -l 2 -o - --format ply      MESH is /dev/stdin.obj, OUT is /dev/stdout.ply
#include <CLI/CLI.hpp>

namespace sublimit::cli {

/// Adds --format to a subcommand that reads or writes files.
void add_stream_format(CLI::App& command);

/// Replaces `-`, `/dev/stdin`, `/dev/stdout` and `/dev/fd/N` among the files of a parsed subcommand by names with the
/// extension of their format: that of --format, else of their first bytes. Input is read to its end, so that it can be
/// opened again and mapped, and inflated if it is compressed. Text for stdout goes to stderr if a file is written
/// there.
/// @throws InvalidOption  a stream for two files; --format without a stream, or unknown; a directory
/// @throws FormatError    input that is empty or of an unknown format
/// @throws IoError        a closed stream, input that cannot be read
/// @throws ResourceError  more input than a job may take
void open_stream_arguments(CLI::App& command);

}  // namespace sublimit::cli
