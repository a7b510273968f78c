// SPDX-License-Identifier: Apache-2.0
#include "failures/failing_memory.h"

#include <link.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <new>

namespace {

// Plain numbers: the first use of a variable of a thread that needs a constructor may allocate.
thread_local bool counting = false, all_after = false, in_array = false, array_failed = false;
thread_local std::int64_t fail_at = 0, calls = 0, failures = 0, blocks = 0;

/// Code whose allocations are left alone.
struct Range {
  std::uintptr_t begin = 0, end = 0;
};
Range exempt[16];
int num_exempt = 0;

int find_exempt(dl_phdr_info* info, size_t, void*) {
  for (const char* name : {"libtbb", "libflint", "libgmp", "libmpfr", "ld-linux"}) {
    if (!std::strstr(info->dlpi_name, name)) continue;
    for (int i = 0; i < info->dlpi_phnum; ++i) {
      const auto& segment = info->dlpi_phdr[i];
      if (segment.p_type != PT_LOAD || !(segment.p_flags & PF_X) || num_exempt == std::ssize(exempt)) continue;
      const std::uintptr_t begin = info->dlpi_addr + segment.p_vaddr;
      exempt[num_exempt++] = {begin, begin + segment.p_memsz};
    }
  }
  return 0;
}

/// Whether this allocation is to fail.
bool fails(void* caller) {
  if (!counting) return false;
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  for (int i = 0; i < num_exempt; ++i)
    if (address >= exempt[i].begin && address < exempt[i].end) return false;
  ++calls;
  if (fail_at == 0 || (all_after ? calls < fail_at : calls != fail_at)) return false;
  ++failures;
  array_failed |= in_array;
  errno = ENOMEM;
  return true;
}

}  // namespace

#define CALLER __builtin_return_address(0)

void* operator new[](size_t size) {
  in_array = true;
  struct Out {
    ~Out() { in_array = false; }
  } const out;
  return operator new(size);
}

#ifdef __SANITIZE_ADDRESS__
void* operator new(size_t size) {
  void* const memory = fails(CALLER) ? nullptr : std::malloc(size > 0 ? size : 1);
  return memory ? memory : throw std::bad_alloc();
}
void* operator new(size_t size, std::align_val_t alignment) {
  void* memory = nullptr;
  if (fails(CALLER) || ::posix_memalign(&memory, size_t(alignment), size > 0 ? size : 1) != 0) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
#else
extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void __libc_free(void*);

static void* taken(void* memory) {
  if (memory) ++blocks;
  return memory;
}
void* malloc(size_t size) { return fails(CALLER) ? nullptr : taken(__libc_malloc(size)); }
void* calloc(size_t count, size_t size) { return fails(CALLER) ? nullptr : taken(__libc_calloc(count, size)); }
void* realloc(void* memory, size_t size) {
  if (fails(CALLER)) return nullptr;
  void* const moved = __libc_realloc(memory, size);
  if (!memory) return taken(moved);
  if (!moved && size == 0) --blocks;
  return moved;
}
void* memalign(size_t alignment, size_t size) {
  return fails(CALLER) ? nullptr : taken(__libc_memalign(alignment, size));
}
void* aligned_alloc(size_t alignment, size_t size) {
  return fails(CALLER) ? nullptr : taken(__libc_memalign(alignment, size));
}
int posix_memalign(void** result, size_t alignment, size_t size) {
  if (fails(CALLER)) return ENOMEM;
  *result = taken(__libc_memalign(alignment, size));
  return *result ? 0 : ENOMEM;
}
void free(void* memory) {
  if (memory) --blocks;
  __libc_free(memory);
}
}
#endif

namespace sublimit::testing {

FailingMemory::FailingMemory(std::int64_t at, bool and_after) {
  if (num_exempt == 0) ::dl_iterate_phdr(find_exempt, nullptr);
  fail_at = at, all_after = and_after, calls = failures = 0;
  array_failed = false;
  counting = true;
}
FailingMemory::~FailingMemory() { counting = false; }
std::int64_t FailingMemory::count() const { return calls; }
std::int64_t FailingMemory::failed() const { return failures; }
bool FailingMemory::failed_in_array() const { return array_failed; }

std::int64_t blocks_in_use() { return blocks; }

}  // namespace sublimit::testing
