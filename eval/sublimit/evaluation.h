// SPDX-License-Identifier: Apache-2.0
#pragma once
// What an evaluator is asked for: where points are read, which quantities are wanted, where they go.
#include <array>
#include <cstdint>
#include <span>

namespace sublimit {

/// Channel c of point i of frame f is number  f * frame + i * point + c * channel.  Zeros: as close as can be.
struct PointLayout {
  std::int64_t point = 0;
  std::int64_t channel = 1;
  std::int64_t frame = 0;
  /// x y z x y z ...
  /// @param stride  numbers from point to point; 0: as many as there are channels
  static PointLayout interleaved(std::int64_t stride = 0) { return {stride, 1, 0}; }
  /// x x x ... y y y ... z z z ...
  /// @param stride  numbers from channel to channel; at least the number of points
  static PointLayout planar(std::int64_t stride) { return {1, stride, 0}; }
};

/// Several frames of points of some channels, and what is wanted of each point. Spans may be longer than needed; an
/// empty one is not wanted. Results must overlap neither each other nor the points.
template <class Real>
struct Evaluation {
  int channels = 3;  ///< of points and results, 1 to 64; of rational ones 2 to 64
  int frames = 1;    ///< sets of points, each of which is evaluated
  std::span<const Real> points;
  PointLayout point_layout;
  /// Position, derivatives along u, v, uu, uv, vv: as many of them as the table has.
  std::array<std::span<Real>, 6> quantities;
  /// Unit vectors, of tables with derivatives and results of 3 channels: t along u; n normal, along u x v; b = n x t.
  /// All three are zero where u x v is. Nothing else has to be wanted.
  std::span<Real> tangents, bitangents, normals;
  PointLayout result_layout;  ///< of everything that is wanted

  /// Points are homogeneous columns (w x, w y, .., w), as tables of rational surfaces want them
  /// (`TableInfo::rational`): results have one channel less, divided by the weight, and derivatives follow the quotient
  /// rule. The last channel is the weight, whatever their number: three channels are points of the plane, never x, y,
  /// z.
  bool rational = false;
  /// Poles: where the magnitude of the weight is not larger, all results are zero. `noise_of_weights` is right.
  Real least_weight = 0;

  int result_channels() const { return channels - (rational ? 1 : 0); }
};

/// What a sum of these weights, which are the last channel of the points, has of rounding: four units in the last place
/// of the largest.
/// @throws InvalidParameter  points that are too few for the layout
template <class Real>
Real noise_of_weights(const Evaluation<Real>& evaluation, std::int64_t num_points);

}  // namespace sublimit
