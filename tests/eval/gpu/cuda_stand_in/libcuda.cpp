// SPDX-License-Identifier: Apache-2.0
// Stands in for NVIDIA's driver where there is none: a libcuda.so.1 with the functions that cuda_driver.cpp calls,
// which runs the kernels, compiled for the host from the same sources, one lane after the other. It is strict: numbers
// are copied within what was allocated, contexts are popped as they were pushed, kernels are those that the PTX has.
#include <dlfcn.h>
#include <ucontext.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "words.h"
#include "sublimit/eval/gpu/detail/kernel_arguments.h"

StandInPlace stand_in_place;

namespace {

using sublimit::gpu::Arguments;
using Kernel = void (*)(Arguments);
constexpr unsigned lanes = sublimit::gpu::threads;
constexpr int success = 0, invalid_value = 1, out_of_memory = 2, no_context = 201, not_found = 500;

/// Lanes of a workgroup, each with a stack of its own.
class Workgroup {
 public:
  Workgroup() {
    for (auto& stack : stacks_) stack.resize(64 << 10);
  }
  void run(Kernel kernel, const Arguments& arguments) {
    kernel_ = kernel, arguments_ = arguments;
    for (unsigned lane = 0; lane < lanes; ++lane) {
      getcontext(&contexts_[lane]);
      contexts_[lane].uc_stack = {stacks_[lane].data(), 0, stacks_[lane].size()};
      contexts_[lane].uc_link = &scheduler_;
      makecontext(&contexts_[lane], &Workgroup::begin, 0);
      done_[lane] = false;
    }
    while (!std::all_of(done_, done_ + lanes, [](bool done) { return done; }))
      for (unsigned lane = 0; lane < lanes; ++lane) {
        if (done_[lane]) continue;
        stand_in_place.lane = lane;
        swapcontext(&scheduler_, &contexts_[lane]);
      }
  }
  void wait() { swapcontext(&contexts_[stand_in_place.lane], &scheduler_); }

 private:
  static void begin();
  Kernel kernel_ = nullptr;
  Arguments arguments_{};
  ucontext_t scheduler_{}, contexts_[lanes]{};
  std::vector<char> stacks_[lanes];
  bool done_[lanes] = {};
};

Workgroup& workgroup() {
  static Workgroup one;
  return one;
}
void Workgroup::begin() {
  Workgroup& w = workgroup();
  w.kernel_(w.arguments_);
  w.done_[stand_in_place.lane] = true;
}

std::mutex mutex;
std::map<unsigned long long, size_t> memory;  // address, bytes
int streams = 0, modules = 0, retained = 0;
thread_local int pushed = 0;

struct Failure {
  std::string function;
  int after = 0, result = 0;
} failure;

/// The result that a test asked for, or success.
int begin_call(const char* function) {
  const std::lock_guard lock(mutex);
  if (failure.function == function && failure.after-- == 0) return failure.result;
  return success;
}
#define CALL \
  if (const int asked = begin_call(__func__)) return asked
#define CALL_IN_CONTEXT \
  CALL;                 \
  if (pushed == 0) return no_context

bool is_within(unsigned long long address, size_t bytes) {
  const std::lock_guard lock(mutex);
  auto after = memory.upper_bound(address);
  if (after == memory.begin()) return false;
  --after;
  return address - after->first <= after->second && bytes <= after->second - (address - after->first);
}

struct Module {
  std::string ptx;
};

}  // namespace

void stand_in_barrier() { workgroup().wait(); }

extern "C" {

/// For tests: the call number `after` of a function from now on has this result.
void stand_in_fail(const char* function, int after, int result) {
  const std::lock_guard lock(mutex);
  failure = {function, after, result};
}
bool stand_in_has_failed() {
  const std::lock_guard lock(mutex);
  return failure.after < 0;
}
/// What was made and not yet ended: arrays, streams, modules, contexts.
int stand_in_live() {
  const std::lock_guard lock(mutex);
  return int(memory.size()) + streams + modules + retained;
}

int cuInit(unsigned) { return success; }
int cuDriverGetVersion(int* version) {
  *version = 12040;
  return success;
}
int cuGetErrorName(int result, const char** name) {
  *name = result == 700 ? "CUDA_ERROR_ILLEGAL_ADDRESS" : "CUDA_ERROR_OF_STAND_IN";
  return success;
}
int cuDeviceGetCount(int* count) {
  *count = 1;
  return success;
}
int cuDeviceGet(int* device, int number) {
  *device = number;
  return number == 0 ? success : invalid_value;
}
int cuDeviceGetName(char* name, int size, int) {
  std::snprintf(name, size_t(size), "stand-in for CUDA");
  return success;
}
int cuDeviceTotalMem_v2(size_t* bytes, int) {
  *bytes = size_t{1} << 32;
  return success;
}
int cuDeviceGetAttribute(int* value, int attribute, int) {
  *value = attribute == 75 ? 8 : attribute == 76 ? 6 : attribute == 7 ? 65535 : 0;
  return success;
}
int cuDevicePrimaryCtxRetain(void** context, int) {
  CALL;
  const std::lock_guard lock(mutex);
  ++retained;
  *context = &retained;
  return success;
}
int cuDevicePrimaryCtxRelease_v2(int) {
  const std::lock_guard lock(mutex);
  --retained;
  return success;
}
int cuCtxPushCurrent_v2(void* context) {
  CALL;
  if (context != &retained) return no_context;
  ++pushed;
  return success;
}
int cuCtxPopCurrent_v2(void** context) {
  *context = &retained;
  return pushed-- > 0 ? success : no_context;
}
int cuModuleLoadData(void** module, const void* ptx) {
  CALL_IN_CONTEXT;
  const std::lock_guard lock(mutex);
  ++modules;
  *module = new Module{static_cast<const char*>(ptx)};
  return success;
}
int cuModuleUnload(void* module) {
  const std::lock_guard lock(mutex);
  --modules;
  delete static_cast<Module*>(module);
  return success;
}
int cuModuleGetFunction(void** function, void* module, const char* name) {
  CALL_IN_CONTEXT;
  const std::string entry = std::string(".entry ") + name + "(";
  if (static_cast<Module*>(module)->ptx.find(entry) == std::string::npos) return not_found;
  const bool half = static_cast<Module*>(module)->ptx.find("cvt.rn.f16.f32") != std::string::npos ||
                    static_cast<Module*>(module)->ptx.find("st.global.u16") != std::string::npos ||
                    static_cast<Module*>(module)->ptx.find("st.u16") != std::string::npos;
  *function = dlsym(RTLD_DEFAULT, (std::string(half ? "half_" : "") + name).c_str());
  return *function ? success : not_found;
}
int cuMemAlloc_v2(unsigned long long* address, size_t bytes) {
  CALL_IN_CONTEXT;
  void* const made = std::aligned_alloc(256, (bytes + 255) / 256 * 256);
  if (!made) return out_of_memory;
  std::memset(made, 0xff, bytes);  // no numbers
  const std::lock_guard lock(mutex);
  *address = reinterpret_cast<unsigned long long>(made);
  memory[*address] = bytes;
  return success;
}
int cuMemFree_v2(unsigned long long address) {
  const std::lock_guard lock(mutex);
  if (memory.erase(address) == 0) return invalid_value;
  std::free(reinterpret_cast<void*>(address));
  return success;
}
int cuMemcpyHtoD_v2(unsigned long long to, const void* from, size_t bytes) {
  CALL_IN_CONTEXT;
  if (!is_within(to, bytes)) return invalid_value;
  std::memcpy(reinterpret_cast<void*>(to), from, bytes);
  return success;
}
int cuMemcpyDtoH_v2(void* to, unsigned long long from, size_t bytes) {
  CALL_IN_CONTEXT;
  if (!is_within(from, bytes)) return invalid_value;
  std::memcpy(to, reinterpret_cast<const void*>(from), bytes);
  return success;
}
int cuMemcpyDtoDAsync_v2(unsigned long long to, unsigned long long from, size_t bytes, void*) {
  CALL_IN_CONTEXT;
  if (!is_within(from, bytes) || !is_within(to, bytes)) return invalid_value;
  std::memcpy(reinterpret_cast<void*>(to), reinterpret_cast<const void*>(from), bytes);
  return success;
}
int cuStreamCreate(void** stream, unsigned) {
  CALL_IN_CONTEXT;
  const std::lock_guard lock(mutex);
  ++streams;
  *stream = new int(streams);
  return success;
}
int cuStreamDestroy_v2(void* stream) {
  const std::lock_guard lock(mutex);
  --streams;
  delete static_cast<int*>(stream);
  return success;
}
int cuStreamSynchronize(void*) {
  CALL_IN_CONTEXT;
  return success;
}
int cuLaunchKernel(void* function, unsigned x, unsigned y, unsigned z, unsigned threads, unsigned, unsigned, unsigned,
                   void*, void** parameters, void**) {
  CALL_IN_CONTEXT;
  if (threads != lanes || x == 0 || y == 0 || z == 0 || y > 65535 || z > 65535) return invalid_value;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const auto kernel = reinterpret_cast<Kernel>(function);
  const Arguments& arguments = *static_cast<const Arguments*>(parameters[0]);
  stand_in_place.num_workgroups[0] = x, stand_in_place.num_workgroups[1] = y, stand_in_place.num_workgroups[2] = z;
  for (unsigned k = 0; k < z; ++k)
    for (unsigned j = 0; j < y; ++j)
      for (unsigned i = 0; i < x; ++i) {
        stand_in_place.workgroup[0] = i, stand_in_place.workgroup[1] = j, stand_in_place.workgroup[2] = k;
        workgroup().run(kernel, arguments);
      }
  return success;
}

}  // extern "C"
