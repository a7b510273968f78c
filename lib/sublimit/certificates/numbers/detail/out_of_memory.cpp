// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/out_of_memory.h"

#include <flint/flint.h>
#include <gmp.h>

#include <cstdlib>

namespace sublimit {
namespace {

void (*end)() = nullptr;

void* checked(void* memory) {
  if (!memory) end();
  return memory;
}
void* allocate(std::size_t size) { return checked(std::malloc(size > 0 ? size : 1)); }
void* allocate_zeroed(std::size_t count, std::size_t size) { return checked(std::calloc(count, size)); }
void* reallocate(void* memory, std::size_t size) { return checked(std::realloc(memory, size > 0 ? size : 1)); }

}  // namespace

void set_out_of_memory_handler(void (*handler)()) {
  end = handler;
  // MPFR asks GMP for its functions.
  mp_set_memory_functions(
      allocate, [](void* memory, std::size_t, std::size_t size) { return reallocate(memory, size); },
      [](void* memory, std::size_t) { std::free(memory); });
  __flint_set_memory_functions(allocate, allocate_zeroed, reallocate, [](void* memory) { std::free(memory); });
}

}  // namespace sublimit
