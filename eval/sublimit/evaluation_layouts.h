// SPDX-License-Identifier: Apache-2.0
#pragma once
// What evaluators make of an evaluation before they begin: strides without zeros, lengths, and what cannot be asked
// for.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "sublimit/evaluation.h"
#include "sublimit/kernels/apply_patches.h"
#include "sublimit/pattern_table.h"

namespace sublimit {

inline constexpr int most_channels = 64;

/// A layout of so many points without zeros in it.
struct Layout {
  kernels::Strides strides;
  std::int64_t frame = 0;
  std::int64_t length = 0;  ///< numbers from the first to the last one
};

struct EvaluationLayouts {
  Layout given;   ///< points of the caller
  Layout inputs;  ///< points that patches are applied to
  Layout results;
};

/// What is wanted of each point: bits 0 to 5 quantities, then tangents, bitangents, normals.
using Wanted = std::uint16_t;
inline constexpr Wanted wanted_frames = 7u << 6;
inline constexpr const char* names_of_wanted[] = {"positions",         "derivatives along u", "derivatives along v",
                                                  "derivatives by uu", "derivatives by uv",   "derivatives by vv",
                                                  "tangents",          "bitangents",          "normals"};
/// Matrices that are needed: of a rational derivative those of lower order too.
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

[[noreturn]] void fail_evaluation(const std::string& what);
/// @throws InvalidParameter  fewer numbers than a layout needs
void check_evaluation_length(const char* name, std::int64_t numbers, std::int64_t needed);

/// @throws InvalidParameter  strides with which numbers overlap
Layout resolved_layout(const char* name, const PointLayout& layout, std::int64_t points, int channels, int frames);

/// @throws InvalidParameter  strides with which numbers overlap, quantities that the table does not have, tangent
/// frames
///                           without derivatives or of other than 3 channels
template <class Real>
EvaluationLayouts checked_layouts(const PatternTable<Real>& table, const EvaluationShape& shape);

template <class Real>
EvaluationShape shape_of(const Evaluation<Real>& evaluation);
/// The same with spans.
/// @throws InvalidParameter  spans that are too short too
template <class Real>
EvaluationLayouts checked_layouts(const PatternTable<Real>& table, const Evaluation<Real>& evaluation);

/// Quantities that values of a transpose have.
/// @throws InvalidParameter  spans of the wrong length, channels < 1
template <class Real>
int checked_quantities(const PatternTable<Real>& table, std::span<const Real> values, int channels,
                       std::span<const Real> result);

/// Calls body(evaluation) for all quantities and channels of interleaved numbers, as many channels at a time as an
/// evaluation has.
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
