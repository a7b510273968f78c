// SPDX-License-Identifier: Apache-2.0
#pragma once
// stdout and stderr that a reader may close at any time, as `| head -1` does. Text after that is dropped silently,
// files are still written, and the exit status is that of the work. Text that is lost for other reasons, such as a full
// disk, is an error.

namespace sublimit::cli {

/// To be called first in `main`: replaces the C streams `stdout` and `stderr`, ignores SIGPIPE, and opens
/// /dev/null for standard descriptors that are closed, so that no output file gets their number.
void prepare_standard_streams();

/// Lets text for stdout go to stderr, where stdout is the place of a file.
void print_on_stderr();

/// Throws an error if a standard stream was closed before the program began.
/// @param descriptor  0 or 1
/// @throws IoError
void check_standard_stream(int descriptor);

/// To be called last: flushes the streams, and reports on stderr if text for stdout was lost.
/// @param program  name of the program, the start of the message
/// @return         `status`, or if that is 0 the status of the error by which text was lost
int finish_standard_streams(const char* program, int status);

}  // namespace sublimit::cli
