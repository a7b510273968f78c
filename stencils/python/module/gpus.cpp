// SPDX-License-Identifier: Apache-2.0
// GPUs of this machine, and tables on them.
#include "gpus.h"

#include <string>

#include "calls.h"
#include "module.h"
#include "optional_parts.h"
#ifdef SUBLIMIT_GPU
#include "sublimit/eval/gpu/gpu_evaluator.h"
#endif

namespace sublimit::python {
namespace py = pybind11;

#ifdef SUBLIMIT_GPU
namespace {

/// The device of this number, the same one for all tables that are on it.
/// Devices that tables are on.
struct Opened {
  std::mutex mutex;
  std::map<int, std::weak_ptr<const GpuDevice>> devices;
};
Opened& opened() {
  static Opened all;
  return all;
}

std::shared_ptr<const GpuDevice> shared_device(int number) {
  const std::lock_guard lock(opened().mutex);
  std::shared_ptr<const GpuDevice> device = opened().devices[number].lock();
  if (device) return device;
  try {
    device = std::make_shared<const GpuDevice>(number);
  } catch (const InvalidOption& error) {
    throw InvalidOption(error.what() + std::string("; device='cpu' applies tables on the CPU"));
  }
  opened().devices[number] = device;
  return device;
}

/// So that the next call opens it again.
void forget_device(int number, const std::shared_ptr<const GpuDevice>& device) {
  const std::lock_guard lock(opened().mutex);
  if (opened().devices[number].lock() == device) opened().devices.erase(number);
}

py::list devices() {
  py::list all;
  for (const GpuInfo& info : without_gil([] { return gpu_devices(); }))
    all.append(py::make_tuple(info.name, name(info.api), name(info.kind), info.memory, info.halves, info.driver));
  return all;
}

}  // namespace

template <class Real>
template <class Call>
void TableOnGpus<Real>::on(int gpu, const Call& call) const {
  Uploaded uploaded;
  {
    const std::lock_guard lock(mutex_);
    Uploaded& kept = uploaded_[gpu];
    if (!kept.evaluator) {
      kept.device = shared_device(gpu);
      kept.evaluator = std::make_shared<const GpuEvaluator>(table_, *kept.device);
    }
    uploaded = kept;
  }
  try {
    call(*uploaded.evaluator);
  } catch (const IoError&) {  // lost: nothing works there again
    forget_device(gpu, uploaded.device);
    const std::lock_guard lock(mutex_);
    if (uploaded_[gpu].evaluator == uploaded.evaluator) uploaded_.erase(gpu);
    throw;
  }
}

template <class Real>
void TableOnGpus<Real>::apply(const Evaluation<Real>& evaluation, int gpu) const {
  on(gpu, [&](const GpuEvaluator& evaluator) { evaluator.apply(evaluation); });
}
template <class Real>
void TableOnGpus<Real>::apply_transpose(std::span<const Real> values, int channels, std::span<Real> result,
                                        int gpu) const {
  on(gpu, [&](const GpuEvaluator& evaluator) { evaluator.apply_transpose(values, channels, result); });
}
#else
namespace {

[[noreturn]] void refuse() {
  throw InvalidOption("this module was built without its part for GPUs: " + how_to_build(gpu_part) +
                      "; device='cpu' applies tables on the CPU");
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
