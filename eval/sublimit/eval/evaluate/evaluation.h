// SPDX-License-Identifier: Apache-2.0
#pragma once
// An evaluation: where points are read, which quantities are wanted, and where they are written. `PatternEvaluator` and
// `GpuEvaluator` take it:
//
//   std::vector<float> positions(3 * table.num_points()), normals(3 * table.num_points());
//   Evaluation<float> frame{.channels = 3, .points = points};
//   frame.quantities[0] = positions;
//   frame.normals = normals;  // of tables with derivatives
//   table.evaluator<float>().apply(frame);  // table is a Table of eval/table.h
#include <array>
#include <cstdint>
#include <span>

namespace sublimit {

/// Strides of an array: channel c of point i of frame f is number  f * frame + i * point + c * channel.
struct PointLayout {
  std::int64_t point = 0;    ///< numbers from point to point; 0: as many as there are channels
  std::int64_t channel = 1;  ///< numbers from channel to channel
  std::int64_t frame = 0;    ///< numbers from frame to frame; 0: as many as one frame takes
  /// Returns the layout x y z x y z ...
  /// @param stride  numbers from point to point; 0: as many as there are channels
  static PointLayout interleaved(std::int64_t stride = 0) { return {stride, 1, 0}; }
  /// Returns the layout x x x ... y y y ... z z z ...
  /// @param stride  numbers from channel to channel; at least the number of points
  static PointLayout planar(std::int64_t stride) { return {1, stride, 0}; }
};

/// Points of one or more frames, and the results that are wanted. Spans may be longer than needed; results whose span
/// is empty are not made. Results must overlap neither each other nor the points.
template <class Real>
struct Evaluation {
  int channels = 3;              ///< channels of points and results, 1 to 64; of rational ones 2 to 64
  int frames = 1;                ///< sets of points, each of which is evaluated
  std::span<const Real> points;  ///< control points of all frames
  PointLayout point_layout;      ///< layout of `points`
  /// Position, derivatives along u, v, uu, uv, vv: at most as many as the table has.
  std::array<std::span<Real>, 6> quantities;
  /// Unit vectors, for tables with derivatives and results of 3 channels: t along u; n normal, along u x v; b = n x t.
  /// All three are zero where u x v is zero. They may be wanted alone, without any of the quantities.
  std::span<Real> tangents, bitangents, normals;
  PointLayout result_layout;  ///< layout of every result

  /// True if points are homogeneous columns (w x, w y, .., w), as tables of rational surfaces need
  /// (`TableInfo::rational`). Results are divided by the weight and have one channel less; derivatives follow the
  /// quotient rule. The last channel is always the weight: three channels are points of the plane.
  bool rational = false;
  /// Largest magnitude of a weight that counts as zero: results are zero there (a pole). Use `noise_of_weights`.
  Real least_weight = 0;

  /// Returns the number of channels of results.
  int result_channels() const { return channels - (rational ? 1 : 0); }
};

/// Returns a bound on the rounding of sums of the points' weights (their last channel): four units in the last place of
/// the largest one.
/// @param num_points  points of a frame
/// @throws InvalidParameter  points that are too few for the layout
template <class Real>
Real noise_of_weights(const Evaluation<Real>& evaluation, std::int64_t num_points);

}  // namespace sublimit
