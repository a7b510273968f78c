// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/evaluate/detail/evaluation_layouts.h"

#include <limits>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// a + b * c of numbers that are not negative, or the largest number.
std::int64_t sum_of_product(std::int64_t a, std::int64_t b, std::int64_t c) {
  std::int64_t product = 0, sum = 0;
  if (__builtin_mul_overflow(b, c, &product) || __builtin_add_overflow(a, product, &sum))
    return std::numeric_limits<std::int64_t>::max();
  return sum;
}

}  // namespace

void fail_evaluation(const std::string& what) { throw InvalidParameter("evaluation: " + what); }

void check_evaluation_length(const char* name, std::int64_t numbers, std::int64_t needed) {
  if (numbers < needed)
    fail_evaluation(std::string(name) + " hold " + std::to_string(numbers) + " numbers; " + std::to_string(needed) +
                    " are needed");
}

Layout resolved_layout(const char* name, const PointLayout& layout, std::int64_t points, int channels, int frames) {
  const auto overlap = [&] {
    fail_evaluation(std::string(name) + " overlap with strides of " + std::to_string(layout.point) +
                    " from point to point, " + std::to_string(layout.channel) + " from channel to channel, " +
                    std::to_string(layout.frame) + " from frame to frame; there are " + std::to_string(points) +
                    " points, " + std::to_string(channels) + " channels and " + std::to_string(frames) + " frames");
  };
  if (layout.point < 0 || layout.channel < 1 || layout.frame < 0) overlap();
  Layout result;
  result.strides = {layout.point == 0 ? sum_of_product(0, channels, layout.channel) : layout.point, layout.channel};
  const auto [point, channel] = result.strides;
  if (points == 0) return result;
  const std::int64_t of_point = sum_of_product(1, channels - 1, channel),
                     of_channel = sum_of_product(1, points - 1, point);
  if (point < of_point && channel < of_channel) overlap();
  const std::int64_t of_frame = sum_of_product(of_channel, channels - 1, channel);
  const std::int64_t dense = point < of_point ? sum_of_product(0, channels, channel) : sum_of_product(0, points, point);
  result.frame = layout.frame == 0 ? dense : layout.frame;
  if (frames > 1 && result.frame < of_frame) overlap();
  result.length = sum_of_product(of_frame, frames - 1, result.frame);
  return result;
}

template <class Real>
EvaluationLayouts checked_layouts(const PatternTable<Real>& table, const EvaluationShape& e) {
  const int least_channels = e.rational ? 2 : 1;
  if (e.channels < least_channels || e.channels > most_channels)
    fail_evaluation(std::to_string(e.channels) + (e.rational ? " channels of rational points; " : " channels; ") +
                    std::to_string(least_channels) + " to " + std::to_string(most_channels) + " are right");
  if (!(e.least_weight >= 0)) fail_evaluation("a least weight of " + format_number(e.least_weight));
  if (e.frames < 0) fail_evaluation(std::to_string(e.frames) + " frames");
  EvaluationLayouts layouts;
  layouts.given = resolved_layout("points", e.points, table.num_control_points(), e.channels, e.frames);
  layouts.results = resolved_layout("results", e.results, table.num_points(), e.result_channels(), e.frames);
  const auto& first = table.arrays().first;
  layouts.inputs = first ? resolved_layout("points", {}, first->num_rows(), e.channels, e.frames) : layouts.given;
  if (e.frames == 0) return layouts;
  for (int q = 0; q < 6; ++q)
    if (e.wanted >> q & 1 && q >= table.quantities())
      fail_evaluation(std::string(names_of_wanted[q]) + " of a table with " + std::to_string(table.quantities()) +
                      " quantities");
  if (!(e.wanted & wanted_frames)) return layouts;
  if (table.quantities() < 3) fail_evaluation("tangent frames of a table without derivatives");
  if (e.result_channels() != 3)
    fail_evaluation("tangent frames of " + std::to_string(e.result_channels()) + " channels; they need 3");
  return layouts;
}

template <class Real>
EvaluationShape shape_of(const Evaluation<Real>& e) {
  EvaluationShape shape{e.channels, e.frames, e.point_layout, e.result_layout, e.rational, double(e.least_weight), 0};
  for (size_t q = 0; q < e.quantities.size(); ++q)
    if (!e.quantities[q].empty()) shape.wanted |= static_cast<Wanted>(1u << q);
  const std::span<const Real> frames[] = {e.tangents, e.bitangents, e.normals};
  for (size_t i = 0; i < 3; ++i)
    if (!frames[i].empty()) shape.wanted |= static_cast<Wanted>(64u << i);
  return shape;
}

template <class Real>
EvaluationLayouts checked_layouts(const PatternTable<Real>& table, const Evaluation<Real>& e) {
  const EvaluationLayouts layouts = checked_layouts(table, shape_of(e));
  if (e.frames == 0) return layouts;
  check_evaluation_length("points", std::int64_t(e.points.size()), layouts.given.length);
  const auto check_result = [&](const char* name, std::span<const Real> numbers) {
    if (!numbers.empty()) check_evaluation_length(name, std::int64_t(numbers.size()), layouts.results.length);
  };
  for (size_t q = 0; q < e.quantities.size(); ++q) check_result(names_of_wanted[q], e.quantities[q]);
  check_result("tangents", e.tangents);
  check_result("bitangents", e.bitangents);
  check_result("normals", e.normals);
  return layouts;
}

template <class Real>
int checked_quantities(const PatternTable<Real>& table, std::span<const Real> values, int channels,
                       std::span<const Real> result) {
  const auto fail = [](const std::string& what) { throw InvalidParameter("transposed pattern table: " + what); };
  if (channels < 1) fail(std::to_string(channels) + " channels; at least one is right");
  const size_t quantity = size_t(table.num_points()) * size_t(channels),
               quantities = quantity == 0 ? 1 : values.size() / quantity;
  if (values.size() != quantity * quantities || quantities < 1 || quantities > size_t(table.quantities()))
    fail("values hold " + std::to_string(values.size()) + " numbers; " + std::to_string(table.num_points()) + " x " +
         std::to_string(channels) + " channels are needed for each of up to " + std::to_string(table.quantities()) +
         " quantities");
  if (result.size() != size_t(table.num_control_points()) * size_t(channels))
    fail("result holds " + std::to_string(result.size()) + " numbers; " + std::to_string(table.num_control_points()) +
         " x " + std::to_string(channels) + " channels are needed");
  return static_cast<int>(quantities);
}

template EvaluationShape shape_of(const Evaluation<float>&);
template EvaluationShape shape_of(const Evaluation<double>&);
template EvaluationLayouts checked_layouts(const PatternTable<float>&, const Evaluation<float>&);
template EvaluationLayouts checked_layouts(const PatternTable<double>&, const Evaluation<double>&);
template int checked_quantities(const PatternTable<float>&, std::span<const float>, int, std::span<const float>);
template int checked_quantities(const PatternTable<double>&, std::span<const double>, int, std::span<const double>);
template EvaluationLayouts checked_layouts(const PatternTable<float>&, const EvaluationShape&);
template EvaluationLayouts checked_layouts(const PatternTable<double>&, const EvaluationShape&);

}  // namespace sublimit
