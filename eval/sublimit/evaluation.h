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
  int channels = 3;  ///< of points and results, 1 to 64
  int frames = 1;    ///< sets of points, each of which is evaluated
  std::span<const Real> points;
  PointLayout point_layout;
  /// Position, derivatives along u, v, uu, uv, vv: as many of them as the table has.
  std::array<std::span<Real>, 6> quantities;
  /// Unit vectors, of tables with derivatives and points of 3 channels: t along u; n normal, along u x v; b = n x t.
  /// All three are zero where u x v is. Nothing else has to be wanted.
  std::span<Real> tangents, bitangents, normals;
  PointLayout result_layout;  ///< of everything that is wanted
};

}  // namespace sublimit
