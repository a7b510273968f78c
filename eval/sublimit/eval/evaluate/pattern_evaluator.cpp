// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/evaluate/pattern_evaluator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sublimit/base/detail/buffer_pool.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/detail/evaluation_layouts.h"
#include "sublimit/eval/evaluate/detail/packed_blocks.h"
#include "sublimit/eval/evaluate/detail/pattern_transpose.h"
#include "sublimit/eval/kernels/apply_patches.h"
#include "sublimit/eval/kernels/apply_rows.h"
#include "sublimit/eval/kernels/project_points.h"

namespace sublimit {
namespace {

// Some tens of microseconds each.
constexpr std::int64_t patches_per_block = 256, rows_per_block = 2048;
// Of rational ones, whose columns are to be in a near cache until they are divided.
constexpr std::int64_t rational_points_at_once = 256;

/// t, b, n as `kernels::apply_frames` makes them, of one point.
template <class Real>
struct TangentFrame {
  Real t[3], b[3], n[3];
  TangentFrame(const Real* along_u, const Real* along_v) {
    Real v[3];
    set_unit(along_u, t);
    set_unit(along_v, v);
    cross(t, v, b);
    set_unit(b, n);
    if (!(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 0)) std::fill_n(t, 3, Real(0)), std::fill_n(n, 3, Real(0));
    cross(n, t, b);
  }

 private:
  static void cross(const Real* a, const Real* b, Real* n) {
    for (int c = 0; c < 3; ++c) {
      const int i = (c + 1) % 3, j = (c + 2) % 3;
      n[c] = a[i] * b[j] - a[j] * b[i];
    }
  }
  static void set_unit(const Real* a, Real* unit) {
    const Real largest = std::max(std::max(std::abs(a[0]), std::abs(a[1])), std::abs(a[2])),
               scale = largest > 0 ? largest : Real(1);
    for (int c = 0; c < 3; ++c) unit[c] = a[c] / scale;
    const Real square = unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2],
               length = std::sqrt(square > 0 ? square : Real(1));
    for (int c = 0; c < 3; ++c) unit[c] /= length;
  }
};

template <class Real>
kernels::Rows<Real> rows_of(const StencilTable<Real>& table, std::int64_t begin, std::int64_t end) {
  kernels::Rows<Real> rows;
  rows.offsets = table.offsets().data() + begin;
  rows.columns = table.columns().data();
  rows.weights = table.weights().data();
  rows.num_rows = end - begin;
  rows.num_points = table.num_control_points();
  return rows;
}

/// Planes of homogeneous columns, before they are divided.
template <class Real>
struct Columns {
  std::int64_t plane = 0;  ///< with what registers read beyond the last point
  typename BufferPool<Real>::Lease buffer;

  Columns(BufferPool<Real>& pool, int quantities, int channels, std::int64_t points)
      : plane(points + 64 / std::int64_t(sizeof(Real))), buffer(pool.take(size_t(quantities * channels * plane))) {}
  Real* quantity(int q, int channels) const { return buffer.span().data() + q * channels * plane; }
};

/// To where point number `at` of a frame goes, and those after it.
template <class Real>
kernels::Projection<Real> projection(const Evaluation<Real>& e, const Layout& results, int frame, std::int64_t at) {
  kernels::Projection<Real> p;
  p.channels = e.result_channels();
  p.least_weight = e.least_weight;
  p.out = results.strides;
  const auto result = [&](std::span<Real> all) {
    return all.empty() ? nullptr : all.data() + frame * results.frame + at * results.strides.point;
  };
  for (int q = 0; q < 6; ++q) p.results[q] = result(e.quantities[size_t(q)]);
  p.frames = {result(e.tangents), result(e.bitangents), result(e.normals)};
  return p;
}

}  // namespace

template <class Real>
Real noise_of_weights(const Evaluation<Real>& e, std::int64_t num_points) {
  const Layout given = resolved_layout("points", e.point_layout, num_points, e.channels, e.frames);
  if (e.frames == 0) return 0;
  check_evaluation_length("points", std::int64_t(e.points.size()), given.length);
  Real largest = 0;
  for (int frame = 0; frame < e.frames; ++frame)
    for (std::int64_t i = 0; i < num_points; ++i)
      largest = std::max(largest, std::abs(e.points[size_t(frame * given.frame + i * given.strides.point +
                                                           (e.channels - 1) * given.strides.channel)]));
  return 4 * std::numeric_limits<Real>::epsilon() * largest;
}

template <class Real>
struct PatternEvaluator<Real>::Layouts : EvaluationLayouts {};

template <class Real>
PatternEvaluator<Real>::PatternEvaluator(const PatternTable<Real>& table, Options options)
    : table_(table),
      options_(options),
      packed_(std::make_unique<PackedBlocks<Real>>(table)),
      transpose_(std::make_unique<PatternTranspose<Real>>(table)),
      buffers_(std::make_unique<BufferPool<Real>>()) {}

template <class Real>
PatternEvaluator<Real>::~PatternEvaluator() = default;
template <class Real>
PatternEvaluator<Real>::PatternEvaluator(PatternEvaluator&&) noexcept = default;

template <class Real>
std::int64_t PatternEvaluator<Real>::num_bytes() const {
  return packed_->num_bytes();
}

template <class Real>
auto PatternEvaluator<Real>::check(const Evaluation<Real>& e) const -> Layouts {
  return {checked_layouts(table_, e)};
}

template <class Real>
std::int64_t PatternEvaluator<Real>::num_inputs(const Evaluation<Real>& e) const {
  check(e);
  return table_.arrays().first ? table_.arrays().first->num_rows() * e.channels * e.frames : 0;
}

template <class Real>
void PatternEvaluator<Real>::apply_first(const Evaluation<Real>& e, const Layouts& layouts,
                                         std::span<Real> inputs) const {
  const auto& first = table_.arrays().first;
  if (!first) return;
  const std::int64_t blocks = num_blocks(first->num_rows(), rows_per_block);
  parallel_for_blocks(
      blocks * e.frames,
      [&](std::int64_t task, std::int64_t, std::int64_t) {
        const std::int64_t frame = task / blocks, begin = task % blocks * rows_per_block;
        auto rows = rows_of(*first, begin, std::min(first->num_rows(), begin + rows_per_block));
        rows.points = e.points.data() + frame * layouts.given.frame;
        rows.in = layouts.given.strides;
        rows.result = inputs.data() + frame * layouts.inputs.frame + begin * layouts.inputs.strides.point;
        rows.out = layouts.inputs.strides;
        rows.channels = e.channels;
        kernels::apply_rows(rows, !options_.reproducible);
      },
      1);
}

template <class Real>
void PatternEvaluator<Real>::apply_run(const Evaluation<Real>& e, const Layouts& layouts, const Real* points, int frame,
                                       size_t g, std::int64_t first, std::int64_t count) const {
  const auto& a = table_.arrays();
  const auto& group = a.groups[g];
  const auto& start = table_.starts()[g];
  const auto packed = packed_->group(g);
  kernels::Patches<Real> patches;
  patches.stride = packed.stride;
  patches.rows = packed.rows;
  patches.columns = a.blocks[group.block].columns;
  patches.num_rows = group.num_rows;
  patches.control_points = a.columns.data() + start.columns + (first - start.patch) * patches.columns;
  patches.count = count;
  patches.points = points;
  patches.in = layouts.inputs.strides;
  patches.out = layouts.results.strides;
  const bool placed = !a.patch_points.empty();
  patches.patch_points = placed ? a.patch_points.data() + first : nullptr;
  patches.channels = e.channels;
  const std::int64_t point = placed ? 0 : table_.first_point(g, first);
  const auto result = [&](std::span<Real> all) {
    return all.empty() ? nullptr : all.data() + frame * layouts.results.frame + point * layouts.results.strides.point;
  };
  const auto of_quantity = [&](int q) {
    kernels::Patches<Real> of = patches;
    of.weights = packed.weights + q * packed.quantity;
    of.result = result(e.quantities[q]);
    return of;
  };
  const kernels::TangentFrames<Real> frames{result(e.tangents), result(e.bitangents), result(e.normals)};
  const bool framed = frames.tangents || frames.bitangents || frames.normals;
  for (int q = 0; q < a.quantities; ++q)
    if (!e.quantities[q].empty() && !(framed && (q == 1 || q == 2)))
      kernels::apply_patches(of_quantity(q), !options_.reproducible);
  if (framed) kernels::apply_frames(of_quantity(1), of_quantity(2), frames, !options_.reproducible);
}

template <class Real>
void PatternEvaluator<Real>::apply_rational_run(const Evaluation<Real>& e, const Layouts& layouts, const Real* points,
                                                int frame, size_t g, std::int64_t first, std::int64_t count) const {
  const auto& a = table_.arrays();
  const auto& group = a.groups[g];
  const auto packed = packed_->group(g);
  if (group.num_rows == 0) return;
  const int needed = num_needed(shape_of(e).wanted);
  const std::int64_t at_once = std::clamp<std::int64_t>(rational_points_at_once / group.num_rows, 1, count);
  const Columns<Real> columns(*buffers_, needed, e.channels, at_once * group.num_rows);
  for (const std::int64_t end = first + count; first < end; first += at_once) {
    kernels::Patches<Real> patches;
    patches.stride = packed.stride;
    patches.rows = packed.rows;
    patches.columns = a.blocks[group.block].columns;
    patches.num_rows = group.num_rows;
    patches.control_points =
        a.columns.data() + table_.starts()[g].columns + (first - table_.starts()[g].patch) * patches.columns;
    patches.count = std::min(at_once, end - first);
    patches.points = points;
    patches.in = layouts.inputs.strides;
    patches.out = {1, columns.plane};
    patches.channels = e.channels;
    for (int q = 0; q < needed; ++q) {
      patches.weights = packed.weights + q * packed.quantity;
      patches.result = columns.quantity(q, e.channels);
      kernels::apply_patches(patches, !options_.reproducible);
    }
    const bool apart = !a.patch_points.empty();
    for (std::int64_t i = 0; i < (apart ? patches.count : 1); ++i) {
      auto p = projection(e, layouts.results, frame, table_.first_point(g, first + i));
      p.values = columns.quantity(0, e.channels) + i * group.num_rows;
      p.plane = columns.plane;
      p.count = group.num_rows * (apart ? 1 : patches.count);
      kernels::project_points(p, !options_.reproducible);
    }
  }
}

template <class Real>
void PatternEvaluator<Real>::apply_patches(const Evaluation<Real>& e, const Layouts& layouts,
                                           std::span<const Real> inputs, std::int64_t begin, std::int64_t end) const {
  const std::span<const Real> points = table_.arrays().first ? inputs : e.points;
  const std::int64_t blocks = num_blocks(end - begin, patches_per_block);
  parallel_for_blocks(
      blocks * e.frames,
      [&](std::int64_t task, std::int64_t, std::int64_t) {
        const std::int64_t frame = task / blocks, first = begin + task % blocks * patches_per_block;
        table_.for_each_run(first, std::min(end, first + patches_per_block),
                            [&](size_t g, std::int64_t patch, std::int64_t count) {
                              const Real* const own = points.data() + frame * layouts.inputs.frame;
                              if (e.rational)
                                apply_rational_run(e, layouts, own, static_cast<int>(frame), g, patch, count);
                              else
                                apply_run(e, layouts, own, static_cast<int>(frame), g, patch, count);
                            });
      },
      1);
}

/// Of the points of no patch with numbers [begin, end) among these.
template <class Real>
void PatternEvaluator<Real>::apply_frames_of_rest(const Evaluation<Real>& e, const Layouts& layouts, const Real* points,
                                                  int frame, std::int64_t begin, std::int64_t end) const {
  const StencilTable<Real>& rest = *table_.arrays().rest;
  const std::int64_t count = rest.num_rows() / table_.quantities(), before = table_.num_points() - count;
  const auto [point_stride, channel_stride] = layouts.results.strides;
  for (std::int64_t i = begin; i < end; ++i) {
    Real derivatives[2][3];
    for (int q = 1; q < 3; ++q) {
      auto rows = rows_of(rest, q * count + i, q * count + i + 1);
      rows.points = points;
      rows.in = layouts.inputs.strides;
      rows.result = derivatives[q - 1];
      kernels::apply_rows(rows, !options_.reproducible);
    }
    const TangentFrame<Real> made(derivatives[0], derivatives[1]);
    const auto put = [&, at = frame * layouts.results.frame + (before + i) * point_stride, step = channel_stride](
                         std::span<Real> all, const Real* unit) {
      for (int c = 0; c < 3 && !all.empty(); ++c) all[size_t(at + c * step)] = unit[c];
    };
    put(e.tangents, made.t), put(e.bitangents, made.b), put(e.normals, made.n);
  }
}

/// Of the points of no patch with numbers [begin, end) among these.
template <class Real>
void PatternEvaluator<Real>::apply_rational_rest(const Evaluation<Real>& e, const Layouts& layouts, const Real* points,
                                                 int frame, std::int64_t begin, std::int64_t end) const {
  const StencilTable<Real>& rest = *table_.arrays().rest;
  const std::int64_t count = rest.num_rows() / table_.quantities(), before = table_.num_points() - count;
  const int needed = num_needed(shape_of(e).wanted);
  const Columns<Real> columns(*buffers_, needed, e.channels, rational_points_at_once);
  for (; begin < end; begin += rational_points_at_once) {
    const std::int64_t last = std::min(end, begin + rational_points_at_once);
    for (int q = 0; q < needed; ++q) {
      auto rows = rows_of(rest, q * count + begin, q * count + last);
      rows.points = points;
      rows.in = layouts.inputs.strides;
      rows.result = columns.quantity(q, e.channels);
      rows.out = {1, columns.plane};
      rows.channels = e.channels;
      kernels::apply_rows(rows, !options_.reproducible);
    }
    auto p = projection(e, layouts.results, frame, before + begin);
    p.values = columns.quantity(0, e.channels);
    p.plane = columns.plane;
    p.count = last - begin;
    kernels::project_points(p, !options_.reproducible);
  }
}

template <class Real>
void PatternEvaluator<Real>::apply_rest(const Evaluation<Real>& e, const Layouts& layouts,
                                        std::span<const Real> inputs) const {
  const auto& a = table_.arrays();
  const bool framed = !e.tangents.empty() || !e.bitangents.empty() || !e.normals.empty();
  if (a.rest) {
    const std::int64_t count = a.rest->num_rows() / a.quantities, before = table_.num_points() - count,
                       blocks = num_blocks(count, rows_per_block);
    parallel_for_blocks(
        blocks * e.frames,
        [&](std::int64_t task, std::int64_t, std::int64_t) {
          const std::int64_t frame = task / blocks, begin = task % blocks * rows_per_block,
                             end = std::min(count, begin + rows_per_block);
          const Real* const points = (a.first ? inputs : e.points).data() + frame * layouts.inputs.frame;
          if (e.rational) return apply_rational_rest(e, layouts, points, static_cast<int>(frame), begin, end);
          for (int q = 0; q < a.quantities; ++q) {
            if (e.quantities[q].empty()) continue;
            auto rows = rows_of(*a.rest, q * count + begin, q * count + end);
            rows.points = points;
            rows.in = layouts.inputs.strides;
            rows.result = e.quantities[q].data() + frame * layouts.results.frame +
                          (before + begin) * layouts.results.strides.point;
            rows.out = layouts.results.strides;
            rows.channels = e.channels;
            kernels::apply_rows(rows, !options_.reproducible);
          }
          if (framed) apply_frames_of_rest(e, layouts, points, static_cast<int>(frame), begin, end);
        },
        1);
  }
  if (e.quantities[0].empty()) return;
  const std::int32_t* const pairs = a.copies.data();
  const auto [point, channel] = layouts.results.strides;
  for (int frame = 0; frame < e.frames; ++frame) {
    Real* const positions = e.quantities[0].data() + frame * layouts.results.frame;
    parallel_for(static_cast<std::int64_t>(a.copies.size() / 2), [&, point = point, channel = channel](std::int64_t i) {
      Real* const to = positions + pairs[2 * i] * point;
      const Real* const from = positions + pairs[2 * i + 1] * point;
      for (int c = 0; c < e.result_channels(); ++c) to[c * channel] = from[c * channel];
    });
  }
}

template <class Real>
void PatternEvaluator<Real>::apply_first(const Evaluation<Real>& e, std::span<Real> inputs) const {
  const Layouts layouts = check(e);
  if (table_.arrays().first) check_evaluation_length("inputs", std::int64_t(inputs.size()), layouts.inputs.length);
  apply_first(e, layouts, inputs);
}

template <class Real>
void PatternEvaluator<Real>::apply_patches(const Evaluation<Real>& e, std::span<const Real> inputs, std::int64_t begin,
                                           std::int64_t end) const {
  const Layouts layouts = check(e);
  if (table_.arrays().first) check_evaluation_length("inputs", std::int64_t(inputs.size()), layouts.inputs.length);
  if (begin < 0 || begin > end || end > num_patches())
    fail_evaluation("patches from " + std::to_string(begin) + " up to " + std::to_string(end) + "; there are " +
                    std::to_string(num_patches()));
  apply_patches(e, layouts, inputs, begin, end);
}

template <class Real>
void PatternEvaluator<Real>::apply_rest(const Evaluation<Real>& e, std::span<const Real> inputs) const {
  const Layouts layouts = check(e);
  if (table_.arrays().first) check_evaluation_length("inputs", std::int64_t(inputs.size()), layouts.inputs.length);
  apply_rest(e, layouts, inputs);
}

template <class Real>
void PatternEvaluator<Real>::apply(const Evaluation<Real>& e) const {
  const Layouts layouts = check(e);
  const auto made = buffers_->take(table_.arrays().first ? size_t(layouts.inputs.length) : 0);
  apply_first(e, layouts, made.span());
  apply_patches(e, layouts, made.span(), 0, num_patches());
  apply_rest(e, layouts, made.span());
}

template <class Real>
void PatternEvaluator<Real>::apply(std::span<const Real> points, int channels, std::span<Real> result) const {
  for_each_evaluation<Real>(table_, points, channels, result, [&](const Evaluation<Real>& e) { apply(e); });
}

template <class Real>
void PatternEvaluator<Real>::apply_transpose(std::span<const Real> values, int channels, std::span<Real> result) const {
  transpose_->apply(values, channels, result, !options_.reproducible, *buffers_);
}

template float noise_of_weights(const Evaluation<float>&, std::int64_t);
template double noise_of_weights(const Evaluation<double>&, std::int64_t);
template class PatternEvaluator<float>;
template class PatternEvaluator<double>;

}  // namespace sublimit
