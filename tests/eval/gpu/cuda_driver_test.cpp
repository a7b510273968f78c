// SPDX-License-Identifier: Apache-2.0
// The driver for CUDA over a library that stands in for NVIDIA's (cuda_stand_in/), where gpu.cuda_stand_in puts it.
// Where it is not, there is nothing to be seen but that nothing of it is there.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "eval/gpu/comparisons.h"
#include "eval/gpu/made_tables.h"
#include "eval/gpu/test_device.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/gpu/detail/compiled_kernels.h"
#include "sublimit/eval/gpu/gpu_evaluator.h"

namespace sublimit::testing {
namespace {

/// The library's own functions.
struct StandIn {
  void (*fail)(const char*, int, int) = nullptr;
  bool (*has_failed)() = nullptr;
  int (*live)() = nullptr;
  StandIn() {
    void* const library = ::dlopen("libcuda.so.1", RTLD_NOW);
    if (!library) return;
    fail = reinterpret_cast<decltype(fail)>(::dlsym(library, "stand_in_fail"));
    has_failed = reinterpret_cast<decltype(has_failed)>(::dlsym(library, "stand_in_has_failed"));
    live = reinterpret_cast<decltype(live)>(::dlsym(library, "stand_in_live"));
  }
  bool is_there() const { return live != nullptr; }
};

TEST(StandInForCuda, IsThereWhereItIsPut) {
  EXPECT_EQ(StandIn().is_there(), std::getenv("SUBLIMIT_STAND_IN_FOR_CUDA") != nullptr);
  const std::vector<GpuInfo> devices = gpu_devices();
  const bool first = !devices.empty() && devices.front().name == "stand-in for CUDA";
  EXPECT_EQ(first, StandIn().is_there());
  if (first) {
    EXPECT_EQ(devices.front().api, GpuApi::cuda);
    EXPECT_EQ(devices.front().driver, "CUDA 12.4");
  }
}

/// Each call of each function fails in turn: an error of the right kind, nothing is left behind, and the next time
/// works.
TEST(StandInForCuda, FailuresAreErrorsAndLeaveNothing) {
  const StandIn stand_in;
  if (!stand_in.is_there()) return;
  const PatternTable<float> table =
      made_table({.quantities = 3, .first = true, .rest = true, .copies = true, .placed = true}, 5);
  const std::vector<float> points = random_numbers(size_t(table.num_control_points() * 3), 5);
  std::vector<float> right(size_t(table.quantities() * table.num_points() * 3)), made(right.size()),
      gradient(points.size());
  apply_as_device(GpuDevice(0), table, points, 3, right);
  const auto work = [&] {
    const GpuEvaluator evaluator(table, GpuDevice(0));
    evaluator.apply(points, 3, made);
    evaluator.apply_transpose(made, 3, gradient);
  };
  std::set<std::string> failed;
  for (const char* function :
       {"cuDevicePrimaryCtxRetain", "cuCtxPushCurrent_v2", "cuModuleLoadData", "cuModuleGetFunction", "cuMemAlloc_v2",
        "cuMemcpyHtoD_v2", "cuMemcpyDtoH_v2", "cuStreamCreate", "cuStreamSynchronize", "cuLaunchKernel"})
    for (const int result : {2, 700, 801})
      for (int after = 0;; ++after) {
        SCOPED_TRACE(std::string(function) + ", " + std::to_string(result) + " after " + std::to_string(after));
        ASSERT_LT(after, 1000);
        const int live = stand_in.live();
        stand_in.fail(function, after, result);
        std::string said;
        try {
          work();
        } catch (const ResourceError& error) {
          EXPECT_EQ(result, 2);
          said = error.what();
        } catch (const IoError& error) {
          EXPECT_NE(result, 2);
          said = error.what();
        }
        const bool pushed = function == std::string("cuCtxPushCurrent_v2");
        EXPECT_TRUE(pushed || stand_in.live() == live);
        if (!stand_in.has_failed()) break;
        failed.insert(function);
        if (pushed && said.empty()) continue;  // at the end: what cannot be freed stays, and nobody is told
        EXPECT_NE(said.find(result == 2     ? "no memory left"
                            : result == 700 ? "the GPU was lost"
                                            : "the GPU failed"),
                  std::string::npos)
            << said;
        EXPECT_NE(said.find("on the CPU"), std::string::npos) << said;
      }
  EXPECT_EQ(failed.size(), 10u);
  stand_in.fail("", 0, 0);
  work();
  expect_near_terms(made, right, sums_of_terms(table, points, 3));
}

/// Four numbers of a vector are four: what compiles the kernels has mistaken the first for all of them.
TEST(CompiledKernels, StreamFourNumbers) {
  int stores = 0;
  for (const bool half : {false, true})
    for (const gpu::Kernel kernel : {gpu::Kernel::apply_patches, gpu::Kernel::apply_rows})
      for (const int quantities : {1, 3, 6}) {
        const char* const ptx = gpu::ptx_of({.kernel = kernel, .half = half, .quantities = quantities});
        if (!ptx) return;  // built without
        const std::string text = ptx;
        const std::regex store(
            "st\\.global\\.cs\\.v4\\.[fb]32 \\[%rd\\d+\\], \\{(%\\w+), (%\\w+), (%\\w+), (%\\w+)\\};");
        for (std::sregex_iterator it(text.begin(), text.end(), store), end; it != end; ++it, ++stores)
          EXPECT_EQ((std::set<std::string>{(*it)[1], (*it)[2], (*it)[3], (*it)[4]}.size()), 4u) << it->str();
        EXPECT_NE(
            text.find(".entry " + gpu::name_in_ptx({.kernel = kernel, .half = half, .quantities = quantities}) + "("),
            std::string::npos);
        EXPECT_EQ(text.find(".local"), std::string::npos) << "numbers of threads are not in registers";
      }
  EXPECT_EQ(stores, 2 * 3 * (8 + 4));
}

}  // namespace
}  // namespace sublimit::testing
