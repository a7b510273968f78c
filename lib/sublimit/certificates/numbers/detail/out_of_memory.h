// SPDX-License-Identifier: Apache-2.0
#pragma once
// Handling of allocation failures in FLINT, Arb, GMP and MPFR. They cannot report them: they abort by default,
// and exceptions must not pass through their C functions.

namespace sublimit {

/// Makes these libraries call `handler` instead of abort() when an allocation fails, for the rest of the
/// process.
///
/// The handler runs in the thread that needs memory and must end the process: it may neither return nor throw.
/// Allocations still use malloc, so numbers made earlier stay valid. To be called by programs at their start,
/// not by libraries.
/// @param handler  must not allocate memory
void set_out_of_memory_handler(void (*handler)());

}  // namespace sublimit
