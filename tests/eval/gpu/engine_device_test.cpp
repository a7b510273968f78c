// SPDX-License-Identifier: Apache-2.0
// An engine with a device of its own records tables into its own commands, and Vulkan's validation layer has nothing to
// say, about synchronisation neither.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <vector>

#include "eval/gpu/comparisons.h"
#include "eval/gpu/engine.h"
#include "eval/gpu/made_tables.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/gpu/gpu_evaluator.h"
#include "support/expect_error.h"
#include "support/skip.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

/// An engine under validation. A test that goes on is about what the layer says.
class EngineDevices : public ::testing::Test {
 protected:
  void SetUp() override {
    SUBLIMIT_NEEDS_PROGRAM(Engine::layer_is_there(), "vulkan-validationlayers, Vulkan's validation layer");
    engine_ = std::make_unique<Engine>(&messages_);
  }
  /// After the end of all that was made.
  void TearDown() override {
    engine_.reset();
    for (const std::string& message : messages_.all()) ADD_FAILURE() << message;
  }
  bool heard(const std::string& id) {
    const std::vector<std::string> all = messages_.all();
    return std::ranges::any_of(all, [&](const std::string& m) { return m.find(id) != std::string::npos; });
  }
  Messages messages_;
  std::unique_ptr<Engine> engine_;
};

/// Silence means something: mistakes are heard, of both kinds.
TEST_F(EngineDevices, HearMistakes) {
  VkBufferCreateInfo nothing{};
  nothing.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  nothing.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  if (engine_->vk.vkCreateBuffer(engine_->device, &nothing, nullptr, &buffer) == VK_SUCCESS)
    engine_->vk.vkDestroyBuffer(engine_->device, buffer, nullptr);
  EXPECT_TRUE(heard("VUID-VkBufferCreateInfo-size-00912"));
  messages_.clear();

  const auto from = engine_->buffer(64), to = engine_->buffer(64);
  const VkCommandBuffer commands = engine_->begin();
  const VkBufferCopy region{0, 0, 64};
  for (int i = 0; i < 2; ++i)
    engine_->vk.vkCmdCopyBuffer(commands, from->handle, to->handle, 1, &region);  // the second one does not wait
  EXPECT_TRUE(heard("SYNC-HAZARD-WRITE-AFTER-WRITE"));
  messages_.clear();
  engine_->run(commands);

  // Of a call that the library makes: commands that nobody began.
  const PatternTable<float> table = made_table({}, 1);
  const GpuEvaluator evaluator(table, GpuDevice(engine_->lent()));
  GpuEvaluation e;
  e.points = from->address, e.quantities[0] = to->address;
  evaluator.prepare(e);
  const VkCommandBuffer ended = engine_->begin();
  succeed(engine_->vk.vkEndCommandBuffer(ended), "end");
  evaluator.record(ended, e);
  EXPECT_TRUE(heard("-commandBuffer-recording"));
  messages_.clear();
}

/// Everything that can be recorded, one after the other in one submission, for tables with every combination of parts.
TEST_F(EngineDevices, RecordTablesIntoTheirCommands) {
  const GpuDevice device(engine_->lent());
  EXPECT_EQ(device.info().api, GpuApi::vulkan);
  int halves = 0;
  size_t frames = 0, divisions = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    MadeTable parts;
    parts.quantities = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 3 : 6;
    parts.first = (seed & 1) != 0, parts.rest = (seed & 2) != 0, parts.copies = (seed & 4) != 0;
    parts.placed = (seed & 8) != 0;
    const PatternTable<float> table = made_table(parts, seed);
    const auto controls = size_t(table.num_control_points()), made = size_t(table.num_points());
    const auto quantities = size_t(table.quantities());
    const PatternEvaluator<float> on_host(table);
    const GpuEvaluator evaluator(table, device);
    const std::vector<float> points = random_numbers(controls * 3, seed), columns = random_numbers(controls * 4, seed),
                             values = random_numbers(quantities * made * 3, seed + 1);

    // Results of an evaluation are what the next one does not read, but what the last one, a transpose, does.
    const auto in = engine_->buffer_of(points), in_columns = engine_->buffer_of(columns),
               in_values = engine_->buffer_of(values);
    std::vector<std::unique_ptr<Engine::Buffer>> out, scratch;
    for (size_t q = 0; q < quantities; ++q) out.push_back(engine_->buffer(std::int64_t(made * 12)));
    const auto normals = engine_->buffer(std::int64_t(made * 12)), short_out = engine_->buffer(std::int64_t(made * 6)),
               divided = engine_->buffer(std::int64_t(made * 12)),
               gradient = engine_->buffer(std::int64_t(controls * 12));
    const VkCommandBuffer commands = engine_->begin();
    const auto record = [&](auto asked) {
      scratch.push_back(engine_->buffer(evaluator.num_scratch_bytes(asked)));
      asked.scratch = scratch.back()->address;
      evaluator.prepare(asked);
      evaluator.record(commands, asked);
      engine_->barrier(commands);
    };
    GpuEvaluation e;
    e.points = in->address;
    for (size_t q = 0; q < quantities; ++q) e.quantities[q] = out[q]->address;
    if (quantities > 1) e.normals = normals->address;
    record(e);
    GpuEvaluation half;
    half.points = in->address, half.quantities[0] = short_out->address, half.halves = true;
    if (engine_->halves) record(half);
    GpuEvaluation rational;
    rational.points = in_columns->address, rational.channels = 4, rational.rational = true;
    rational.quantities[0] = divided->address;
    rational.least_weight = 4 * float(float_rounding);
    record(rational);
    GpuTranspose t;
    t.values = in_values->address, t.quantities = int(quantities), t.result = gradient->address;
    record(t);
    engine_->run(commands);

    const std::vector<double> terms = sums_of_terms(table, points, 3);
    std::vector<float> right(quantities * made * 3), found;
    table.apply(points, 3, right);
    for (const auto& quantity : out) std::ranges::copy(quantity->numbers<float>(), std::back_inserter(found));
    expect_near_terms(found, right, terms);
    if (engine_->halves) {
      const auto rounded = short_out->numbers<std::uint16_t>();
      for (size_t i = 0; i < rounded.size(); ++i)
        ASSERT_NEAR(half_value(rounded[i]), found[i], 0x1p-11 * std::abs(found[i]) + 0x1p-24 + 2 * float_rounding);
      ++halves;
    }
    if (quantities > 1) {
      std::vector<float> unit(made * 3);
      Evaluation<float> host;
      host.points = points, host.normals = unit;
      on_host.apply(host);
      frames += expect_near_normals(normals->numbers<float>(), unit, std::span(right).subspan(made * 3, made * 6),
                                    std::span(terms).subspan(made * 3, made * 6));
    }
    std::vector<float> quotients(made * 3), all_columns(quantities * made * 4);
    Evaluation<float> host;
    host.channels = 4, host.rational = true, host.points = columns, host.quantities[0] = quotients;
    host.least_weight = rational.least_weight;
    on_host.apply(host);
    table.apply(columns, 4, all_columns);
    const std::vector<double> errors =
        roundings_of_quotients(all_columns, sums_of_terms(table, columns, 4), table.quantities(), 4);
    const std::vector<float> of_gpu = divided->numbers<float>();
    for (size_t i = 0; i < of_gpu.size(); ++i) {
      divisions += errors[i] < 1e-3;
      ASSERT_LE(std::abs(double(of_gpu[i]) - double(quotients[i])), errors[i]) << "number " << i;
    }
    std::vector<float> transposed(controls * 3);
    on_host.apply_transpose(values, 3, transposed);
    const std::vector<float> own = gradient->numbers<float>();
    expect_near_terms(own, transposed, sums_of_transposed_terms(table, values, 3), roundings_of_another_order);
  }
  EXPECT_EQ(halves, engine_->halves ? 24 : 0);
  EXPECT_GT(frames, 1000u);
  EXPECT_GT(divisions, 10'000u);
}

/// The library's own submissions, on the queue of the engine.
TEST_F(EngineDevices, ApplyToTheHostsNumbers) {
  const GpuDevice device(engine_->lent());
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    const PatternTable<float> table = made_table(
        {.quantities = seed % 2 == 0 ? 1 : 6, .first = seed % 3 == 0, .rest = true, .copies = seed % 3 == 1}, seed);
    const GpuEvaluator evaluator(table, device);
    const std::vector<float> points = random_numbers(size_t(table.num_control_points()) * 3, seed);
    std::vector<float> right(size_t(table.quantities() * table.num_points() * 3)), made(right.size());
    std::vector<float> gradient(points.size());
    table.apply(points, 3, right);
    evaluator.apply(points, 3, made);
    expect_near_terms(made, right, sums_of_terms(table, points, 3));
    evaluator.apply_transpose(made, 3, gradient);
    GpuBuffer buffer(device, 1000);
    buffer.write(std::as_bytes(std::span(points).first(100)), 8);
  }
}

TEST_F(EngineDevices, AreRefusedWithoutTheirHandles) {
  for (int missing = 0; missing < 4; ++missing) {
    EngineDevice lent = engine_->lent();
    if (missing == 0) lent.instance = nullptr;
    if (missing == 1) lent.physical_device = nullptr;
    if (missing == 2) lent.device = nullptr;
    if (missing == 3) lent.queue = nullptr;
    expect_error<InvalidParameter>([&] { const GpuDevice device(lent); }, {"needs an instance"});
  }
  // A device of which the engine does not say that it has halves.
  EngineDevice lent = engine_->lent();
  lent.halves = false;
  const PatternTable<float> table = made_table({}, 1);
  const GpuEvaluator evaluator(table, GpuDevice(lent));
  GpuEvaluation e;
  e.points = 4, e.quantities[0] = 4, e.halves = true;
  expect_error<InvalidParameter>([&] { evaluator.prepare(e); }, {"half floats", "take floats"});
}

/// The same of a device that the library opens: this program again, all of the evaluator's tests, with the layer put
/// under it from outside.
TEST(OwnDevices, AreSilentUnderValidation) {
  SUBLIMIT_NEEDS_PROGRAM(Engine::layer_is_there(), "vulkan-validationlayers, Vulkan's validation layer");
  const TemporaryDirectory directory;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string(), out = directory / "out";
  const auto run = [&](const std::string& filter) {
    const std::string command =
        std::string("VK_INSTANCE_LAYERS=") + Engine::layer +
        " VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT VK_LOADER_DEBUG=layer '" +
        program + "' --gtest_filter='" + filter + "' > '" + out + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return read_file(out);
  };
  const std::string said = run("GpuEvaluator.*");
  EXPECT_NE(said.find(" PASSED "), std::string::npos);
  EXPECT_NE(said.find(Engine::layer), std::string::npos) << "the layer was not there";
  for (const char* word : {"VUID-", "SYNC-", "UNASSIGNED-"}) {
    const size_t at = said.find(word);
    EXPECT_EQ(at, std::string::npos) << said.substr(at, 1000);
  }
  // That it would have been heard.
  EXPECT_NE(run("Mistakes.AreMadeWhereTheLayerListens").find("VUID-VkBufferCreateInfo-size-00912"), std::string::npos);
}

/// For the test above; by itself, without a layer, it is a call that makes nothing.
TEST(Mistakes, AreMadeWhereTheLayerListens) {
  if (!std::getenv("VK_INSTANCE_LAYERS")) return;
  const Engine engine;
  VkBufferCreateInfo nothing{};
  nothing.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  nothing.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  if (engine.vk.vkCreateBuffer(engine.device, &nothing, nullptr, &buffer) == VK_SUCCESS)
    engine.vk.vkDestroyBuffer(engine.device, buffer, nullptr);
}

}  // namespace
}  // namespace sublimit::testing
