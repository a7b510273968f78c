// SPDX-License-Identifier: Apache-2.0
// Whatever fails on a device is an error that says what to do, and leaves nothing behind; a thousand frames leave no
// more than one.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "eval/gpu/comparisons.h"
#include "eval/gpu/faulty_vulkan.h"
#include "eval/gpu/made_tables.h"
#include "eval/gpu/test_device.h"
#include "sublimit/base/error.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/eval/gpu/gpu_evaluator.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

struct Failure {
  const char* function;
  VkResult result;
};
const Failure no_memory[] = {{"vkCreateBuffer", VK_ERROR_OUT_OF_DEVICE_MEMORY},
                             {"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY},
                             {"vkAllocateMemory", VK_ERROR_TOO_MANY_OBJECTS},
                             {"vkBindBufferMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY},
                             {"vkMapMemory", VK_ERROR_OUT_OF_HOST_MEMORY},
                             {"vkCreateShaderModule", VK_ERROR_OUT_OF_HOST_MEMORY},
                             {"vkCreatePipelineLayout", VK_ERROR_OUT_OF_HOST_MEMORY},
                             {"vkCreateComputePipelines", VK_ERROR_OUT_OF_DEVICE_MEMORY},
                             {"vkCreateCommandPool", VK_ERROR_OUT_OF_DEVICE_MEMORY},
                             {"vkAllocateCommandBuffers", VK_ERROR_OUT_OF_DEVICE_MEMORY},
                             {"vkBeginCommandBuffer", VK_ERROR_OUT_OF_HOST_MEMORY},
                             {"vkEndCommandBuffer", VK_ERROR_OUT_OF_HOST_MEMORY},
                             {"vkCreateFence", VK_ERROR_OUT_OF_HOST_MEMORY},
                             {"vkQueueSubmit", VK_ERROR_OUT_OF_DEVICE_MEMORY}};
const Failure lost[] = {{"vkQueueSubmit", VK_ERROR_DEVICE_LOST}, {"vkWaitForFences", VK_ERROR_DEVICE_LOST}};
const Failure others[] = {{"vkMapMemory", VK_ERROR_MEMORY_MAP_FAILED},
                          {"vkCreateComputePipelines", VK_ERROR_UNKNOWN},
                          {"vkCreateBuffer", VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS}};

class GpuFailures : public ::testing::Test {
 protected:
  /// Makes each call fail that `work` makes of a function, one after the other.
  /// @param begin  before each
  /// @param end    after each that failed
  template <class Expected>
  static void fail_each(std::span<const Failure> failures, std::initializer_list<std::string_view> parts,
                        const std::function<void()>& begin, const std::function<void()>& work,
                        const std::function<void()>& end, std::set<std::string>& failed) {
    for (const Failure& failure : failures)
      for (int after = 0;; ++after) {
        SCOPED_TRACE(std::string(failure.function) + ", after " + std::to_string(after));
        ASSERT_LT(after, 1000);
        begin();
        FaultyVulkan::fail(failure.function, after, failure.result);
        std::optional<std::string> said;
        try {
          work();
        } catch (const Expected& error) {
          said = error.what();
        } catch (const Error& error) {
          ADD_FAILURE() << "another kind of error: " << error.what();
        }
        const bool came = FaultyVulkan::has_failed(failure.function);
        FaultyVulkan::stop_failing();
        EXPECT_EQ(said.has_value(), came);
        if (!came) break;
        failed.insert(failure.function);
        for (const std::string_view part : parts) EXPECT_NE(said.value_or("").find(part), std::string::npos) << *said;
        end();
        if (HasFatalFailure()) return;
      }
  }

  void use(const GpuDevice& device) {
    const GpuEvaluator evaluator(table_, device);
    std::vector<float> made(right_.size()), gradient(points_.size());
    evaluator.apply(points_, 3, made);
    expect_near_terms(made, right_, terms_);
    evaluator.apply_transpose(made, 3, gradient);
  }

  /// @param quantities  1 for what compiles its kernels again and again
  explicit GpuFailures(int quantities = 1)
      : table_(made_table({.quantities = quantities, .first = true, .rest = true, .copies = true, .placed = true}, 5)) {
    table_.apply(points_, 3, right_);
  }

  const PatternTable<float> table_;
  const std::vector<float> points_ = random_numbers(size_t(table_.num_control_points()) * 3, 5);
  const std::vector<double> terms_ = sums_of_terms(table_, points_, 3);
  std::vector<float> right_ = std::vector<float>(size_t(table_.quantities() * table_.num_points() * 3));
  const Engine engine_;
  const FaultyVulkan faulty_{engine_};
};

/// From the opening of the device to its end.
TEST_F(GpuFailures, AreErrorsAndLeaveNothing) {
  for (const bool separate : {false, true}) {
    SCOPED_TRACE(separate ? "memory that the host does not reach" : "memory that the host reaches");
    if (separate) FaultyVulkan::separate_memories();
    std::set<std::string> failed;
    const auto work = [&] { use(GpuDevice(faulty_.lent())); };
    const auto end = [] { EXPECT_EQ(FaultyVulkan::num_alive(), 0) << ::testing::PrintToString(FaultyVulkan::alive()); };
    fail_each<ResourceError>(
        no_memory, {"no memory left", "smaller table", "apply on the CPU"}, [] {}, work, end, failed);
    fail_each<IoError>(
        lost, {"the GPU was lost", "open the device again"}, [] {}, work, end, failed);
    fail_each<IoError>(
        others, {"the GPU failed", "Vulkan's error -"}, [] {}, work, end, failed);
    EXPECT_EQ(failed.size(), 14u) << ::testing::PrintToString(failed);
    end();
  }
}

/// An evaluator goes on after a failure, unless its device is lost, and has no more than before.
TEST_F(GpuFailures, AreOverWhenTheyAreOver) {
  for (const bool separate : {false, true}) {
    SCOPED_TRACE(separate);
    if (separate) FaultyVulkan::separate_memories();
    std::optional<GpuDevice> device;
    std::optional<GpuEvaluator> evaluator;
    std::vector<float> made(right_.size());
    std::int64_t alive = 0;
    // An evaluator that has made nothing yet, and one that has.
    for (const bool is_warm : {false, true}) {
      SCOPED_TRACE(is_warm);
      const auto begin = [&] {
        evaluator.reset(), device.reset();
        device.emplace(faulty_.lent());
        evaluator.emplace(table_, *device);
        for (int i = 0; is_warm && i < 5; ++i) evaluator->apply(points_, 3, made);
      };
      begin();
      evaluator->apply(points_, 3, made);
      alive = FaultyVulkan::num_alive();
      const auto again = [&] {
        std::ranges::fill(made, 0.0f);
        evaluator->apply(points_, 3, made);
        expect_near_terms(made, right_, terms_);
        EXPECT_LE(FaultyVulkan::num_alive(), alive);
      };
      std::set<std::string> failed;
      fail_each<ResourceError>(
          no_memory, {}, begin, [&] { evaluator->apply(points_, 3, made); }, again, failed);
      fail_each<IoError>(
          others, {}, begin, [&] { evaluator->apply(points_, 3, made); }, again, failed);
      // A warm one takes commands alone. What copies to memory that the host does not reach was there before.
      EXPECT_EQ(failed.size(), is_warm                                         ? 6u
                               : FaultyVulkan::of("vkCmdCopyBuffer").count > 0 ? 11u
                                                                               : 12u)
          << ::testing::PrintToString(failed);
    }
  }
}

/// A wait that fails for want of memory says nothing of the work that it was for: buffers, commands and the fence are
/// kept until that is done.
TEST_F(GpuFailures, OfAWaitEndNothingThatIsInUse) {
  const GpuDevice device(faulty_.lent());
  const GpuEvaluator evaluator(table_, device);
  std::vector<float> made(right_.size());
  evaluator.apply(points_, 3, made);
  FaultyVulkan::fail("vkWaitForFences", 0, VK_ERROR_OUT_OF_HOST_MEMORY);
  try {
    evaluator.apply(points_, 3, made);  // waiting again is as good as an error
  } catch (const ResourceError&) {
  }
  EXPECT_TRUE(FaultyVulkan::has_failed("vkWaitForFences"));
  EXPECT_EQ(FaultyVulkan::num_ended_too_early(), 0);
}

class GpuFrames : public GpuFailures {
 protected:
  GpuFrames() : GpuFailures(3) {}
};

/// Memory that the host does not reach, in pieces of what is copied at once.
TEST_F(GpuFrames, AreCopiedInPieces) {
  FaultyVulkan::separate_memories();
  const GpuDevice device(faulty_.lent());
  std::vector<float> numbers(size_t{17} << 20), read(numbers.size());  // 68 MB
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = float(i % 8191);
  GpuBuffer buffer(device, std::int64_t(numbers.size() * 4));
  buffer.write(std::as_bytes(std::span(numbers)));
  buffer.read(std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read, numbers);
  EXPECT_EQ(FaultyVulkan::of("vkCmdCopyBuffer").count, 6);
  std::vector<float> few(3, -1);
  buffer.write(std::as_bytes(std::span(few)), 4 * 8'388'607);  // from one piece into the next
  buffer.read(std::as_writable_bytes(std::span(read)), 0);
  EXPECT_EQ(read[8'388'606], float(8'388'606 % 8191));
  EXPECT_EQ(read[8'388'607], -1);
  EXPECT_EQ(read[8'388'609], -1);
  EXPECT_EQ(read[8'388'610], float(8'388'610 % 8191));
  use(device);
}

/// The same under the eyes of the validation layer, which knows how copies must wait.
TEST_F(GpuFrames, CopiedWaitForEachOther) {
  if (!Engine::layer_is_there()) return;  // EngineDevices fails then
  Messages messages;
  {
    const Engine engine(&messages);
    const FaultyVulkan faulty(engine);
    FaultyVulkan::separate_memories();
    const GpuDevice device(faulty.lent());
    for (int frame = 0; frame < 3; ++frame) use(device);
    EXPECT_GT(FaultyVulkan::of("vkCmdCopyBuffer").count, 9);
  }
  for (const std::string& message : messages.all()) ADD_FAILURE() << message;
}

/// Kilobytes of this process that are in memory.
std::int64_t resident() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t pages = 0;
  statm >> pages >> pages;
  return pages * 4;
}

TEST_F(GpuFrames, OfAThousandTakeWhatOneTakes) {
  const GpuDevice device(faulty_.lent());
  const GpuEvaluator evaluator(table_, device);
  const auto length = size_t(table_.num_points() * 3);
  std::vector<float> made(right_.size()), normals(length), gradient(points_.size());
  Evaluation<float> e;
  e.points = points_, e.quantities[0] = std::span(made).first(length), e.normals = normals;
  const auto frame = [&](int i) {
    if (i % 4 == 3)
      evaluator.apply_transpose(made, 3, gradient);
    else if (i % 4 == 2)
      evaluator.apply(e);
    else
      evaluator.apply(points_, 3, made);
  };
  for (int i = 0; i < 40; ++i) frame(i);
  const auto alive = FaultyVulkan::alive();
  const std::int64_t allocated = FaultyVulkan::of("vkAllocateMemory").count, before = resident();
  for (int i = 0; i < 1000; ++i) frame(i);
  EXPECT_EQ(FaultyVulkan::alive(), alive);
  EXPECT_EQ(FaultyVulkan::of("vkAllocateMemory").count, allocated);  // nothing is given back only to be taken again
  EXPECT_LT(resident() - before, 4096);
  evaluator.apply(points_, 3, made);
  expect_near_terms(made, right_, terms_);
}

/// What is kept for the next frame is what one frame takes: its points and its results.
TEST_F(GpuFrames, KeepWhatTheyTake) {
  // Many points of few control points.
  PatternTable<float>::Arrays a;
  constexpr std::int64_t rows = 1'000'000;
  std::vector<std::int64_t> offsets(rows + 1);
  for (std::int64_t i = 0; i < rows; ++i) offsets[size_t(i + 1)] = i + 1;
  a.rest = StencilTable<float>(2, offsets, std::vector<std::int32_t>(rows), std::vector<float>(rows, 1));
  const PatternTable<float> table(2, std::move(a));
  const GpuDevice device(faulty_.lent());
  const GpuEvaluator evaluator(table, device);
  const std::vector<float> points(6, 1);
  std::vector<float> made(size_t{3 * rows});
  const std::int64_t before = FaultyVulkan::num_bytes();
  for (int i = 0; i < 8; ++i) evaluator.apply(points, 3, made);
  EXPECT_LE(FaultyVulkan::num_bytes() - before, 12 * rows + 65536);
}

/// As many frames in one call, more than a device counts: each has its own points.
TEST_F(GpuFrames, OfOneCallMayBeMany) {
  PatternTable<float>::Arrays a;
  a.blocks = {{2, 2, 0}};
  a.weights = {0.5f, 0.25f, 2, -1};
  a.groups = {{0, 2, 0, 1}};
  a.rows = {0, 1};
  a.columns = {0, 1};
  a.copies = {0, 1};
  const PatternTable<float> table(2, std::move(a));
  const GpuDevice device(faulty_.lent());
  const GpuEvaluator evaluator(table, device);
  const std::int64_t before = FaultyVulkan::num_alive();
  for (const int frames : {1000, 70000}) {
    const std::vector<float> points = random_numbers(size_t(frames) * 2, 3);
    std::vector<float> made(size_t(frames) * 2);
    Evaluation<float> e;
    e.channels = 1, e.frames = frames, e.points = points, e.quantities[0] = made;
    evaluator.apply(e);
    size_t wrong = 0;
    for (size_t f = 0; f < size_t(frames); ++f) {
      const float right = 2 * points[2 * f] - points[2 * f + 1];
      wrong += std::abs(made[2 * f] - right) > 3e-7f || made[2 * f] != made[2 * f + 1];
    }
    EXPECT_EQ(wrong, 0u) << frames << " frames";
  }
  EXPECT_LE(FaultyVulkan::num_alive(), before + 2 * 3 + 2);  // points, results and scratch; kernels
}

/// More workgroups than a row of them has: of rows, of patches, of copies.
TEST_F(GpuFrames, MayTakeManyWorkgroups) {
  constexpr std::int32_t patches = 70'000, rows = 4'200'000;
  PatternTable<float>::Arrays a;
  a.blocks = {{1, 1, 0}};
  a.weights = {2};
  a.rows = {0};
  std::vector<std::int32_t> columns, row_columns(rows);
  for (int i = 0; i < patches; ++i) {
    a.groups.push_back({0, 1, 0, 1});
    columns.push_back(i % 1000);
  }
  std::vector<std::int64_t> offsets(rows + 1);
  for (std::int32_t i = 0; i < rows; ++i) row_columns[size_t(i)] = i % 999, offsets[size_t(i) + 1] = i + 1;
  a.columns = columns;
  a.rest = StencilTable<float>(1000, offsets, row_columns, std::vector<float>(rows, 3));
  const PatternTable<float> table(1000, std::move(a));
  std::vector<float> points(1000), made(size_t(patches + rows));
  for (size_t i = 0; i < points.size(); ++i) points[i] = float(i);
  const GpuDevice device(faulty_.lent());
  const GpuEvaluator evaluator(table, device);
  evaluator.apply(points, 1, made);
  size_t wrong = 0;
  for (std::int32_t i = 0; i < patches; ++i) wrong += made[size_t(i)] != float(2 * (i % 1000));
  for (std::int32_t i = 0; i < rows; ++i) wrong += made[size_t(patches + i)] != float(3 * (i % 999));
  EXPECT_EQ(wrong, 0u);
  std::vector<float> gradient(points.size());
  std::ranges::fill(made, 1.0f);
  evaluator.apply_transpose(made, 1, gradient);
  for (std::int32_t i = 0; i < 1000; ++i) {
    const auto uses = [&](std::int32_t count, std::int32_t period) {
      return i >= period ? 0 : count / period + (i < count % period);
    };
    ASSERT_EQ(gradient[size_t(i)], float(2 * uses(patches, 1000) + 3 * uses(rows, 999))) << i;
  }
}

/// Tables of several sizes by several threads: what each keeps is what it has at once.
TEST_F(GpuFrames, OfThreadsKeepWhatTheyUseAtOnce) {
  const GpuDevice device(faulty_.lent());
  std::vector<PatternTable<float>> tables;
  std::vector<GpuEvaluator> evaluators;
  for (unsigned seed = 0; seed < 3; ++seed)
    tables.push_back(made_table({.quantities = 1, .first = seed == 1, .rest = true}, seed));
  for (const auto& table : tables) evaluators.emplace_back(table, device);
  constexpr int num_threads = 4;
  std::atomic<int> wrong = 0;
  const auto run = [&](int frames) {
    std::vector<std::thread> threads;
    for (int thread = 0; thread < num_threads; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = 0; i < frames; ++i) {
          const size_t number = size_t(thread + i) % tables.size();
          const auto& table = tables[number];
          const std::vector<float> points = random_numbers(size_t(table.num_control_points()) * 3, unsigned(i % 5));
          std::vector<float> right(size_t(table.num_points()) * 3), made(right.size());
          table.apply(points, 3, right);
          evaluators[number].apply(points, 3, made);
          for (size_t k = 0; k < made.size(); ++k) wrong += !(std::abs(made[k] - right[k]) <= 1e-5f);
        }
      });
    for (std::thread& thread : threads) thread.join();
  };
  run(100);
  EXPECT_EQ(wrong, 0);
  // Points, results and scratch of each thread, for each of the tables, and the tables.
  EXPECT_LE(FaultyVulkan::alive()["vkAllocateMemory"], 3 * num_threads * std::ssize(tables) + std::ssize(tables));
  for (const char* gone : {"vkCreateCommandPool", "vkCreateFence", "vkCreateShaderModule"})
    EXPECT_EQ(FaultyVulkan::alive()[gone], 0) << gone;
}

/// What is asked for every frame, in the memory of the device.
class Recorded : public GpuFrames {
 protected:
  template <class Body>
  void for_each_asked(const GpuEvaluator& evaluator, const Body& body) {
    GpuEvaluation e;
    for (std::uint64_t& quantity : e.quantities) quantity = 0;
    e.points = 4096, e.scratch = 8192;
    for (int q = 0; q < table_.quantities(); ++q) e.quantities[size_t(q)] = std::uint64_t(65536 * (q + 1));
    e.normals = 1 << 20;
    body(e);
    e.channels = 9, e.normals = 0, e.frames = 3;
    body(e);
    e.rational = true;
    body(e);
    GpuTranspose t;
    t.quantities = 3, t.values = 4096, t.result = 65536, t.scratch = 1 << 20;
    (void)evaluator.num_scratch_bytes(t);
    body(t);
  }
};

TEST_F(Recorded, CommandsMakeNothingOnTheDevice) {
  const GpuDevice device(faulty_.lent());
  const GpuEvaluator evaluator(table_, device);
  FaultyVulkan::leave_out_commands(true);
  const VkCommandBuffer commands = engine_.begin();
  for_each_asked(evaluator, [&](const auto& asked) {
    evaluator.prepare(asked);
    const std::int64_t before = FaultyVulkan::num_made(), submitted = FaultyVulkan::of("vkQueueSubmit").count,
                       waited = FaultyVulkan::of("vkWaitForFences").count;
    evaluator.record(commands, asked);
    EXPECT_EQ(FaultyVulkan::num_made(), before);
    EXPECT_EQ(FaultyVulkan::of("vkQueueSubmit").count, submitted);
    EXPECT_EQ(FaultyVulkan::of("vkWaitForFences").count, waited);
  });
}

/// "`record` then neither allocates nor waits."
TEST_F(Recorded, CommandsTakeNoMemoryOfTheHost) {
  if (!allocations_are_counted()) GTEST_SKIP() << "SKIPPED: sanitizers have allocators of their own";
  const GpuDevice device(faulty_.lent());
  const GpuEvaluator evaluator(table_, device);
  FaultyVulkan::leave_out_commands(true);
  const VkCommandBuffer commands = engine_.begin();
  for_each_asked(evaluator, [&](const auto& asked) {
    evaluator.prepare(asked);
    const std::int64_t before = allocations();
    evaluator.record(commands, asked);
    EXPECT_EQ(allocations() - before, 0);
  });
}

/// This program again, one of its tests, with these variables of the environment.
/// @return  what it prints
std::string run_again(const std::string& variables, const std::string& filter, int& status) {
  const TemporaryDirectory directory;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string(), out = directory / "out";
  status = std::system(
      ("/usr/bin/env " + variables + " '" + program + "' --gtest_filter='" + filter + "' > '" + out + "' 2>&1")
          .c_str());
  return read_file(out);
}

/// By itself: there is a device, or a reason why there is none. With SUBLIMIT_TEST_NO_GPU: there is none, for this
/// reason.
TEST(GpuDevices, AreListedOrSaidToBeMissing) {
  std::string why;
  const std::vector<GpuInfo> devices = gpu_devices(&why);
  const char* const reason = std::getenv("SUBLIMIT_TEST_NO_GPU");
  EXPECT_EQ(devices.empty(), reason != nullptr);
  EXPECT_EQ(devices.empty(), !why.empty()) << why;
  if (!reason) {
    for (const GpuInfo& info : devices) {
      EXPECT_FALSE(info.name.empty());
      EXPECT_FALSE(info.driver.empty());
      EXPECT_GT(info.memory, 0);
    }
    EXPECT_TRUE(std::ranges::is_sorted(devices, {}, &GpuInfo::kind));
    EXPECT_EQ(GpuDevice(0).info().name, devices[0].name);
    expect_error<InvalidOption>([&] { GpuDevice(int(devices.size())); },
                                {"there is no GPU " + std::to_string(devices.size()), " right"});
    expect_error<InvalidOption>([] { GpuDevice(-1); }, {"there is no GPU -1"});
    return;
  }
  EXPECT_NE(why.find(reason), std::string::npos) << why;
  for (const int number : {0, 1, -1}) expect_error<InvalidOption>([&] { GpuDevice{number}; }, {"no GPU", reason});
  // An engine's device needs a loader, if it brings none.
  if (std::string_view(reason).find("loader") != std::string_view::npos)
    expect_error<IoError>([] { GpuDevice{EngineDevice{}}; }, {reason});
}

TEST(GpuDevices, AreMissedWithAReason) {
  int status = 0;
  const std::string none =
      "CUDA_VISIBLE_DEVICES= VK_DRIVER_FILES=/nonexistent.json VK_ICD_FILENAMES=/nonexistent.json ";
  const char* const test = "GpuDevices.AreListedOrSaidToBeMissing";
  std::string said = run_again(none + "SUBLIMIT_TEST_NO_GPU='mesa-vulkan-drivers'", test, status);
  EXPECT_EQ(status, 0) << said;
  EXPECT_NE(said.find("[  PASSED  ] 1 test"), std::string::npos) << said;
  // Neither a loader: a file of its name that is none.
  const TemporaryDirectory directory;
  directory.write("libvulkan.so.1", "");
  said = run_again("CUDA_VISIBLE_DEVICES= LD_LIBRARY_PATH='" + directory.path().string() +
                       "' SUBLIMIT_TEST_NO_GPU='no Vulkan loader, libvulkan.so.1'",
                   test, status);
  EXPECT_EQ(status, 0) << said;
}

TEST(GpuDevices, NeedNoWindow) {
  int status = 0;
  const std::string said =
      run_again("-u DISPLAY -u WAYLAND_DISPLAY -u XDG_RUNTIME_DIR -u XAUTHORITY",
                "GpuDevices.AreListedOrSaidToBeMissing:GpuEvaluator.MakesUnitTangentFrames", status);
  EXPECT_EQ(status, 0) << said;
  EXPECT_NE(said.find("[  PASSED  ] 2 tests"), std::string::npos) << said;
}

/// Kernels check nothing: what would lead them astray is no table.
TEST(HostileTables, DoNotExist) {
  using Arrays = PatternTable<float>::Arrays;
  const PatternTable<float> good =
      made_table({.quantities = 3, .first = true, .rest = true, .copies = true, .placed = true}, 5);
  const auto refuse = [&](const std::function<void(Arrays&)>& spoil, std::string_view part) {
    Arrays a = good.arrays();
    spoil(a);
    expect_error<InvalidParameter>([&] { PatternTable<float>(good.num_control_points(), std::move(a)); }, {part});
  };
  const auto changed = [](const auto& numbers, auto value) {
    std::vector all(numbers.begin(), numbers.end());
    all.back() = value;
    return all;
  };
  EXPECT_NO_THROW(PatternTable<float>(good.num_control_points(), Arrays(good.arrays())));
  refuse([&](Arrays& a) { a.columns = changed(a.columns, std::int32_t{70}); }, "control point 70");
  refuse([&](Arrays& a) { a.columns = changed(a.columns, std::int32_t{-1}); }, "control point -1");
  refuse([&](Arrays& a) { a.rows = changed(a.rows, std::int32_t{1000}); }, "row 1000");
  refuse([&](Arrays& a) { a.copies = changed(a.copies, std::int32_t(good.num_points())); }, "copies point");
  refuse([&](Arrays& a) { a.patch_points = changed(a.patch_points, good.num_points()); }, "begin at");
  refuse([&](Arrays& a) { a.patch_points = changed(a.patch_points, std::int64_t{-1}); }, "begin at -1");
  refuse([&](Arrays& a) { a.weights = changed(a.weights, std::numeric_limits<float>::quiet_NaN()); }, "not finite");
  refuse([](Arrays& a) { a.groups[0].block = 4; }, "block 4");
  refuse([](Arrays& a) { a.groups[0].num_patches += 1; }, "");
  refuse([](Arrays& a) { a.groups[0].num_rows = -1; }, "");
  refuse([](Arrays& a) { a.groups[0].rows = std::int64_t{1} << 40; }, "rows");
  refuse([](Arrays& a) { a.blocks[0].weights = std::int64_t{1} << 62; }, "weights");
  refuse([](Arrays& a) { a.blocks[0].rows = -1; }, "negative");
  refuse([](Arrays& a) { a.quantities = 2; }, "2 quantities");
  expect_error<InvalidParameter>([] { StencilTable<float>(2, {0, 1}, {2}, {1.0f}); }, {"2"});
  expect_error<InvalidParameter>([] { StencilTable<float>(2, {0, -1, 1}, {1}, {1.0f}); }, {});
}

/// Numbers that 32 bits do not hold are refused, not cut.
TEST(HostileTables, AreNotCut) {
  const GpuDevice device = test_device();
  // Points of nothing are none of the host's memory.
  PatternTable<float>::Arrays a;
  a.blocks = {{1000, 0, 0}};
  a.rows = std::vector<std::int32_t>(1000);
  a.groups = {{0, 1000, 0, 4'294'968}};
  const PatternTable<float> table(1, std::move(a));
  EXPECT_GT(table.num_points(), std::int64_t{std::numeric_limits<std::uint32_t>::max()});
  expect_error<ResourceError>([&] { GpuEvaluator(table, device); },
                              {"count up to 2147483647 points", "cut the table into several", "on the CPU"});

  // One row of weights a million times: refused before they are packed.
  PatternTable<float>::Arrays repeated;
  repeated.blocks = {{1, 4000, 0}};
  repeated.weights = std::vector<float>(4000, 1);
  repeated.columns = std::vector<std::int32_t>(4000);
  repeated.rows = std::vector<std::int32_t>(1'000'000);
  repeated.groups = {{0, 1'000'000, 0, 1}};
  const PatternTable<float> large_weights(1, std::move(repeated));
  expect_error<ResourceError>([&] { GpuEvaluator(large_weights, device); }, {"count up to 2147483647 weights"});

  const PatternTable<float> small = made_table({}, 1);
  const GpuEvaluator evaluator(small, device);
  constexpr std::int64_t large = std::int64_t{1} << 32;
  GpuEvaluation e;
  e.points = 4, e.quantities[0] = 4, e.frames = 2;
  EXPECT_NO_THROW(evaluator.prepare(e));
  for (const auto& spoil : std::initializer_list<std::function<void(GpuEvaluation&)>>{
           [](auto& s) { s.point_layout.point = large; },
           [](auto& s) {
             s.point_layout = {1, large, 0};
           },
           [](auto& s) { s.point_layout.frame = large; }, [](auto& s) { s.result_layout.point = large; },
           [](auto& s) {
             s.result_layout = {1, large, 0};
           },
           [](auto& s) { s.result_layout.frame = large; },
           // No stride is too long, but the last point is too far.
           [](auto& s) { s.point_layout.point = large / 10; },
           [](auto& s) {
             s.point_layout = {1, large / 2, 0};
           }}) {
    GpuEvaluation spoilt = e;
    spoil(spoilt);
    expect_error<ResourceError>([&] { evaluator.prepare(spoilt); }, {"strides of", "1073741823"});
  }
}

/// Frames are made in pieces, of their points as of their results.
TEST(LargeFrames, OfPointsAreMadeInPieces) {
  PatternTable<float>::Arrays a;
  a.rest = StencilTable<float>(std::int32_t{1} << 24, {0, 1}, {(1 << 24) - 1}, {2});
  const PatternTable<float> table(std::int32_t{1} << 24, std::move(a));
  constexpr int frames = 36;  // of 64 MB: lavapipe takes 2 GB at once
  std::vector<float> points(size_t{frames} << 24), made(frames, -1);
  for (size_t frame = 0; frame < frames; ++frame) points[((frame + 1) << 24) - 1] = float(frame);
  Evaluation<float> e;
  e.channels = 1, e.frames = frames, e.points = points, e.quantities[0] = made;
  GpuEvaluator(table, test_device()).apply(e);
  for (size_t frame = 0; frame < frames; ++frame) EXPECT_EQ(made[frame], 2 * float(frame));
}

/// Strides that are not refused lead to the right place. Addresses of lavapipe are the host's, which has room for them.
TEST(HostileTables, StridesThatAreTakenAreNotCut) {
  const GpuDevice device = test_device();
  if (device.info().kind != GpuKind::cpu) return;
  PatternTable<float>::Arrays patches, rows, copied;
  patches.blocks = {{2, 2, 0}}, patches.weights = {1, 0, 0, 1}, patches.rows = {0, 1}, patches.columns = {0, 1};
  patches.groups = {{0, 2, 0, 1}};
  rows.rest = StencilTable<float>(2, {0, 1, 2}, {0, 1}, {1, 1});
  copied = patches;
  copied.copies = {1, 0};
  constexpr size_t length = std::int64_t{10} << 30, half = length / 2;
  void* const mapped = ::mmap(nullptr, length * sizeof(float), PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(mapped, MAP_FAILED);
  const std::span<float> memory(static_cast<float*>(mapped), length);
  int taken = 0;
  for (const auto& [arrays, channels] : {std::pair(&patches, 2), {&rows, 2}, {&copied, 2}, {&patches, 9}, {&copied, 9}})
    for (const std::int64_t stride : {std::int64_t{1} << 29, (std::int64_t{1} << 30) + 8, (std::int64_t{1} << 31) + 8})
      for (const int which : {0, 1, 2, 3, 4, 5}) {
        SCOPED_TRACE("stride " + std::to_string(stride) + ", " + std::to_string(which));
        const PatternTable<float> table(2, PatternTable<float>::Arrays(*arrays));
        const GpuEvaluator evaluator(table, device);
        // Two frames of two points.
        PointLayout layout{channels, 1, 2 * channels};
        (which % 3 == 0 ? layout.point : which % 3 == 1 ? layout.channel : layout.frame) = stride;
        if (which % 3 == 0) layout.frame = channels;
        if (which % 3 == 1) layout.point = 1, layout.frame = 2;
        GpuEvaluation e;
        e.channels = channels, e.frames = which % 3 == 2 ? 2 : 1;
        PointLayout given{channels, 1, 2 * channels}, results = given;
        (which < 3 ? given : results) = layout;
        const auto at = [&](const PointLayout& l, int frame, int point, int channel) {
          return size_t(frame * l.frame + point * l.point + channel * l.channel);
        };
        if (at(layout, e.frames - 1, 1, channels - 1) >= half) continue;
        e.point_layout = given, e.result_layout = results;
        e.points = reinterpret_cast<std::uint64_t>(memory.data());
        e.quantities[0] = reinterpret_cast<std::uint64_t>(memory.data() + half);
        const auto for_each = [&](const auto& body) {
          for (int frame = 0; frame < e.frames; ++frame)
            for (int point = 0; point < 2; ++point)
              for (int channel = 0; channel < e.channels; ++channel) body(frame, point, channel);
        };
        const auto number = [](int frame, int point, int channel) {
          return float(1 + channel + 16 * point + 32 * frame);
        };
        const bool is_copied = arrays == &copied;
        for_each([&](int f, int p, int c) { memory[at(given, f, p, c)] = number(f, p, c); });
        try {
          evaluator.prepare(e);
        } catch (const Error&) {
          continue;
        }
        ++taken;
        GpuCommands commands(device);
        evaluator.record(commands, e);
        commands.submit_and_wait();
        int wrong = 0;
        for_each([&](int f, int p, int c) {
          wrong += memory[half + at(results, f, p, c)] != number(f, is_copied ? 0 : p, c);
        });
        ASSERT_EQ(wrong, 0);
      }
  ::munmap(mapped, length * sizeof(float));
  EXPECT_GE(taken, 20);
}

}  // namespace
}  // namespace sublimit::testing
