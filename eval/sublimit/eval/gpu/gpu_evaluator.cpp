// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/gpu_evaluator.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/detail/evaluation_layouts.h"
#include "sublimit/eval/gpu/detail/driver.h"
#include "sublimit/eval/gpu/detail/memory_pool.h"
#include "sublimit/eval/gpu/detail/packed_table.h"
#include "sublimit/eval/gpu/detail/packed_transpose.h"

namespace sublimit {
namespace {

using gpu::Arguments;
using gpu::Kernel;
using gpu::Launch;
using gpu::Part;
using gpu::uint;
using gpu::Variant;

constexpr int channels_at_once = 4;
/// Points, or results, of frames that are on the device at once, for `apply`.
constexpr std::int64_t bytes_at_once = std::int64_t{1} << 30;

/// Where the wanted results of an evaluation are, in the order of `Wanted`.
std::array<std::uint64_t, 9> results_of(const GpuEvaluation& e) {
  std::array<std::uint64_t, 9> results{};
  std::ranges::copy(e.quantities, results.begin());
  results[6] = e.tangents, results[7] = e.bitangents, results[8] = e.normals;
  return results;
}

EvaluationShape shape_of(const GpuEvaluation& e) {
  EvaluationShape shape{e.channels, e.frames, e.point_layout, e.result_layout, e.rational, double(e.least_weight), 0};
  const auto results = results_of(e);
  for (size_t i = 0; i < results.size(); ++i)
    if (results[i] != 0) shape.wanted |= static_cast<Wanted>(1u << i);
  return shape;
}

/// Kernels multiply strides by 4 in 32 bits.
uint stride(std::int64_t numbers) {
  constexpr std::int64_t most = (std::int64_t{1} << 30) - 1;
  if (numbers > most)
    throw ResourceError("strides of " + std::to_string(numbers) + " numbers; a GPU takes up to " +
                        std::to_string(most));
  return static_cast<uint>(numbers);
}

/// Of points that are read: one frame is counted in 31 bits.
void check_frame(const Layout& layout, std::int64_t points, int channels) {
  const std::int64_t last = (points - 1) * layout.strides.point + (channels - 1) * layout.strides.channel;
  if (last > std::numeric_limits<std::int32_t>::max())
    throw ResourceError("a frame of points of " + std::to_string(last) + " numbers; a GPU takes up to 2147483647");
}

/// Calls body(first, count) for all channels, some at a time.
template <class Body>
void for_each_part(int channels, int at_once, const Body& body) {
  for (int first = 0; first < channels; first += at_once) body(first, std::min(at_once, channels - first));
}

std::int64_t workgroups(std::int64_t threads) { return (threads + gpu::threads - 1) / gpu::threads; }

/// Numbers of a frame lie together.
bool is_dense(const Layout& layout, int channels) {
  return layout.strides.channel == 1 && layout.strides.point == channels;
}

}  // namespace

struct GpuEvaluator::Uploaded {
  const PatternTable<float>& table;
  std::shared_ptr<gpu::Driver> driver;
  std::array<std::array<Part, 2>, 3> patches;
  Part first, rest, copies;
  std::unique_ptr<gpu::Memory> memory;

  struct Transpose {
    Part fold, patches, inputs, first;
    std::int64_t num_parts = 0;
    std::unique_ptr<gpu::Memory> memory;
  };
  ComputedOnce<Transpose> made_transpose;

  gpu::MemoryPool pool;  // of `apply`

  Uploaded(const PatternTable<float>& t, std::shared_ptr<gpu::Driver> d)
      : table(t), driver(std::move(d)), pool(*driver) {
    gpu::PackedTable packed(t);
    patches = packed.patches;
    first = packed.first, rest = packed.rest, copies = packed.copies;
    memory = upload(packed.image);
  }

  std::unique_ptr<gpu::Memory> upload(gpu::Image& image) const {
    auto uploaded = driver->allocate(image.num_bytes());
    uploaded->write(0, image.at(uploaded->address()));
    return uploaded;
  }

  const Transpose& transpose() {
    return made_transpose.get([&] {
      gpu::PackedTranspose packed(table);
      return Transpose{packed.fold,  packed.patches,   packed.inputs,
                       packed.first, packed.num_parts, upload(packed.image)};
    });
  }

  std::uint64_t address(const Part& part) const { return memory->address() + std::uint64_t(part.table); }

  EvaluationLayouts check(const GpuEvaluation& e) const {
    const EvaluationLayouts layouts = checked_layouts(table, shape_of(e));
    const auto check_address = [&](std::uint64_t address, unsigned multiple, const char* what) {
      if (address % multiple != 0)
        fail_evaluation(std::string(what) + " on the device at an address that is no multiple of " +
                        std::to_string(multiple));
    };
    check_address(e.points, 4, "points");
    for (const std::uint64_t result : results_of(e)) check_address(result, e.halves ? 2 : 4, "results");
    check_address(e.scratch, 4, "scratch");
    if (e.points == 0 && layouts.given.length > 0 && e.frames > 0) fail_evaluation("no points on the device");
    if (e.halves && !driver->info().halves)
      fail_evaluation(driver->info().name + " cannot write half floats (16-bit storage); take floats");
    return layouts;
  }

  std::int64_t scratch_bytes(const GpuEvaluation& e) const {
    return first.count * e.channels * e.frames * std::int64_t(sizeof(float));
  }

  /// Calls launch(Launch) in order; takes no memory.
  template <class Body>
  void for_each_launch(const GpuEvaluation& e, const Body& launch) {
    const EvaluationLayouts layouts = check(e);
    const Wanted wanted = shape_of(e).wanted;
    if (e.frames == 0 || wanted == 0) return;
    if (first.count > 0 && e.scratch == 0) fail_evaluation("a table with a first step needs scratch on the device");
    Arguments common{};
    common.in_point = stride(layouts.given.strides.point), common.in_channel = stride(layouts.given.strides.channel);
    // Of one frame nothing is added.
    const auto frame = [&](const Layout& layout) { return e.frames == 1 ? 0 : stride(layout.frame); };
    common.in_frame = frame(layouts.given);
    check_frame(layouts.given, table.num_control_points(), e.channels);
    check_frame(layouts.inputs, first.count > 0 ? first.count : 1, e.channels);
    common.points = e.points;
    if (first.count > 0) {
      Arguments a = common;
      a.table = address(first);
      a.results[0] = e.scratch;
      a.count = uint(first.count);
      a.out_point = stride(layouts.inputs.strides.point), a.out_channel = 1, a.out_frame = frame(layouts.inputs);
      for_each_part(e.channels, channels_at_once, [&](int begin, int count) {
        a.channels = uint(begin);
        launch({{Kernel::apply_rows, false, 1, count, 1, 1}, a, workgroups(first.count), e.frames, false});
      });
      common.points = e.scratch;
      common.in_point = a.out_point, common.in_channel = 1, common.in_frame = a.out_frame;
    }
    common.out_point = stride(layouts.results.strides.point);
    common.out_channel = stride(layouts.results.strides.channel);
    common.out_frame = frame(layouts.results);
    common.least_weight = e.least_weight;
    std::ranges::copy(results_of(e), common.results);

    bool waits = first.count > 0;
    const auto add = [&](Launch one) {
      one.waits = std::exchange(waits, false);
      launch(one);
    };
    const int quantities = num_needed(wanted);
    const size_t size = quantities == 1 ? 0 : quantities == 3 ? 1 : 2;
    for_each_part(e.channels - e.rational, channels_at_once - e.rational, [&](int begin, int made) {
      Arguments a = common;
      a.channels = uint(begin) | (e.rational ? uint(e.channels - 1) << 8 | 65536u : 0u);
      const int count = made + e.rational;
      for (const bool many : {true, false}) {
        const Part& part = patches[size][many];
        if (part.count == 0) continue;
        a.table = address(part);
        a.count = uint(part.count);
        const gpu::Shape shape = gpu::shape_of(quantities, many);
        add({{Kernel::apply_patches, e.halves, quantities, count, shape.rows, shape.patches}, a, part.count, e.frames});
      }
      if (rest.count > 0) {
        a.table = address(rest);
        a.count = uint(rest.count);
        add({{Kernel::apply_rows, e.halves, quantities, count, 1, 1}, a, workgroups(rest.count), e.frames});
      }
    });
    if (copies.count > 0 && e.quantities[0] != 0) {
      Arguments a = common;
      a.table = address(copies);
      a.count = uint(copies.count);
      a.channels = uint(e.channels - e.rational);
      waits = true;
      add({{Kernel::copy_points, e.halves, 1, 1, 1, 1}, a, workgroups(copies.count), e.frames});
    }
  }

  /// Values of positions, parts and inputs of a transpose, one after the other.
  struct Scratch {
    std::int64_t moved = 0, parts = 0, inputs = 0, end = 0;
  };
  Scratch scratch_of(const GpuTranspose& t) {
    const Transpose& packed = transpose();
    const std::int64_t bytes = t.channels * std::int64_t(sizeof(float));
    Scratch s;
    s.parts = s.moved + (packed.fold.count > 0 ? table.num_points() * bytes : 0);
    s.inputs = s.parts + packed.num_parts * bytes;
    s.end = s.inputs + (packed.first.table >= 0 ? packed.inputs.count * bytes : 0);
    return s;
  }

  void check_shape(const GpuTranspose& t) const {
    if (t.channels < 1) fail_evaluation(std::to_string(t.channels) + " channels; at least one is right");
    if (t.quantities < 1 || t.quantities > table.quantities())
      fail_evaluation("values of " + std::to_string(t.quantities) + " quantities of a table with " +
                      std::to_string(table.quantities()));
  }
  void check(const GpuTranspose& t) const {
    check_shape(t);
    for (const std::uint64_t address : {t.values, t.result, t.scratch})
      if (address % 4 != 0) fail_evaluation("numbers on the device at an address that is no multiple of 4");
    if ((t.values == 0 && table.num_points() > 0) || (t.result == 0 && table.num_control_points() > 0))
      fail_evaluation("no values or no result of a transpose on the device");
  }

  template <class Body>
  void for_each_launch(const GpuTranspose& t, const Body& launch) {
    check(t);
    const Transpose& packed = transpose();
    const Scratch scratch = scratch_of(t);
    if (scratch.end > 0 && t.scratch == 0) fail_evaluation("a transpose needs scratch on the device");
    Arguments a{};
    a.in_point = stride(t.channels);
    a.quantities = uint(t.quantities);
    a.out_frame = uint(table.num_points());
    a.results[0] = t.values, a.results[1] = t.values;
    a.results[2] = t.scratch + std::uint64_t(scratch.parts);
    const auto address = [&](const Part& part) { return packed.memory->address() + std::uint64_t(part.table); };
    bool waits = false;
    if (packed.fold.count > 0) {
      a.table = address(packed.fold);
      a.count = uint(packed.fold.count);
      a.results[0] = t.scratch + std::uint64_t(scratch.moved);
      launch({{Kernel::fold_copies, false, 1, 1, 1, 1}, a, workgroups(packed.fold.count), 1, false});
      waits = true;
    }
    const auto add = [&](Kernel kernel, const Part& part, std::int64_t groups) {
      a.table = address(part);
      a.count = uint(part.count);
      for_each_part(t.channels, channels_at_once, [&](int begin, int count) {
        a.channels = uint(begin);
        launch({{kernel, false, 1, count, 1, 1}, a, groups, 1, std::exchange(waits, false)});
      });
      waits = true;
    };
    if (packed.patches.count > 0) add(Kernel::transpose_patches, packed.patches, packed.patches.count);
    const bool has_first = packed.first.table >= 0;
    a.results[3] = has_first ? t.scratch + std::uint64_t(scratch.inputs) : t.result;
    if (packed.inputs.count > 0) add(Kernel::gather_parts, packed.inputs, workgroups(packed.inputs.count));
    if (has_first && packed.first.count > 0) {
      a.results[0] = a.results[1] = a.results[3];
      a.results[3] = t.result;
      a.quantities = 1;
      a.out_frame = uint(packed.inputs.count);
      add(Kernel::gather_parts, packed.first, workgroups(packed.first.count));
    }
  }

  void check_api(GpuApi api) const {
    if (driver->info().api != api)
      throw InvalidParameter(std::string("commands of ") + name(api) + " for a device of " + name(driver->info().api));
  }
  template <class Asked>
  void prepare(const Asked& asked) {
    for_each_launch(asked, [&](const Launch& launch) { driver->prepare(launch.variant); });
  }
  template <class Asked>
  void record(void* commands, const Asked& asked) {
    for_each_launch(asked, [&](const Launch& launch) { driver->record(commands, launch); });
  }
  template <class Asked>
  void run(const Asked& asked) {
    prepare(asked);
    const auto recording = driver->begin();
    record(recording->handle(), asked);
    recording->submit_and_wait();
  }
};

GpuEvaluator::GpuEvaluator(const PatternTable<float>& table, const GpuDevice& device)
    : uploaded_(std::make_unique<Uploaded>(table, device.driver())) {}
GpuEvaluator::~GpuEvaluator() = default;
GpuEvaluator::GpuEvaluator(GpuEvaluator&&) noexcept = default;

const PatternTable<float>& GpuEvaluator::table() const { return uploaded_->table; }
std::int64_t GpuEvaluator::num_bytes() const { return uploaded_->memory->num_bytes(); }

void GpuEvaluator::prepare(const GpuEvaluation& e) const { uploaded_->prepare(e); }
std::int64_t GpuEvaluator::num_scratch_bytes(const GpuEvaluation& e) const { return uploaded_->scratch_bytes(e); }
void GpuEvaluator::record(VkCommandBuffer_T* commands, const GpuEvaluation& e) const {
  uploaded_->check_api(GpuApi::vulkan);
  uploaded_->record(commands, e);
}
void GpuEvaluator::record(CUstream_st* stream, const GpuEvaluation& e) const {
  uploaded_->check_api(GpuApi::cuda);
  uploaded_->record(stream, e);
}
void GpuEvaluator::record(const GpuCommands& commands, const GpuEvaluation& e) const {
  uploaded_->record(commands.recording().independent(), e);
}
void GpuEvaluator::prepare(const GpuTranspose& t) const { uploaded_->prepare(t); }
std::int64_t GpuEvaluator::num_scratch_bytes(const GpuTranspose& t) const {
  uploaded_->check_shape(t);
  return uploaded_->scratch_of(t).end;
}
void GpuEvaluator::record(VkCommandBuffer_T* commands, const GpuTranspose& t) const {
  uploaded_->check_api(GpuApi::vulkan);
  uploaded_->record(commands, t);
}
void GpuEvaluator::record(CUstream_st* stream, const GpuTranspose& t) const {
  uploaded_->check_api(GpuApi::cuda);
  uploaded_->record(stream, t);
}
void GpuEvaluator::record(const GpuCommands& commands, const GpuTranspose& t) const {
  uploaded_->record(commands.recording().independent(), t);
}

void GpuEvaluator::apply(const Evaluation<float>& e) const {
  const EvaluationLayouts layouts = checked_layouts(table(), e);
  const Wanted wanted = sublimit::shape_of(e).wanted;
  if (e.frames == 0 || wanted == 0 || table().num_points() == 0) return;
  std::vector<std::span<float>> spans(e.quantities.begin(), e.quantities.end());
  spans.insert(spans.end(), {e.tangents, e.bitangents, e.normals});

  // Results are dense on the device, whatever lies between them here.
  const std::int64_t of_frame = table().num_points() * e.result_channels(), num_wanted = std::popcount(wanted);
  const std::int64_t most_numbers =
      std::max({of_frame * num_wanted, layouts.given.frame, uploaded_->first.count * e.channels, std::int64_t{1}});
  const auto at_once = static_cast<int>(
      std::clamp<std::int64_t>(bytes_at_once / (most_numbers * std::int64_t(sizeof(float))), 1, e.frames));
  GpuEvaluation on_device;
  on_device.channels = e.channels;
  on_device.point_layout = e.point_layout;
  on_device.rational = e.rational, on_device.least_weight = e.least_weight;
  std::int64_t given = layouts.given.length - (e.frames - at_once) * layouts.given.frame;
  on_device.frames = at_once;
  const gpu::MemoryPool::Lease points(uploaded_->pool, given * std::int64_t(sizeof(float))),
      results(uploaded_->pool, of_frame * num_wanted * at_once * std::int64_t(sizeof(float))),
      scratch(uploaded_->pool, num_scratch_bytes(on_device));
  on_device.points = points->address(), on_device.scratch = scratch->address();
  std::vector<float> sparse;
  for (int frame = 0; frame < e.frames; frame += at_once) {
    const int frames = on_device.frames = std::min(at_once, e.frames - frame);
    given = layouts.given.length - (e.frames - frames) * layouts.given.frame;
    points->write(0, std::as_bytes(e.points.subspan(size_t(frame * layouts.given.frame), size_t(given))));
    std::array<std::int64_t, 9> begin{};
    std::int64_t end = 0;
    for (size_t i = 0; i < 9; ++i) {
      std::uint64_t& address = i < 6    ? on_device.quantities[i]
                               : i == 6 ? on_device.tangents
                               : i == 7 ? on_device.bitangents
                                        : on_device.normals;
      address = 0;
      if (!(wanted >> i & 1)) continue;
      begin[i] = end;
      address = results->address() + std::uint64_t(end);
      end += of_frame * frames * std::int64_t(sizeof(float));
    }
    uploaded_->run(on_device);
    for (size_t i = 0; i < 9; ++i) {
      if (!(wanted >> i & 1)) continue;
      const std::span<float> out = spans[i].subspan(size_t(frame * layouts.results.frame));
      const bool dense = is_dense(layouts.results, e.result_channels());
      if (dense && (frames == 1 || layouts.results.frame == of_frame)) {
        results->read(begin[i], std::as_writable_bytes(out.first(size_t(of_frame * frames))));
        continue;
      }
      for (int f = 0; f < frames; ++f) {
        const std::span<float> of_one = out.subspan(size_t(f * layouts.results.frame));
        if (!dense) sparse.resize(size_t(of_frame));
        const std::span<float> read = dense ? of_one.first(size_t(of_frame)) : std::span(sparse);
        results->read(begin[i] + f * of_frame * std::int64_t(sizeof(float)), std::as_writable_bytes(read));
        if (dense) continue;
        parallel_for(table().num_points(), [&](std::int64_t point) {
          for (int c = 0; c < e.result_channels(); ++c)
            of_one[size_t(point * layouts.results.strides.point + c * layouts.results.strides.channel)] =
                sparse[size_t(point * e.result_channels() + c)];
        });
      }
    }
  }
}

void GpuEvaluator::apply(std::span<const float> points, int channels, std::span<float> result) const {
  for_each_evaluation<float>(table(), points, channels, result, [&](const Evaluation<float>& e) { apply(e); });
}

void GpuEvaluator::apply_transpose(std::span<const float> values, int channels, std::span<float> result) const {
  GpuTranspose t;
  t.channels = channels;
  t.quantities = checked_quantities<float>(table(), values, channels, result);
  if (table().num_points() == 0) return std::fill(result.begin(), result.end(), 0.0f);
  const gpu::MemoryPool::Lease in(uploaded_->pool, std::int64_t(values.size_bytes())),
      out(uploaded_->pool, std::int64_t(result.size_bytes())), scratch(uploaded_->pool, num_scratch_bytes(t));
  t.values = in->address(), t.result = out->address(), t.scratch = scratch->address();
  in->write(0, std::as_bytes(values));
  uploaded_->run(t);
  out->read(0, std::as_writable_bytes(result));
}

}  // namespace sublimit
