// SPDX-License-Identifier: Apache-2.0
#pragma once
// The end of the program: an exit status listed in stencils/docs/program.md, a message, and removal of temporaries of
// unfinished outputs, also where exceptions cannot propagate.
#include <functional>
#include <string>

namespace sublimit::cli {

/// Ctrl-C ends the program with status 130.
void handle_interrupts();

/// Lack of memory in FLINT, GMP and in functions that must not throw ends the program with status 4; all else that they
/// throw is a fault of ours.
void handle_lack_of_memory();

/// Runs `body`; an error becomes a message and a status.
int guarded(const std::function<int()>& body) noexcept;

/// Status for the exception in flight.
/// @param message  gets what there is to tell; null: standard error does
int status_of_exception(std::string* message = nullptr) noexcept;

/// Writes what is left for standard output and ends the program.
[[noreturn]] void end(int status) noexcept;

}  // namespace sublimit::cli
