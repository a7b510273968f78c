// SPDX-License-Identifier: Apache-2.0
#pragma once
// What happens where FLINT, Arb, GMP or MPFR get no memory. They have no way to report it: by themselves they abort,
// and C functions in the middle of their work cannot be left by an exception.

namespace sublimit {

/// Calls `handler` where these libraries get no memory, in this process from now on, instead of abort().
///
/// It is called by the thread that needs memory and must end the process: neither return nor throw. Allocations go to
/// malloc as before, so numbers made earlier stay valid. For programs, at their start; a library leaves this to the
/// program that it is used by.
/// @param handler  takes no memory itself
void set_out_of_memory_handler(void (*handler)());

}  // namespace sublimit
