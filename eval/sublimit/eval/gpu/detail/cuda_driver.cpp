// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/cuda_driver.h"

#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/eval/gpu/detail/compiled_kernels.h"

namespace sublimit::gpu {
namespace {

// What of CUDA's driver interface is used, as NVIDIA's manual has it ("CUDA Driver API"); its headers are not needed.
using Result = int;
using Device = int;
using Context = struct CUctx_st*;
using Module = struct CUmod_st*;
using Function = struct CUfunc_st*;
using Stream = CUstream_st*;
using Pointer = unsigned long long;
constexpr Result success = 0, out_of_memory = 2, no_device = 100;
// Errors after which nothing works in this context.
constexpr Result lost[] = {214 /* uncorrectable memory */,
                           700 /* illegal address */,
                           702 /* timeout */,
                           709,
                           714,
                           715,
                           716,
                           717,
                           718,
                           719,
                           999};
enum Attribute { max_grid_z = 7, integrated = 18, capability_major = 75, capability_minor = 76 };
/// Kernels are compiled for compute capability 7.5, and by the driver for any later one.
constexpr int least_capability = 75;

#define SUBLIMIT_CUDA_FUNCTIONS(f)                                                                                    \
  f(cuInit, (unsigned)) f(cuDriverGetVersion, (int*)) f(cuGetErrorName, (Result, const char**))                       \
      f(cuDeviceGetCount, (int*)) f(cuDeviceGet, (Device*, int)) f(cuDeviceGetName, (char*, int, Device))             \
          f(cuDeviceTotalMem_v2, (size_t*, Device)) f(cuDeviceGetAttribute, (int*, int, Device))                      \
              f(cuDevicePrimaryCtxRetain, (Context*, Device)) f(cuDevicePrimaryCtxRelease_v2, (Device))               \
                  f(cuCtxPushCurrent_v2, (Context)) f(cuCtxPopCurrent_v2, (Context*))                                 \
                      f(cuModuleLoadData, (Module*, const void*)) f(cuModuleUnload, (Module)) f(                      \
                          cuModuleGetFunction, (Function*, Module, const char*)) f(cuMemAlloc_v2, (Pointer*, size_t)) \
                          f(cuMemFree_v2, (Pointer)) f(cuMemcpyHtoD_v2, (Pointer, const void*, size_t))               \
                              f(cuMemcpyDtoH_v2, (void*, Pointer, size_t))                                            \
                                  f(cuMemcpyDtoDAsync_v2, (Pointer, Pointer, size_t, Stream))                         \
                                      f(cuStreamCreate, (Stream*, unsigned)) f(cuStreamDestroy_v2, (Stream))          \
                                          f(cuStreamSynchronize, (Stream)) f(                                         \
                                              cuLaunchKernel, (Function, unsigned, unsigned, unsigned, unsigned,      \
                                                               unsigned, unsigned, unsigned, Stream, void**, void**))

struct CudaFunctions {
#define SUBLIMIT_MEMBER(name, parameters) Result(*name) parameters = nullptr;
  SUBLIMIT_CUDA_FUNCTIONS(SUBLIMIT_MEMBER)
#undef SUBLIMIT_MEMBER
};

/// Null: there is none, `missing` says why.
const CudaFunctions* cuda_functions(std::string& missing) {
  static std::string why;
  static const std::unique_ptr<const CudaFunctions> found = []() -> std::unique_ptr<const CudaFunctions> {
    if (!ptx_of({})) {
      why = "this build has no kernels for CUDA";
      return nullptr;
    }
    void* const library = ::dlopen("libcuda.so.1", RTLD_NOW);
    if (!library) {
      why = "there is no driver of NVIDIA, libcuda.so.1";
      return nullptr;
    }
    auto functions = std::make_unique<CudaFunctions>();
    bool complete = true;
#define SUBLIMIT_LOAD(name, parameters)                                                   \
  functions->name = reinterpret_cast<decltype(functions->name)>(::dlsym(library, #name)); \
  complete &= functions->name != nullptr;
    SUBLIMIT_CUDA_FUNCTIONS(SUBLIMIT_LOAD)
#undef SUBLIMIT_LOAD
    if (!complete) {
      why = "the driver of NVIDIA, libcuda.so.1, is too old";
      return nullptr;
    }
    if (const Result result = functions->cuInit(0); result != success) {
      why = result == no_device ? "CUDA shows no device" : "CUDA cannot be started, error " + std::to_string(result);
      return nullptr;
    }
    return functions;
  }();
  if (!found) missing = why;
  return found.get();
}

void check(const CudaFunctions& cuda, Result result, const char* what) {
  if (result == success) return;
  if (result == out_of_memory) fail_without_memory(what);
  const char* name = nullptr;
  cuda.cuGetErrorName(result, &name);
  const std::string error = std::string(what) + ": " + (name ? name : std::to_string(result));
  if (std::ranges::find(lost, result) != std::end(lost)) fail_lost(error);
  fail_otherwise(error);
}

struct Usable {
  Device device = 0;
  GpuInfo info;
};

std::vector<Usable> usable_devices(const CudaFunctions& cuda) {
  std::vector<Usable> usable;
  int count = 0, version = 0;
  check(cuda, cuda.cuDeviceGetCount(&count), "listing its devices");
  check(cuda, cuda.cuDriverGetVersion(&version), "asking for its version");
  for (int i = 0; i < count; ++i) {
    Usable found;
    check(cuda, cuda.cuDeviceGet(&found.device, i), "listing its devices");
    const auto attribute = [&](Attribute which) {
      int value = 0;
      check(cuda, cuda.cuDeviceGetAttribute(&value, which, found.device), "asking for its properties");
      return value;
    };
    if (10 * attribute(capability_major) + attribute(capability_minor) < least_capability) continue;
    char name[256] = {};
    size_t memory = 0;
    check(cuda, cuda.cuDeviceGetName(name, sizeof name - 1, found.device), "asking for its name");
    check(cuda, cuda.cuDeviceTotalMem_v2(&memory, found.device), "asking for its memory");
    found.info = {name,
                  GpuApi::cuda,
                  attribute(integrated) != 0 ? GpuKind::integrated : GpuKind::discrete,
                  "CUDA " + std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10),
                  std::int64_t(memory),
                  true};
    usable.push_back(std::move(found));
  }
  return usable;
}

class CudaDriver : public Driver, public std::enable_shared_from_this<CudaDriver> {
 public:
  CudaDriver(const CudaFunctions& functions, const Usable& usable) : cuda(functions), device_(usable.device) {
    info_ = usable.info;
    check(cuda, cuda.cuDevicePrimaryCtxRetain(&context_, device_), "opening it");
    cuda.cuDeviceGetAttribute(&most_frames_, max_grid_z, device_);
  }
  ~CudaDriver() override {
    if (const Current current(*this, std::nothrow); current.is_there()) {
      for (const Stream stream : streams_) cuda.cuStreamDestroy_v2(stream);
      for (const auto& [ptx, module] : modules_) cuda.cuModuleUnload(module);
    }
    cuda.cuDevicePrimaryCtxRelease_v2(device_);
  }

  /// The context of this thread for a while.
  class Current {
   public:
    explicit Current(const CudaDriver& driver) : Current(driver, std::nothrow) { check(cuda_, result_, "opening it"); }
    /// For destructors: a device that is lost has nothing to be freed.
    Current(const CudaDriver& driver, std::nothrow_t)
        : cuda_(driver.cuda), result_(cuda_.cuCtxPushCurrent_v2(driver.context_)) {}
    ~Current() {
      Context before = nullptr;
      if (is_there()) cuda_.cuCtxPopCurrent_v2(&before);
    }
    Current(const Current&) = delete;
    bool is_there() const { return result_ == success; }

   private:
    const CudaFunctions& cuda_;
    Result result_;
  };

  std::unique_ptr<Memory> allocate(std::int64_t bytes) override;
  std::unique_ptr<Recording> begin() override;

  void prepare(const Variant& variant) override {
    const char* const ptx = ptx_of(variant);
    Module module = nullptr;
    {
      const std::lock_guard lock(mutex_);
      if (functions_.contains(variant)) return;
      if (const auto found = modules_.find(ptx); found != modules_.end()) module = found->second;
    }
    const Current current(*this);
    if (!module) {
      // Without the lock, which those who record take: compiling takes long.
      check(cuda, cuda.cuModuleLoadData(&module, ptx), "compiling a kernel");
      const std::lock_guard lock(mutex_);
      const auto [kept, is_new] = modules_.emplace(ptx, module);
      if (!is_new) {  // another thread's
        cuda.cuModuleUnload(module);
        module = kept->second;
      }
    }
    Function function = nullptr;
    check(cuda, cuda.cuModuleGetFunction(&function, module, name_in_ptx(variant).c_str()), "finding a kernel");
    const std::lock_guard lock(mutex_);
    functions_.emplace(variant, function);
  }

  // Launches of a stream wait for those before them.
  void record(void* commands, const Launch& launch) override {
    const Current current(*this);
    const Function function = this->function(launch.variant);
    Arguments arguments = launch.arguments;
    void* parameters[] = {&arguments};
    constexpr std::int64_t most = 2147483647;  // workgroups in a row
    const std::int64_t width = std::min(launch.workgroups, most), height = (launch.workgroups + width - 1) / width;
    for (int frame = 0; frame < launch.frames; frame += most_frames_) {
      const int frames = std::min(launch.frames - frame, most_frames_);
      check(cuda,
            cuda.cuLaunchKernel(function, unsigned(width), unsigned(height), unsigned(frames), unsigned(threads), 1, 1,
                                0, static_cast<Stream>(commands), parameters, nullptr),
            "launching a kernel");
      advance_frames(arguments, frames, launch.variant.half);
    }
  }

  /// Streams that are kept.
  Stream take_stream() {
    {
      const std::lock_guard lock(mutex_);
      if (!streams_.empty()) {
        const Stream stream = streams_.back();
        streams_.pop_back();
        return stream;
      }
    }
    const Current current(*this);
    Stream stream = nullptr;
    check(cuda, cuda.cuStreamCreate(&stream, 0), "making a stream");
    const std::lock_guard lock(mutex_);
    streams_.reserve(++num_streams_);  // so that it can be given back
    return stream;
  }
  void give_back(Stream stream) {
    const std::lock_guard lock(mutex_);
    streams_.push_back(stream);
  }

  const CudaFunctions& cuda;

 private:
  Function function(const Variant& variant) {
    const std::lock_guard lock(mutex_);
    const auto found = functions_.find(variant);
    if (found == functions_.end()) fail_unprepared();
    return found->second;
  }

  Device device_ = 0;
  Context context_ = nullptr;
  int most_frames_ = 65535;
  std::mutex mutex_;
  std::vector<Stream> streams_;
  size_t num_streams_ = 0;
  std::map<const char*, Module> modules_;
  std::map<Variant, Function> functions_;
};

class CudaMemory : public Memory {
 public:
  CudaMemory(std::shared_ptr<CudaDriver> driver, std::int64_t bytes) : driver_(std::move(driver)) {
    const CudaDriver::Current current(*driver_);
    Pointer pointer = 0;
    check(driver_->cuda, driver_->cuda.cuMemAlloc_v2(&pointer, size_t(std::max<std::int64_t>(bytes, 16))),
          "taking memory");
    address_ = pointer;
    num_bytes_ = bytes;
  }
  ~CudaMemory() override {
    const CudaDriver::Current current(*driver_, std::nothrow);
    if (current.is_there()) driver_->cuda.cuMemFree_v2(address_);
  }
  void write(std::int64_t at, std::span<const std::byte> bytes) override {
    if (bytes.empty()) return;
    const CudaDriver::Current current(*driver_);
    check(driver_->cuda, driver_->cuda.cuMemcpyHtoD_v2(address_ + Pointer(at), bytes.data(), bytes.size()),
          "copying to it");
    // Memory that is not pinned may be on its way still, which streams that do not wait for this one would overtake.
    check(driver_->cuda, driver_->cuda.cuStreamSynchronize(nullptr), "copying to it");
  }
  void read(std::int64_t at, std::span<std::byte> bytes) const override {
    if (bytes.empty()) return;
    const CudaDriver::Current current(*driver_);
    check(driver_->cuda, driver_->cuda.cuMemcpyDtoH_v2(bytes.data(), address_ + Pointer(at), bytes.size()),
          "copying from it");
  }

 private:
  std::shared_ptr<CudaDriver> driver_;
};

/// Streams, each of which waits for copies before it.
class CudaRecording : public Recording {
 public:
  explicit CudaRecording(std::shared_ptr<CudaDriver> driver) : driver_(std::move(driver)) {
    streams_.reserve(most_streams);
    streams_.push_back(driver_->take_stream());
  }
  ~CudaRecording() override {
    for (const Stream stream : streams_) driver_->give_back(stream);
  }
  void* handle() const override { return streams_.front(); }
  void* independent() override {
    const size_t number = next_++ % most_streams;
    if (number == streams_.size()) streams_.push_back(driver_->take_stream());
    return streams_[number];
  }
  void copy(const Memory& from, Memory& to, std::int64_t bytes) override {
    const CudaDriver::Current current(*driver_);
    // The default stream comes after all that the others have, and before what they will have.
    check(driver_->cuda, driver_->cuda.cuMemcpyDtoDAsync_v2(to.address(), from.address(), size_t(bytes), nullptr),
          "copying on it");
  }
  void submit_and_wait() override {
    const CudaDriver::Current current(*driver_);
    check(driver_->cuda, driver_->cuda.cuStreamSynchronize(nullptr), "running a kernel");
    for (const Stream stream : streams_)
      check(driver_->cuda, driver_->cuda.cuStreamSynchronize(stream), "running a kernel");
  }

 private:
  static constexpr size_t most_streams = 16;
  std::shared_ptr<CudaDriver> driver_;
  std::vector<Stream> streams_;
  size_t next_ = 0;
};

std::unique_ptr<Memory> CudaDriver::allocate(std::int64_t bytes) {
  return std::make_unique<CudaMemory>(shared_from_this(), bytes);
}
std::unique_ptr<Recording> CudaDriver::begin() { return std::make_unique<CudaRecording>(shared_from_this()); }

}  // namespace

Found cuda_devices() {
  Found found;
  const CudaFunctions* const cuda = cuda_functions(found.missing);
  if (!cuda) return found;
  for (Usable& usable : usable_devices(*cuda)) found.devices.push_back(std::move(usable.info));
  if (found.devices.empty()) found.missing = "CUDA shows no device of compute capability 7.5 or later";
  return found;
}

std::shared_ptr<Driver> open_cuda_device(size_t number) {
  std::string missing;
  const CudaFunctions* const cuda = cuda_functions(missing);
  if (!cuda) throw InvalidOption(missing);
  const std::vector<Usable> usable = usable_devices(*cuda);
  if (number >= usable.size()) throw InvalidOption("the GPU is gone; list the devices again");
  return std::make_shared<CudaDriver>(*cuda, usable[number]);
}

}  // namespace sublimit::gpu
