// SPDX-License-Identifier: Apache-2.0
// GPUs of this machine, and tables on them.
#include "gpus.h"

#include <string>

#include "calls.h"
#include "module.h"
#ifdef SUBLIMIT_GPU
#include "sublimit/gpu/gpu_evaluator.h"
#endif

namespace sublimit::python {
namespace py = pybind11;

#ifdef SUBLIMIT_GPU
namespace {

/// The device of this number, the same one for all tables that are on it.
std::shared_ptr<const GpuDevice> shared_device(int number) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<const GpuDevice>> opened;
  const std::lock_guard lock(mutex);
  std::shared_ptr<const GpuDevice> device = opened[number].lock();
  if (device) return device;
  try {
    device = std::make_shared<const GpuDevice>(number);
  } catch (const InvalidOption& error) {
    throw InvalidOption(error.what() + std::string("; device='cpu' applies tables on the CPU"));
  }
  opened[number] = device;
  return device;
}

py::list devices() {
  py::list all;
  for (const GpuInfo& info : without_gil([] { return gpu_devices(); }))
    all.append(py::make_tuple(info.name, name(info.api), name(info.kind), info.memory, info.halves, info.driver));
  return all;
}

}  // namespace

template <class Real>
const GpuEvaluator& TableOnGpus<Real>::on(int gpu) const {
  const std::lock_guard lock(mutex_);
  const auto found = uploaded_.find(gpu);
  if (found != uploaded_.end()) return *found->second.evaluator;
  Uploaded made;
  made.device = shared_device(gpu);
  made.evaluator = std::make_shared<const GpuEvaluator>(table_, *made.device);
  return *uploaded_.emplace(gpu, std::move(made)).first->second.evaluator;
}

template <class Real>
void TableOnGpus<Real>::apply(const Evaluation<Real>& evaluation, int gpu) const {
  on(gpu).apply(evaluation);
}
template <class Real>
void TableOnGpus<Real>::apply_transpose(std::span<const Real> values, int channels, std::span<Real> result,
                                        int gpu) const {
  on(gpu).apply_transpose(values, channels, result);
}
#else
namespace {

[[noreturn]] void refuse() {
  throw InvalidOption(
      "this module was built without its part for GPUs, which -DSUBLIMIT_BUILD_GPU=ON adds (Debian: glslc "
      "libvulkan-dev); device='cpu' applies tables on the CPU");
}

py::list devices() { return py::list(); }

}  // namespace

template <class Real>
void TableOnGpus<Real>::apply(const Evaluation<Real>&, int) const {
  refuse();
}
template <class Real>
void TableOnGpus<Real>::apply_transpose(std::span<const Real>, int, std::span<Real>, int) const {
  refuse();
}
#endif

template class TableOnGpus<float>;

void add_gpus(py::module_& m) { m.def("gpu_devices", &devices); }

}  // namespace sublimit::python
