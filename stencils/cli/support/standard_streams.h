// SPDX-License-Identifier: Apache-2.0
#pragma once
// stdout and stderr that a reader may close at any time, as `| head -1` does. Text after that is dropped silently,
// files are still written, and the exit status is that of the work. Text that is lost for other reasons, such as a full
// disk, is an error.

namespace sublimit::cli {

/// First of all in `main`: replaces the C streams `stdout` and `stderr`, ignores SIGPIPE, and opens /dev/null in the
/// place of standard descriptors that are closed, lest an output file gets their number.
void prepare_standard_streams();

/// Last of all: writes what is buffered, and says on stderr why text for stdout was lost, if any was.
/// @param program  the name that the message begins with
/// @return         `status`, or if that is 0 the status of the error that lost the text
int finish_standard_streams(const char* program, int status);

}  // namespace sublimit::cli
