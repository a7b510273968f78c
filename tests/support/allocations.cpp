// SPDX-License-Identifier: Apache-2.0
#include "support/allocations.h"

#include <malloc.h>

#include <atomic>
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

thread_local std::int64_t calls = 0;
// Of bytes once somebody asks: all threads share them.
std::atomic<bool> tracked{false};
std::atomic<std::int64_t> live{0}, most{0};

void taken(std::int64_t bytes) {
  if (!tracked.load(std::memory_order_relaxed)) return;
  const std::int64_t now = live += bytes;
  std::int64_t peak = most;
  while (now > peak && !most.compare_exchange_weak(peak, now)) {
  }
}

#if SUBLIMIT_COUNTS_ALLOCATIONS
void* counted(void* memory) {
  if (!memory) return nullptr;
  ++calls;
  taken(std::int64_t(malloc_usable_size(memory)));
  return memory;
}
#endif

}  // namespace

#if SUBLIMIT_COUNTS_ALLOCATIONS
// glibc's, under the names by which they can be replaced.
extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void __libc_free(void*);

void* malloc(size_t size) { return counted(__libc_malloc(size)); }
void* calloc(size_t count, size_t size) { return counted(__libc_calloc(count, size)); }
void* memalign(size_t alignment, size_t size) { return counted(__libc_memalign(alignment, size)); }
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, size_t alignment, size_t size) {
  *result = memalign(alignment, size);
  return *result ? 0 : ENOMEM;
}
void free(void* memory) {
  if (memory) taken(-std::int64_t(malloc_usable_size(memory)));
  __libc_free(memory);
}
void* realloc(void* memory, size_t size) {
  const std::int64_t was = memory ? std::int64_t(malloc_usable_size(memory)) : 0;
  void* const result = counted(__libc_realloc(memory, size));
  if (result || size == 0) taken(-was);
  return result;
}
}
#endif

namespace sublimit::testing {

bool allocations_are_counted() { return SUBLIMIT_COUNTS_ALLOCATIONS; }
std::int64_t allocations() { return calls; }
std::int64_t peak_of_bytes() { return most; }
void forget_peak() {
  tracked = true;
  live = 0;
  most = 0;
}

}  // namespace sublimit::testing
