// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks of evaluations, and their layouts with all strides resolved.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "sublimit/eval/evaluate/evaluation.h"
#include "sublimit/eval/kernels/apply_patches.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit {

inline constexpr int most_channels = 64;

/// A layout with all strides resolved.
struct Layout {
  kernels::Strides strides;
  std::int64_t frame = 0;
  std::int64_t length = 0;  ///< numbers from the first to the last one
};

/// Layouts of an evaluation.
struct EvaluationLayouts {
  Layout given;   ///< points of the caller
  Layout inputs;  ///< points that patches are applied to
  Layout results;
};

/// Set of wanted results: bits 0 to 5 for quantities, then tangents, bitangents, normals.
using Wanted = std::uint16_t;
inline constexpr Wanted wanted_frames = 7u << 6;
inline constexpr const char* names_of_wanted[] = {"positions",         "derivatives along u", "derivatives along v",
                                                  "derivatives by uu", "derivatives by uv",   "derivatives by vv",
                                                  "tangents",          "bitangents",          "normals"};
/// Returns the number of quantities to compute. Rational derivatives need those of lower order too.
constexpr int num_needed(Wanted wanted) { return wanted & 0b111000 ? 6 : wanted & (wanted_frames | 0b110) ? 3 : 1; }

/// An evaluation without its points and results.
struct EvaluationShape {
  int channels = 3, frames = 1;
  PointLayout points, results;
  bool rational = false;
  double least_weight = 0;
  Wanted wanted = 1;
  int result_channels() const { return channels - (rational ? 1 : 0); }
};

/// @throws InvalidParameter  always
[[noreturn]] void fail_evaluation(const std::string& what);
/// Checks the length of an array.
/// @throws InvalidParameter  fewer numbers than a layout needs
void check_evaluation_length(const char* name, std::int64_t numbers, std::int64_t needed);

/// Returns a layout with zeros replaced by the strides that they stand for.
/// @throws InvalidParameter  strides with which numbers overlap
Layout resolved_layout(const char* name, const PointLayout& layout, std::int64_t points, int channels, int frames);

/// Returns the layouts of an evaluation.
/// @throws InvalidParameter  strides with which numbers overlap, quantities that the table does not have, tangent
///                           frames without derivatives or of other than 3 channels
template <class Real>
EvaluationLayouts checked_layouts(const PatternTable<Real>& table, const EvaluationShape& shape);

/// Returns an evaluation without its points and results.
template <class Real>
EvaluationShape shape_of(const Evaluation<Real>& evaluation);
/// Returns the layouts of an evaluation, and checks its spans.
/// @throws InvalidParameter  spans that are too short; and as above
template <class Real>
EvaluationLayouts checked_layouts(const PatternTable<Real>& table, const Evaluation<Real>& evaluation);

/// Returns the number of quantities that the values of a transpose have.
/// @throws InvalidParameter  spans of the wrong length, channels < 1
template <class Real>
int checked_quantities(const PatternTable<Real>& table, std::span<const Real> values, int channels,
                       std::span<const Real> result);

/// Calls body(evaluation) for interleaved arrays with any number of channels, 64 channels at a time at most.
/// @throws InvalidParameter  spans of the wrong length, channels < 1
template <class Real, class Body>
void for_each_evaluation(const PatternTable<Real>& table, std::span<const Real> points, int channels,
                         std::span<Real> result, const Body& body) {
  table.check(points, channels, result);
  Evaluation<Real> e;
  e.point_layout = e.result_layout = PointLayout::interleaved(channels);
  const size_t quantity = result.size() / size_t(table.quantities());
  for (int first = 0; first < channels; first += most_channels) {
    e.channels = std::min(most_channels, channels - first);
    e.points = points.subspan(std::min(size_t(first), points.size()));
    for (int q = 0; q < table.quantities(); ++q)
      e.quantities[size_t(q)] =
          result.subspan(size_t(q) * quantity, quantity).subspan(std::min(size_t(first), quantity));
    body(e);
  }
}

}  // namespace sublimit
