// SPDX-License-Identifier: Apache-2.0
// To be preloaded into a program: calls of the system that fail as failing_calls.h says. It needs glibc.
#include "failures/failing_calls.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

namespace {

using namespace sublimit::testing;

FailingCalls* plan = nullptr;
std::uintptr_t tbb_begin = 0, tbb_end = 0;

int find_tbb(dl_phdr_info* info, size_t, void*) {
  if (!std::strstr(info->dlpi_name, "libtbb.so")) return 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD || !(segment.p_flags & PF_X)) continue;
    tbb_begin = info->dlpi_addr + segment.p_vaddr;
    tbb_end = tbb_begin + segment.p_memsz;
  }
  return 0;
}

void begin() {
  const char* const name = std::getenv(failing_calls_variable);
  if (!name) return;
  const int file = ::open(name, O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  void* const page = reinterpret_cast<void*>(
      ::syscall(SYS_mmap, nullptr, sizeof(FailingCalls), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  ::close(file);
  if (page == MAP_FAILED) return;
  ::dl_iterate_phdr(find_tbb, nullptr);
  plan = static_cast<FailingCalls*>(page);
}

/// Whether this call is to fail.
bool fails(Call call) {
  if (!plan) return false;
  const std::int64_t number = ++plan->counts[static_cast<int>(call)];
  if (plan->at == 0 || plan->call != call) return false;
  if (plan->failing == Failing::on ? number < plan->at : number != plan->at) return false;
  ++plan->failed;
  if (plan->failing == Failing::short_) return true;
  errno = plan->error;
  return true;
}

bool memory_fails(void* caller) {
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  if (plan && plan->exempt_tbb && address >= tbb_begin && address < tbb_end) return false;
  return fails(Call::memory);
}

template <class Function>
Function* next(Function*& found, const char* name) {
  if (!found) found = reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
  return found;
}

int (*real_main)(int, char**, char**) = nullptr;
int counted_main(int argc, char** argv, char** environment) {
  begin();
  return real_main(argc, argv, environment);
}

}  // namespace

#define CALLER __builtin_return_address(0)

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
  static decltype(__libc_start_main)* real = nullptr;
  real_main = main;
  return next(real, "__libc_start_main")(counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}

void* malloc(size_t size) { return memory_fails(CALLER) ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return memory_fails(CALLER) ? nullptr : __libc_calloc(count, size); }
void* realloc(void* memory, size_t size) { return memory_fails(CALLER) ? nullptr : __libc_realloc(memory, size); }
void* memalign(size_t alignment, size_t size) {
  return memory_fails(CALLER) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  return memory_fails(CALLER) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** result, size_t alignment, size_t size) {
  if (memory_fails(CALLER)) return ENOMEM;
  *result = __libc_memalign(alignment, size);
  return *result ? 0 : ENOMEM;
}

void* mmap(void* start, size_t size, int protection, int flags, int file, off_t offset) {
  if (fails(Call::map)) return MAP_FAILED;
  return reinterpret_cast<void*>(::syscall(SYS_mmap, start, size, protection, flags, file, offset));
}

ssize_t write(int file, const void* bytes, size_t size) {
  if (fails(Call::write)) {
    if (plan->failing != Failing::short_) return -1;
    size = (size + 1) / 2;
  }
  return ::syscall(SYS_write, file, bytes, size);
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  if (fails(Call::write)) {
    if (plan->failing != Failing::short_) return -1;
    size = (size + 1) / 2;
  }
  return ::syscall(SYS_pwrite64, file, bytes, size, offset);
}
ssize_t writev(int file, const iovec* pieces, int count) {
  if (fails(Call::write) && plan->failing != Failing::short_) return -1;
  return ::syscall(SYS_writev, file, pieces, count);
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*), void* argument) {
  static decltype(pthread_create)* real = nullptr;
  if (fails(Call::thread)) return plan->error;
  return next(real, "pthread_create")(thread, attributes, body, argument);
}

int rename(const char* from, const char* to) {
  if (fails(Call::rename)) return -1;
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int mode = flags & O_CREAT ? va_arg(rest, int) : 0;
  va_end(rest);
  if ((flags & O_ACCMODE) != O_RDONLY && fails(Call::open)) return -1;
  return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, name, flags, mode));
}
int open64(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int mode = flags & O_CREAT ? va_arg(rest, int) : 0;
  va_end(rest);
  if ((flags & O_ACCMODE) != O_RDONLY && fails(Call::open)) return -1;
  return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, name, flags, mode));
}
}
