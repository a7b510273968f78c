// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/gpu_device.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/eval/gpu/detail/cuda_driver.h"
#include "sublimit/eval/gpu/detail/driver.h"
#include "sublimit/eval/gpu/detail/vulkan_driver.h"

namespace sublimit {
namespace {

/// A device, and its number among those that its library shows.
struct Numbered {
  GpuInfo info;
  size_t number = 0;
};

std::vector<Numbered> numbered_devices(std::string* why_none) {
  std::vector<Numbered> all;
  std::string missing;
  const auto add = [&](gpu::Found (*devices)()) {
    gpu::Found found;
    try {
      found = devices();
    } catch (const Error& error) {  // the other library may have devices
      found.missing = error.what();
    }
    for (size_t i = 0; i < found.devices.size(); ++i) all.push_back({found.devices[i], i});
    if (!found.missing.empty()) missing += (missing.empty() ? "" : "; ") + found.missing;
  };
  add(gpu::cuda_devices);
  add(gpu::vulkan_devices);
  std::ranges::stable_sort(all, {}, [](const Numbered& device) { return device.info.kind; });
  if (why_none && all.empty()) *why_none = missing;
  return all;
}

}  // namespace

const char* name(GpuApi api) { return api == GpuApi::vulkan ? "Vulkan" : "CUDA"; }

const char* name(GpuKind kind) {
  constexpr const char* names[] = {"discrete", "integrated", "virtual", "cpu"};
  return names[static_cast<size_t>(kind)];
}

std::vector<GpuInfo> gpu_devices(std::string* why_none) {
  std::vector<GpuInfo> infos;
  for (Numbered& device : numbered_devices(why_none)) infos.push_back(std::move(device.info));
  return infos;
}

GpuDevice::GpuDevice(int number) {
  std::string missing;
  const std::vector<Numbered> all = numbered_devices(&missing);
  if (all.empty()) throw InvalidOption("no GPU that tables can be applied on: " + missing);
  if (number < 0 || number >= std::ssize(all))
    throw InvalidOption("there is no GPU " + std::to_string(number) + "; " +
                        (all.size() == 1 ? "0 is right" : "0 to " + std::to_string(all.size() - 1) + " are right"));
  const Numbered& device = all[size_t(number)];
  driver_ =
      device.info.api == GpuApi::cuda ? gpu::open_cuda_device(device.number) : gpu::open_vulkan_device(device.number);
}

GpuDevice::GpuDevice(const EngineDevice& engine) : driver_(gpu::borrow_vulkan_device(engine)) {}

const GpuInfo& GpuDevice::info() const { return driver_->info(); }

GpuBuffer::GpuBuffer(const GpuDevice& device, std::int64_t bytes) {
  if (bytes < 0) throw InvalidParameter("a buffer of " + std::to_string(bytes) + " bytes on a GPU");
  memory_ = device.driver()->allocate(bytes);
}
GpuBuffer::~GpuBuffer() = default;
GpuBuffer::GpuBuffer(GpuBuffer&&) noexcept = default;
GpuBuffer& GpuBuffer::operator=(GpuBuffer&&) noexcept = default;

std::uint64_t GpuBuffer::address() const { return memory_->address(); }
std::int64_t GpuBuffer::num_bytes() const { return memory_->num_bytes(); }

namespace {
void check_range(std::int64_t at, size_t count, std::int64_t bytes) {
  if (at < 0 || at > bytes || std::int64_t(count) > bytes - at)
    throw InvalidParameter("bytes from " + std::to_string(at) + ", " + std::to_string(count) +
                           " of them, in a buffer of " + std::to_string(bytes));
}
}  // namespace

void GpuBuffer::write(std::span<const std::byte> bytes, std::int64_t at) {
  check_range(at, bytes.size(), num_bytes());
  memory_->write(at, bytes);
}
void GpuBuffer::read(std::span<std::byte> bytes, std::int64_t at) const {
  check_range(at, bytes.size(), num_bytes());
  memory_->read(at, bytes);
}

GpuCommands::GpuCommands(const GpuDevice& device) : recording_(device.driver()->begin()) {}
GpuCommands::~GpuCommands() = default;
GpuCommands::GpuCommands(GpuCommands&&) noexcept = default;
void* GpuCommands::handle() const { return recording_->handle(); }
void GpuCommands::copy(const GpuBuffer& from, GpuBuffer& to, std::int64_t bytes) const {
  if (bytes < 0 || bytes > std::min(from.num_bytes(), to.num_bytes()))
    throw InvalidParameter(std::to_string(bytes) + " bytes of a buffer of " + std::to_string(from.num_bytes()) +
                           " into one of " + std::to_string(to.num_bytes()));
  if (bytes > 0) recording_->copy(from.memory(), to.memory(), bytes);
}
void GpuCommands::submit_and_wait() { recording_->submit_and_wait(); }

}  // namespace sublimit
