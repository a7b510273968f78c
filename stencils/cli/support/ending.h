// SPDX-License-Identifier: Apache-2.0
#pragma once
// The end of the program: an exit status listed in stencils/docs/program.md, a message, and removal of the
// temporary files of unfinished outputs, even if exceptions cannot propagate.
#include <functional>
#include <string>

namespace sublimit::cli {

/// Makes Ctrl-C (SIGINT) and SIGTERM end the program with status 130, unless they are ignored.
void handle_interrupts();

/// Makes a lack of memory in FLINT, GMP and functions that must not throw end the program with status 4. Other
/// exceptions of such functions are internal errors.
void handle_lack_of_memory();

/// Runs `body` and returns its status. An exception is reported on stderr, and its status returned.
int guarded(const std::function<int()>& body) noexcept;

/// Returns the exit status of the current exception.
/// @param message  set to its message, as far as memory suffices; null: the message goes to stderr
int status_of_exception(std::string* message = nullptr) noexcept;

/// Flushes standard output and ends the program.
[[noreturn]] void end(int status) noexcept;

}  // namespace sublimit::cli
