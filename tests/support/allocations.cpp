// SPDX-License-Identifier: Apache-2.0
#include "support/allocations.h"

#include <cerrno>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define SUBLIMIT_COUNTS_ALLOCATIONS 0
#else
#define SUBLIMIT_COUNTS_ALLOCATIONS 1
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#undef SUBLIMIT_COUNTS_ALLOCATIONS
#define SUBLIMIT_COUNTS_ALLOCATIONS 0
#endif
#endif

namespace {
thread_local std::int64_t calls = 0, bytes = 0;
}

#if SUBLIMIT_COUNTS_ALLOCATIONS
// glibc's, under the names by which they can be replaced; `free` stays what it is.
extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

void* malloc(size_t size) {
  ++calls, bytes += std::int64_t(size);
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  ++calls, bytes += std::int64_t(count * size);
  return __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
  ++calls, bytes += std::int64_t(size);
  return __libc_realloc(memory, size);
}
void* memalign(size_t alignment, size_t size) {
  ++calls, bytes += std::int64_t(size);
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, size_t alignment, size_t size) {
  *result = memalign(alignment, size);
  return *result ? 0 : ENOMEM;
}
}
#endif

namespace sublimit::testing {

bool allocations_are_counted() { return SUBLIMIT_COUNTS_ALLOCATIONS; }
std::int64_t allocations() { return calls; }
std::int64_t allocated_bytes() { return bytes; }

}  // namespace sublimit::testing
